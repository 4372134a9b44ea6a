/* assay: the command line. Dispatch only; each command stands in its own file. */
#include "solver/suggest.h"
#include "verify/commands.h"
#include "verify/help.h"
#include "verify/manual.h"
#include "verify/signals.h"
#include "verify/trap.h"

#include "solver/path.h"

#include <stdio.h>
#include <string.h>

static const struct verify_command commands[] = {
    {.name = "list",
     .operands = "[SUBJECT]",
     .summary = "scenes, oracles, schemes, materials, stencils, integrators, measures, keys",
     .help = "Lists what there is, one line each. SUBJECT is one of scenes, oracles, schemes, materials,\n"
             "stencils, integrators, measures: how figures are measured, or keys: every key a scene understands, with\n"
             "what it expects.",
     .most = 1,
     .run = verify_command_list},
    {.name = "run",
     .operands = "SCENE",
     .summary = "simulate: record, picture, conserved quantities",
     .help =
         "Simulates a scene: one of `assay list scenes`, or the path of a .lua file. Writes SCENE.vtkhdf, which\n"
         "ParaView opens (SCENE.xdmf beside it is for older readers), and SCENE.png, and prints conserved\n"
         "quantities, time and memory per particle.\n\n"
         "  assay run swinging-cube --set n=16 --set stencil=closed --set material.nu=0.45\n"
         "  assay run swinging-cube --error p=1e-3\n\n"
         "--error runs the cheapest configuration that the last assay trade SCENE saw reach the error, says what it\n"
         "took and why, and has the oracle judge this run: exit code 1 if the error is larger than asked for, or\n"
         "another than the study says. It is refused without a study, with one of a scene that has changed since\n"
         "or of other overrides, and where nothing measured reaches the error.\n\n"
         "--checkpoint writes SCENE.checkpoint now and then, each in place of the one before. SIGINT (Ctrl-C),\n"
         "SIGTERM and SIGHUP stop a run after its step; it is kept the same way, if checkpoints were asked for or\n"
         "it has gone on for five seconds. The message says where, and how to go on:\n\n"
         "  assay run taylor-bar --checkpoint 10min\n"
         "  assay run --restart out/taylor-bar/taylor-bar.checkpoint\n\n"
         "A checkpoint holds the scene and its overrides; nothing else is needed. The run that goes on gives the\n"
         "same bytes as one that was never stopped, for any number of threads (--set threads=N, and no other key).\n"
         "Results go to the checkpoint's folder unless --out says otherwise. One of another version of the program\n"
         "is refused, one of another compiler or of loops that round otherwise (ASSAY_ISA), and one whose scene's\n"
         "file has changed since, unless --as-stored is given.",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_OUT | VERIFY_TAKES_ERROR | VERIFY_TAKES_STUDY | VERIFY_TAKES_CHECKPOINT,
     .least = 1,
     .most = 1,
     .run = verify_command_run},
    {.name = "verify",
     .operands = "SCENE",
     .summary = "convergence study against the scene's oracle, with gates",
     .help =
         "Runs a scene at several spacings and compares each result with the scene's exact solution, which first\n"
         "has to prove itself. Prints errors and observed orders beside the published figures, then the gates:\n"
         "what was measured, the bound, and whether it holds. Writes report.html, report.json, and the record and\n"
         "pictures of the finest level. n counts spacings along the scene's reference length.\n\n"
         "  assay verify swinging-cube\n"
         "  assay verify swinging-cube --levels 8,16,24,32 --set cfl=0.4 --json result.json\n"
         "  assay verify swinging-cube --set oracle.U0=5.05e-4   the oracle is told something else: gates fail\n\n"
         "SCENE may be mms: manufactured solutions, run for every scheme, stencil, evolved set, material, integrator\n"
         "and kind of boundary data, and the orders that they achieve in one table; mms TEXT runs those whose\n"
         "heading holds the text, as in mms \"in time\"; mms claims those that claim an order.\n\n"
         "Exit code: 0 all gates pass, or none holds for the configuration, which is then said; 1 a gate or the\n"
         "oracle's self-check fails; 2 the command line, the scene or a file is wrong; 3 the run broke down.",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_LEVELS | VERIFY_TAKES_JSON | VERIFY_TAKES_OUT | VERIFY_TAKES_MUTATIONS,
     .least = 1,
     .most = 2,
     .run = verify_command_verify},
    {.name = "trade",
     .operands = "SCENE",
     .summary = "what accuracy costs: which configuration to choose for an error",
     .help = VERIFY_TRADE_HELP,
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_LEVELS | VERIFY_TAKES_VARY | VERIFY_TAKES_ERROR_NAME |
              VERIFY_TAKES_BUDGET | VERIFY_TAKES_JSON | VERIFY_TAKES_OUT,
     .least = 1,
     .most = 1,
     .run = verify_command_trade},
    {.name = "render",
     .operands = "RECORD",
     .summary = "contour picture of a record",
     .help = "Draws a record (.vtkhdf) as the view of the scene stored in it says; --set changes that view. The "
             "picture is\n"
             "named as the record, with .png, unless -o says otherwise.\n\n"
             "  assay render out/swinging-cube/swinging-cube.vtkhdf -o stress.png --set view.field=von_mises",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_PICTURE,
     .least = 1,
     .most = 1,
     .run = verify_command_render},
    {.name = "golden",
     .operands = "check|update SCENE",
     .summary = "compare with, or renew, the stored record and picture",
     .help = "check runs a scene at its coarsest level and compares record and picture with the stored ones, field by\n"
             "field; where they differ it exits with 1, and the difference picture stands in the --out folder beside\n"
             "the stored and the fresh one. update stores what comes out now.\n\n"
             "  assay golden check swinging-cube",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_OUT | VERIFY_TAKES_DIR,
     .least = 2,
     .most = 2,
     .run = verify_command_golden},
    {.name = "compare",
     .operands = "IMAGE REFERENCE",
     .summary = "whether two pictures show the same",
     .help =
         "Compares two PNG pictures as golden check does: pixel by pixel in CIELAB, each with what is near the same\n"
         "place in the other picture, so that a shift by one pixel does not count. They show the same if at most\n"
         "0.0005 of all pixels differ visibly and at most 0.02 of those within the worst tile of 16 x 16. Of pictures\n"
         "that assay drew, title and colour bar do not count. -o writes a picture of what differs.\n\n"
         "  assay compare out/stress.png reference/stress.png -o difference.png\n"
         "  assay compare mine.png reference.png --tolerance 0.002,0.1\n\n"
         "Exit code: 0 they show the same; 1 they do not; 2 they cannot be compared, being of different size, or a\n"
         "file is wrong.",
     .takes = VERIFY_TAKES_PICTURE | VERIFY_TAKES_TOLERANCE,
     .least = 2,
     .most = 2,
     .run = verify_command_compare},
    {.name = "bench",
     .operands = "SCENE",
     .summary = "what a particle-step costs, beside what the machine allows at best",
     .help =
         "Times steps of a scene for every stencil and evolved set, on one thread and with tvd-rk2 at CFL 0.3 unless\n"
         "--set says otherwise, for each of the levels, and measures the machine's memory bandwidth and arithmetic in\n"
         "the same run: the roofline. What the scene refuses is said in place of its row. A measurement, not a test:\n"
         "it has no bound to fail.\n\n"
         "The loops are those for the widest instruction set that the processor knows; the environment variable\n"
         "ASSAY_ISA=baseline, avx2 or avx512 asks for another.\n\n"
         "  assay bench swinging-cube\n"
         "  assay bench swinging-cube --levels 9,24,49 --set stencil=sbp2\n"
         "  assay bench swinging-cube --set stencil=closed --set evolved=pF --set threads=2",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_LEVELS,
     .least = 1,
     .most = 1,
     .run = verify_command_bench},
    {.name = "extremes",
     .operands = "[NAME [ROWS]]",
     .summary = "where each scheme works, and the nearest value at which it fails",
     .help =
         "Drives one quantity after the other until runs no longer hold, most by bisection, and prints the last\n"
         "value that holds beside the nearest that fails, what is to be expected, and why it fails. NAME is one of\n"
         "cfl, scale, place, alternating, spin, vibration, poisson, stretch, perturbed, impact, contrast,\n"
         "slanted, graded, small; without it all are measured. ROWS picks those that have this in their first\n"
         "column. --set goes to every run; keys that the rows set themselves are refused.\n\n"
         "  assay extremes scale\n"
         "  assay extremes cfl \"sbp2 pF rk4, 1D\"\n"
         "  assay extremes cfl --json cfl.json\n\n"
         "SIGINT (Ctrl-C), SIGTERM and SIGHUP end it by the signal; the rows before stand, in the JSON file too,\n"
         "which then says by what it was stopped, and during which extreme.\n\n"
         "Exit code: 0 all bounds hold; 1 one does not; 2 a word or a file is wrong; 3 a run that had to end broke\n"
         "down.",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_JSON,
     .most = 2,
     .run = verify_command_extremes},
    {.name = "cost",
     .operands = "SCENE",
     .summary = "what a scene switches on, what each item costs, and what leaving it out would save",
     .help =
         "Prints the memory of every array [B/particle] and the operations of every term [flop/particle-step], as\n"
         "declared beside the code and held to the allocator and to counted operations by tests; the time of a\n"
         "particle's step as measured [ns], on one thread unless --set threads says otherwise; and all three for the\n"
         "scene without each item that a key can leave out. A measurement, not a test. SIGINT (Ctrl-C), SIGTERM\n"
         "and SIGHUP end it by the signal after the item at hand; what was measured is printed and written.\n\n"
         "  assay cost swinging-cube\n"
         "  assay cost taylor-bar --set n=2 --json cost.json",
     .takes = VERIFY_TAKES_SET | VERIFY_TAKES_JSON,
     .least = 1,
     .most = 1,
     .run = verify_command_cost},
    {.name = "judge",
     .operands = "FILE...",
     .summary = "results of any solver against an oracle, with gates",
     .help = VERIFY_JUDGE_HELP,
     .takes = VERIFY_TAKES_ORACLE | VERIFY_TAKES_PARAM | VERIFY_TAKES_NORM | VERIFY_TAKES_GATE | VERIFY_TAKES_ORDER |
              VERIFY_TAKES_TIME | VERIFY_TAKES_SPACING | VERIFY_TAKES_JSON | VERIFY_TAKES_OUT,
     .least = 1,
     .most = VERIFY_OPERANDS,
     .run = verify_command_judge},
    {.name = "oracle",
     .operands = "NAME",
     .summary = "an oracle's fields at the places of a file or a grid",
     .help = VERIFY_ORACLE_HELP,
     .takes = VERIFY_TAKES_PARAM | VERIFY_TAKES_PLACES | VERIFY_TAKES_TIME | VERIFY_TAKES_TABLE,
     .least = 1,
     .most = 1,
     .run = verify_command_oracle},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

static void print_help(FILE *file)
{
    (void)fprintf(file,
                  "assay %s: solid dynamics that carries its own proof\n\nusage: assay COMMAND [words and options]\n\n",
                  verify_version());
    for (size_t i = 0; i < COMMANDS; i++) {
        (void)fprintf(file, "  %-8s %-20s %s\n", commands[i].name, commands[i].operands, commands[i].summary);
    }
    (void)fprintf(file, "\nassay COMMAND --help says more. A first one to try:\n\n  assay verify swinging-cube\n\n"
                        "Exit codes: 0 all is well, 1 a gate or a comparison fails, 2 the command line, a scene or a\n"
                        "file is wrong, 3 the run itself failed, 128 + N a signal N stopped it.\n");
}

static const struct verify_command *find(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++) {
        if (strcmp(commands[i].name, name) == 0) {
            return &commands[i];
        }
    }
    return NULL;
}

static int refuse(const char *word)
{
    const char *names[COMMANDS];
    for (size_t i = 0; i < COMMANDS; i++) {
        names[i] = commands[i].name;
    }
    const char *meant = solver_suggest(word, names, COMMANDS);
    struct solver_error error;
    (void)solver_fail(&error, SOLVER_BAD_INPUT, "there is no command %s; %s%s%s", word,
                      meant != NULL ? "did you mean assay " : "see assay --help", meant != NULL ? meant : "",
                      meant != NULL ? "?" : "");
    return verify_complain(&error);
}

/* The exit code, unless a disk was full behind a pipe or a redirection. */
static int flushed(int code)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        (void)fprintf(stderr, "assay: standard output could not be written\n");
        return code == VERIFY_PASSED ? VERIFY_BAD_INPUT : code;
    }
    return code;
}

int main(int argc, char **argv)
{
    verify_trap_from_environment();
    if (argc < 2) {
        print_help(stderr);
        return VERIFY_BAD_INPUT;
    }
    const char *word = argv[1];
    bool help = strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0 || strcmp(word, "help") == 0;
    if (help && argc == 2) {
        print_help(stdout);
        return flushed(VERIFY_PASSED);
    }
    if (strcmp(word, "--version") == 0) {
        (void)printf("assay %s\nloops for %s\n", verify_version(), solver_path_name(solver_path()));
        return flushed(VERIFY_PASSED);
    }
    if (strcmp(word, "--manual") == 0) {
        verify_manual(stdout, commands, COMMANDS);
        return flushed(VERIFY_PASSED);
    }
    const struct verify_command *command = find(help ? argv[2] : word);
    if (command == NULL) {
        return refuse(help ? argv[2] : word);
    }
    struct verify_options options = {.help = true};
    struct solver_error error = {.code = SOLVER_OK};
    if (!help && !verify_options_parse(command, argc - 2, argv + 2, &options, &error)) {
        return verify_complain(&error);
    }
    if (options.help) {
        verify_options_help(stdout, command);
        return flushed(VERIFY_PASSED);
    }
    verify_signals_prepare();
    int code = command->run(&options);
    return code == VERIFY_STOPPED ? verify_signals_follow() : flushed(code);
}
