/* The command line. */
#include "solver/suggest.h"
#include "tests/unit/unit.h"
#include "verify/options.h"

#include <string.h>

static const struct verify_command all = {
    .name = "verify",
    .operands = "SCENE",
    .summary = "",
    .help = "",
    .takes = VERIFY_TAKES_SET | VERIFY_TAKES_LEVELS | VERIFY_TAKES_JSON | VERIFY_TAKES_OUT,
    .least = 1,
    .most = 1,
};

static struct verify_options options;
static struct solver_error error;

enum { WORDS = 80 };

static bool parse(char *const *words)
{
    int count = 0;
    while (words[count] != NULL) {
        count++;
    }
    error = (struct solver_error){.code = SOLVER_OK};
    return verify_options_parse(&all, count, words, &options, &error);
}

#define PARSE(...) parse((char *[]){__VA_ARGS__, NULL})

/* Refused as bad input, and the text says what. */
static void refused(bool parsed, const char *text)
{
    CU_ASSERT_FALSE(parsed);
    CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, text));
}

static void accepted(void)
{
    CU_ASSERT_TRUE_FATAL(PARSE("--levels", "4,8,16,24", "cube", "--set", "n=3", "-s", "a=b=c", "--json=x.json"));
    CU_ASSERT_EQUAL(options.level_count, 4);
    CU_ASSERT_EQUAL(options.level[3], 24);
    CU_ASSERT_STRING_EQUAL(options.operand[0], "cube");
    CU_ASSERT_EQUAL(options.override_count, 2);
    CU_ASSERT_STRING_EQUAL(options.override[1], "a=b=c");
    CU_ASSERT_STRING_EQUAL(options.json, "x.json");
    CU_ASSERT_PTR_NULL(options.out);
    CU_ASSERT_STRING_EQUAL(options.line, "assay verify --levels 4,8,16,24 cube --set n=3 -s a=b=c");
    CU_ASSERT_TRUE(PARSE("--help"));
    CU_ASSERT_TRUE(options.help);
    CU_ASSERT_TRUE(PARSE("--", "--levels"));
    CU_ASSERT_STRING_EQUAL(options.operand[0], "--levels");
}

/* Where results go leaves no trace in them, however it is written. */
static void kept_line(void)
{
    CU_ASSERT_TRUE_FATAL(PARSE("cube", "--out=here", "-s", "n=3", "-j", "x.json", "--levels=4"));
    CU_ASSERT_STRING_EQUAL(options.line, "assay verify cube -s n=3 --levels=4");
    CU_ASSERT_TRUE_FATAL(PARSE("-O", "there", "cube"));
    CU_ASSERT_STRING_EQUAL(options.out, "there");
    CU_ASSERT_STRING_EQUAL(options.line, "assay verify cube");
}

static void unknown_options(void)
{
    refused(PARSE("cube", "--level", "4"), "did you mean --levels?");
    refused(PARSE("cube", "--jsno", "4"), "did you mean --json?");
    refused(PARSE("cube", "--zzzzzzzz"), "unknown option --zzzzzzzz");
    refused(PARSE("cube", "--dir", "x"), "assay verify takes no --dir;"); /* others do */
    refused(PARSE("cube", "-x"), "unknown option -x");
}

static void wrong_levels(void)
{
    static char *const wrong[] = {"",    ",",   "4,",   ",4", "0",   "-4",          "4,4", "8,4",
                                  "4.5", "4;8", "4, 8", "x",  "1e9", "99999999999", "+4",  "4,8,nan"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refused(PARSE("cube", "--levels", wrong[i]), "--levels");
    }
    refused(PARSE("cube", "--levels", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17"), "at most 16");
    CU_ASSERT_TRUE(PARSE("cube", "--levels", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16"));
}

static void wrong_words(void)
{
    refused(PARSE("cube", "--levels"), "wants N,N,...");
    refused(PARSE("cube", "--set"), "wants KEY=VALUE");
    refused(PARSE("cube", "--set", "n"), "KEY=VALUE");
    refused(PARSE("cube", "--set", "=4"), "KEY=VALUE");
    refused(PARSE("cube", "--set", "n=4\nm=5"), "control character");
    refused(PARSE("cube", "--json", "a.json", "--json", "b.json"), "given twice");
    refused(PARSE("cube", "--levels", "4,8", "--levels", "8"), "given twice");
    refused(PARSE("cube", "--json", "cube.lua"), "expected a name that ends in .json");
    refused(PARSE("cube", "--json", ".json"), "expected a name that ends in .json");
    refused(PARSE("cube", "--out", ""), "empty");
    refused(PARSE("cube", "--help=yes"), "takes no value");
    refused(PARSE("cube", "sphere"), "sphere");
    refused(PARSE("--levels", "4"), "wants SCENE");
}

static void too_many(void)
{
    char *words[WORDS] = {"cube"};
    size_t count = 1;
    for (size_t i = 0; i < WORDS - 2; i++) {
        words[count++] = "--set=n=1";
    }
    words[count] = NULL;
    refused(parse(words), "too many --set");
}

static void long_line(void)
{
    static char word[3 * VERIFY_COMMAND_LINE];
    memset(word, 'x', sizeof word - 1);
    CU_ASSERT_TRUE(PARSE(word));
    CU_ASSERT_EQUAL(strlen(options.line), VERIFY_COMMAND_LINE - 1);
}

static bool parse_tolerance(const char *text)
{
    static const struct verify_command compare = {.name = "compare", .takes = VERIFY_TAKES_TOLERANCE, .most = 2};
    char word[64];
    (void)snprintf(word, sizeof word, "--tolerance=%s", text);
    error = (struct solver_error){.code = SOLVER_OK};
    return verify_options_parse(&compare, 1, (char *[]){word, NULL}, &options, &error);
}

static void tolerances(void)
{
    unit_untrapped();
    CU_ASSERT_TRUE_FATAL(parse_tolerance("5e-4,0.02"));
    CU_ASSERT_TRUE(options.has_tolerance);
    CU_ASSERT_EQUAL(options.tolerance[0], 5e-4);
    CU_ASSERT_EQUAL(options.tolerance[1], 0.02);
    CU_ASSERT_TRUE(parse_tolerance("0,1"));
    static const char *const wrong[] = {"",      "0.1",    "0.1,",  ",0.1", "0.1,0.2,0.3",
                                        "0.1,2", "-0.1,0", "nan,0", "0;1",  "x"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        refused(parse_tolerance(wrong[i]), "two numbers from 0 to 1");
    }
}

static void suggestions(void)
{
    static const char *const names[] = {"run", "verify", "render", "golden"};
    CU_ASSERT_STRING_EQUAL(solver_suggest("verfiy", names, 4), "verify");
    CU_ASSERT_STRING_EQUAL(solver_suggest("rnu", names, 4), "run");
    CU_ASSERT_STRING_EQUAL(solver_suggest("gold", names, 4), "golden");
    CU_ASSERT_PTR_NULL(solver_suggest("swinging-cube", names, 4));
    CU_ASSERT_PTR_NULL(solver_suggest("", names, 4));
    static char word[500];
    memset(word, 'r', sizeof word - 1);
    CU_ASSERT_PTR_NULL(solver_suggest(word, names, 4));
}

static void exit_codes(void)
{
    static const struct {
        enum solver_code code;
        int exit;
    } table[] = {{SOLVER_OK, 0}, {SOLVER_BAD_INPUT, 2}, {SOLVER_IO, 2}, {SOLVER_NO_MEMORY, 3}, {SOLVER_BROKE_DOWN, 3}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const struct solver_error given = {.code = table[i].code};
        CU_ASSERT_EQUAL((int)verify_exit_code(&given), table[i].exit);
    }
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"accepted", accepted},           {"unknown options", unknown_options},
        {"wrong levels", wrong_levels},   {"wrong words", wrong_words},
        {"too many overrides", too_many}, {"a very long line", long_line},
        {"suggestions", suggestions},     {"exit codes", exit_codes},
        {"tolerances", tolerances},       {"what the record keeps", kept_line},
    };
    return unit_main("options", tests, sizeof tests / sizeof *tests);
}
