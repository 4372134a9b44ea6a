/* The JSON report: escaping, numbers that are none, and the verdict. */
#include "tests/unit/unit.h"
#include "verify/json.h"
#include "verify/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static char *text;

/* Collects what a writer prints. */
static FILE *open_text(size_t *size)
{
    free(text);
    text = NULL;
    FILE *file = open_memstream(&text, size);
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    return file;
}

static void string_is(const char *given, const char *expected)
{
    size_t size = 0;
    FILE *file = open_text(&size);
    verify_json_string(file, given);
    (void)fclose(file);
    CU_ASSERT_STRING_EQUAL(text, expected);
}

static void strings(void)
{
    string_is("", "\"\"");
    string_is("swinging-cube", "\"swinging-cube\"");
    string_is("a\"b\\c/d", "\"a\\\"b\\\\c/d\"");
    string_is("\b\n\t\x01\x1f\x7f", "\"\\u0008\\u000a\\u0009\\u0001\\u001f\\u007f\"");
    string_is("\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80", "\"\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80\"");
}

static void broken_utf8(void)
{
    string_is("\xff", "\"\\ufffd\"");
    string_is("\x80", "\"\\ufffd\"");
    string_is("a\xc3", "\"a\\ufffd\"");
    string_is("\xe2\x82", "\"\\ufffd\\ufffd\"");            /* cut short */
    string_is("\xc0\xaf", "\"\\ufffd\\ufffd\"");            /* overlong */
    string_is("\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""); /* surrogate */
    string_is("\xf5\x80\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\"");
    string_is("\xc3\"", "\"\\ufffd\\\"\""); /* the quote is not swallowed */
}

static struct solver_scene scene = {.oracle = "some"};
static struct verify_truth truth;
static struct verify_study study;

static void prepare(void)
{
    memset(&study, 0, sizeof study);
    strcpy(scene.name, "a \"scene\"");
    truth = (struct verify_truth){.check_count = 1, .check = {{"PDE", 1e-12, 1e-9}}, .proven = true};
    study.scene = &scene;
    study.truth = &truth;
    struct verify_level level = {.n = 8, .facts = {.particles = 729, .steps = 10, .spacing = 0.125, .seconds = 1}};
    level.error[1] = NAN;
    level.error[2] = INFINITY;
    verify_study_add(&study, &level);
}

static const char *written(void)
{
    size_t size = 0;
    FILE *file = open_text(&size);
    verify_json(file, &study);
    (void)fclose(file);
    return text != NULL ? text : "";
}

static bool says(const char *part)
{
    return strstr(written(), part) != NULL;
}

static void not_a_number_is_null(void)
{
    prepare();
    CU_ASSERT_TRUE(says("\"p\": 0, \"p_abs\": null, \"p_max\": null"));
    CU_ASSERT_FALSE(says("nan"));
    CU_ASSERT_FALSE(says("inf"));
    CU_ASSERT_TRUE(says("\"scene\": \"a \\\"scene\\\"\""));
    CU_ASSERT_TRUE(says("\"rates\": {}"));
}

static void digits_are_kept(void)
{
    prepare();
    study.level[0].error[0] = 0.1 + 0.2;
    const char *place = strstr(written(), "\"p\": ");
    CU_ASSERT(place != NULL && strtod(place + 5, NULL) == 0.1 + 0.2);
}

static void verdicts(void)
{
    prepare();
    CU_ASSERT_TRUE(says("\"pass\": null"));
    study.gates = (struct verify_gates){.count = 1, .gate = {{"p", 1, 2, "<=", "-", "", true}}, .pass = true};
    CU_ASSERT_TRUE(says("{\"name\": \"p\", \"value\": 1, \"bound\": 2, \"op\": \"<=\", \"pass\": true}"));
    CU_ASSERT_TRUE(says("],\n  \"pass\": true\n}"));
    study.gates.gate[0].pass = study.gates.pass = false;
    CU_ASSERT_TRUE(says("],\n  \"pass\": false\n}"));
    study.gates.gate[0].value = NAN;
    study.gates.gate[0].why = "it was too short";
    CU_ASSERT_TRUE(
        says("\"value\": null, \"bound\": 2, \"op\": \"<=\", \"pass\": false, \"why\": \"it was too short\"}"));
}

static void an_oracle_that_fails(void)
{
    prepare();
    study.gates = (struct verify_gates){.count = 1, .gate = {{"p", 1, 2, "<=", "-", "", true}}, .pass = true};
    truth.check[0].residual = NAN;
    truth.proven = false;
    CU_ASSERT_TRUE(says("{\"name\": \"oracle self-check: PDE\", \"value\": null"));
    CU_ASSERT_TRUE(says("],\n  \"pass\": false\n}"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"strings", strings},
        {"broken UTF-8", broken_utf8},
        {"what is no number is null", not_a_number_is_null},
        {"all digits are kept", digits_are_kept},
        {"verdicts", verdicts},
        {"an oracle that fails", an_oracle_that_fails},
    };
    int code = unit_main("json", tests, sizeof tests / sizeof *tests);
    free(text);
    return code;
}
