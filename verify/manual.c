#include "verify/manual.h"

#include "verify/commands.h"

#include <string.h>

/* One character, such that roff takes it for itself. */
static void put(FILE *file, char c)
{
    static const struct {
        char c;
        const char *roff;
    } special[] = {{'\\', "\\e"}, {'-', "\\-"}, {'\'', "\\(aq"}, {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"}};
    for (size_t i = 0; i < sizeof special / sizeof *special; i++) {
        if (c == special[i].c) {
            (void)fputs(special[i].roff, file);
            return;
        }
    }
    (void)fputc(c, file);
}

/* A line of text; a dot at its start would be a request. */
static void put_line(FILE *file, const char *text, size_t length)
{
    (void)fputs(length > 0 && text[0] == '.' ? "\\&" : "", file);
    for (size_t i = 0; i < length; i++) {
        put(file, text[i]);
    }
    (void)fputc('\n', file);
}

/* What stands between empty lines of a help text. */
struct block {
    const char *text;
    size_t length;
    size_t term; /* "LEVELS  Each file ...": of the first line's word; 0: none */
    enum { PARAGRAPH, TERM, EXAMPLE, TABLE } kind;
};

static size_t line_length(const char *line, const struct block *block)
{
    size_t rest = (size_t)(block->text + block->length - line), length = strcspn(line, "\n");
    return length < rest ? length : rest;
}

/* An example is indented by two; a term has its word first and is indented by two from the second line on; what is
 * indented in any other way stays as it is. */
static struct block next_block(const char *text)
{
    const char *end = strstr(text, "\n\n");
    struct block block = {.text = text, .length = end != NULL ? (size_t)(end - text) : strlen(text)};
    size_t word = strspn(text, "ABCDEFGHIJKLMNOPQRSTUVWXYZ"), indented = 0, deeper = 0, lines = 0;
    block.term = word > 1 && strncmp(text + word, "  ", 2) == 0 ? word : 0;
    for (const char *line = text; line < text + block.length; line += line_length(line, &block) + 1) {
        size_t blanks = strspn(line, " ");
        indented += blanks > 0;
        deeper += blanks > 2;
        lines++;
    }
    block.kind = indented == 0                                            ? PARAGRAPH
                 : text[0] == ' '                                         ? EXAMPLE
                 : block.term > 0 && deeper == 0 && indented + 1 == lines ? TERM
                                                                          : TABLE;
    return block;
}

#define PART ".PP\n"

static void put_text(FILE *file, const char *text)
{
    static const char *const before[] = {PART, ".TP\n.B ", PART ".RS\n.EX\n", PART ".EX\n"};
    static const char *const after[] = {"", "", ".EE\n.RE\n", ".EE\n"};
    for (const char *from = text; *from != '\0';) {
        struct block block = next_block(from);
        const char *line = block.text;
        bool parted = strncmp(before[block.kind], PART, sizeof PART - 1) == 0;
        (void)fputs(before[block.kind] + (from == text && parted ? sizeof PART - 1 : 0),
                    file); /* not after a heading */
        if (block.kind == TERM) {
            put_line(file, line, block.term);
            line += block.term;
        }
        while (line < block.text + block.length) {
            size_t length = line_length(line, &block), blanks = strspn(line, " ");
            size_t cut = block.kind == TABLE ? 0 : block.kind == EXAMPLE && blanks > 2 ? 2 : blanks;
            put_line(file, line + cut, length - cut);
            line += length + 1;
        }
        (void)fputs(after[block.kind], file);
        from = block.text + block.length;
        from += strspn(from, "\n");
    }
}

static void put_commands(FILE *file, const struct verify_command *command, size_t count)
{
    (void)fputs(".SH COMMANDS\n", file);
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(file, ".SS assay %s ", command[i].name);
        put_line(file, command[i].operands, strlen(command[i].operands));
        put_text(file, command[i].help);
        struct verify_option_line option[VERIFY_OPTIONS];
        size_t options = verify_options_lines(&command[i], option);
        for (size_t k = 0; k < options; k++) {
            (void)fputs(".TP\n.B ", file);
            const char *words = option[k].words + strspn(option[k].words, " ");
            put_line(file, words, strlen(words));
            put_line(file, option[k].help, strlen(option[k].help));
        }
    }
}

static const struct {
    const char *heading, *text;
} before[] = {
    {"DESCRIPTION",
     "assay simulates solids that deform and move, and says how far each result is from the truth: a scene is run at\n"
     "several spacings, compared with an exact solution that first has to prove itself, and judged by gates. The same\n"
     "exact solutions, oracles, judge the results of other solvers.\n\n"
     "A scene is a Lua file that assigns keys. SCENE is the name of one that comes with the program, as assay list\n"
     "scenes prints them, or the path of a file that ends in .lua. Options may stand anywhere after the command, and "
     "--\n"
     "ends them."},
};
static const struct {
    const char *heading, *text;
} after[] = {
    {"EXIT STATUS",
     "0: all is well, and all gates pass. 1: a gate or a comparison fails. 2: the command line, a scene or a file is\n"
     "wrong. 3: the run itself failed; the last whole state is then on disk. 128 + N, as a shell sees it: signal N\n"
     "stopped the program, 130 being Ctrl-C and 143 a SIGTERM; the message says whether the run is kept. A second one\n"
     "ends it at once."},
    {"ENVIRONMENT",
     "OMP_WAIT_POLICY=passive leaves waiting threads asleep, which is faster where other programs run on the same\n"
     "cores. How many threads a run uses, the scene's key threads says, or else the number of cores and of\n"
     "particles, OMP_NUM_THREADS at most; results are the same to the bit for any number.\n\n"
     "ASSAY_TRAP=1 has an operation on floating-point numbers that is invalid, divides by zero or overflows end the\n"
     "program with 99, and say where. For finding the first of them; a run that breaks down says so without it."},
    {"FILES",
     "All that a command writes goes to out/SCENE, or to the folder that --out names. Files are whole or absent.\n\n"
     "Installed below a prefix: share/assay/scenes, the scenes; share/assay/golden, the stored records and pictures;\n"
     "share/assay/examples, projects that have their own solver judged. The program looks for them from where it lies\n"
     "itself, so that the whole may be moved."},
    {"OTHER PROJECTS",
     "With CMake, gates for a solver of one's own are a few lines; share/assay/examples holds whole projects:"
     "\n\n"
     "  find_package(assay REQUIRED)\n"
     "  assay_add_gate(NAME bar ORACLE bimaterial-wave TYPICAL COMMAND my-solver @LEVEL@ LEVELS 100 200 400\n"
     "                 RESULT out-@LEVEL@.csv ERROR P=1e-2 ORDER u=1.8)\n"
     "  assay_add_image_gate(NAME stress COMMAND my-plot IMAGE stress.png REFERENCE stress.png)\n\n"
     "find_package(assay COMPONENTS oracles solver render golden) gives those libraries as assay::oracles and so on.\n"
     "For other build systems, pkg-config knows assay-oracles, and assay for all of them. Programs include their "
     "headers\n"
     "as \"oracles/oracle.h\", within extern \"C\" from C++."},
    {"EXAMPLES", "  assay verify swinging-cube\n"
                 "  assay verify swinging-cube --levels 8,12,16 --set stencil=closed\n"
                 "  assay list keys"},
};

void verify_manual(FILE *file, const struct verify_command *command, size_t count)
{
    (void)fprintf(
        file,
        ".TH ASSAY 1 \"\" \"assay %s\" \"User Commands\"\n.SH NAME\nassay \\- solid dynamics that carries its own "
        "proof\n.SH SYNOPSIS\n",
        verify_version());
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(file, "%s.B assay %s\n", i == 0 ? "" : ".br\n", command[i].name);
        put_line(file, command[i].operands, strlen(command[i].operands));
        (void)fputs("[options]\n", file);
    }
    for (size_t i = 0; i < sizeof before / sizeof *before; i++) {
        (void)fprintf(file, ".SH %s\n", before[i].heading);
        put_text(file, before[i].text);
    }
    put_commands(file, command, count);
    for (size_t i = 0; i < sizeof after / sizeof *after; i++) {
        (void)fprintf(file, ".SH %s\n", after[i].heading);
        put_text(file, after[i].text);
    }
}
