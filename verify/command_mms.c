/* `assay verify mms`: the suite of manufactured solutions as a table, and as JSON. */
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/json.h"
#include "verify/manufactured.h"
#include "verify/mms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SCENES = 8 };

/* The whole suite while it runs. */
struct suite {
    size_t count;
    struct verify_mms_case *cases;
    struct verify_mms_result *result; /* [count] */
    size_t scene_count;
    char path[SCENES][VERIFY_PATH]; /* of the scenes met so far */
    const char *scene[SCENES];
};

/* The scenes' files are found once: finding is not for several threads at a time. */
static bool find_scenes(struct suite *suite, struct solver_error *error)
{
    for (size_t i = 0; i < suite->count; i++) {
        size_t known = 0;
        while (known < suite->scene_count && strcmp(suite->scene[known], suite->cases[i].scene) != 0) {
            known++;
        }
        if (known == SCENES) {
            return solver_fail(error, SOLVER_BAD_INPUT, "more than %d scenes of manufactured solutions", SCENES);
        }
        if (known == suite->scene_count) {
            if (!verify_scene_find(suite->cases[i].scene, suite->path[known], error)) {
                return false;
            }
            suite->scene[suite->scene_count++] = suite->cases[i].scene;
        }
        suite->cases[i].path = suite->path[known];
    }
    return true;
}

/* --- the table --- */

static void print_head(const char *family)
{
    (void)printf("\n%s\n  %-46s | %-19s | observed order, and the least claimed where one is\n  %-46s |", family, "",
                 "relative L2 error", "");
    (void)printf(" %-9s %-9s |", "p [-]", "P [-]");
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        (void)printf(" %-9s", verify_mms_variable_names[i]);
    }
    (void)printf("|\n");
}

/* "1.98/1.9 ", with a ! where the claim does not hold, as where there is no order. */
static void print_order(const struct verify_mms_case *which, const struct verify_mms_result *result, int i)
{
    char text[32];
    bool none = !isfinite(result->order[i]);
    if (result->asked[i] && none) {
        (void)snprintf(text, sizeof text, "-/%.3g!", which->asked[i]);
    } else if (none || result->finest[i] < VERIFY_MMS_ROUND_OFF) {
        (void)snprintf(text, sizeof text, "-");
    } else if (result->asked[i]) {
        (void)snprintf(text, sizeof text, "%.2f/%.3g%s", result->order[i], which->asked[i],
                       result->order[i] >= which->asked[i] ? "" : "!");
    } else {
        (void)snprintf(text, sizeof text, "%.2f", result->order[i]);
    }
    (void)printf(" %-9s", text);
}

static void print_row(const struct verify_mms_case *which, const struct verify_mms_result *result)
{
    if (!result->ran) {
        (void)printf("  %-46s | FAIL: %s\n", which->name, result->error.text);
        return;
    }
    (void)printf("  %-46s | %9.2e %9.2e |", which->name, result->finest[VERIFY_MMS_OF_p],
                 result->finest[VERIFY_MMS_OF_P]);
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        print_order(which, result, i);
    }
    (void)printf("| %s\n", !verify_mms_claims(which) ? "claims none" : result->pass ? "PASS" : "FAIL");
}

/* Cases [first, last), as many at a time as there are cores; each on one thread, so that nothing depends on how many.
 */
static void run_family(struct suite *suite, size_t first, size_t last)
{
    size_t done = 0;
    bool shows = isatty(STDERR_FILENO) == 1;
#pragma omp parallel for schedule(dynamic)
    for (size_t i = first; i < last; i++) {
        verify_mms_run(&suite->cases[i], NULL, &suite->result[i]);
#pragma omp critical
        {
            done++;
            if (shows) {
                (void)fprintf(stderr, "\r\033[K%s: %zu of %zu", suite->cases[i].family, done, last - first);
            }
        }
    }
    if (shows) {
        (void)fprintf(stderr, "\r\033[K");
    }
    print_head(suite->cases[first].family);
    for (size_t i = first; i < last; i++) {
        print_row(&suite->cases[i], &suite->result[i]);
    }
    (void)fflush(stdout);
}

/* Leaves the families whose heading holds the text, or the studies that claim an order. */
static bool choose(struct suite *suite, const char *text, struct solver_error *error)
{
    bool claims = strcmp(text, "claims") == 0;
    size_t kept = 0;
    for (size_t i = 0; i < suite->count; i++) {
        if (claims ? verify_mms_claims(&suite->cases[i]) : strstr(suite->cases[i].family, text) != NULL) {
            suite->cases[kept++] = suite->cases[i];
        }
    }
    if (kept == 0) {
        char families[512] = "";
        for (size_t i = 0, used = 0; i < suite->count && used < sizeof families; i++) {
            if (i == 0 || strcmp(suite->cases[i].family, suite->cases[i - 1].family) != 0) {
                used += (size_t)snprintf(families + used, sizeof families - used, "%s\"%s\"", i == 0 ? "" : ", ",
                                         suite->cases[i].family);
            }
        }
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "verify mms: no family of studies is called \"%.64s\"; there are %s, and claims, those of all "
            "families that claim an order",
            text, families);
    }
    suite->count = kept;
    return true;
}

static void run_suite(struct suite *suite)
{
    for (size_t first = 0; first < suite->count;) {
        size_t last = first;
        while (last < suite->count && strcmp(suite->cases[last].family, suite->cases[first].family) == 0) {
            last++;
        }
        run_family(suite, first, last);
        first = last;
    }
}

/* --- JSON --- */

static void write_variables(FILE *file, const char *key, const double *value)
{
    (void)fprintf(file, ", \"%s\": {", key);
    for (int i = 0; i < VERIFY_MMS_VARIABLES; i++) {
        (void)fprintf(file, "%s\"%s\": ", i == 0 ? "" : ", ", verify_mms_variable_names[i]);
        verify_json_number(file, value[i]);
    }
    (void)fputc('}', file);
}

/* The name of a case, blanks between words made one. */
static void write_name(FILE *file, const struct verify_mms_case *which)
{
    char text[4 * VERIFY_MMS_TEXT];
    size_t used = (size_t)snprintf(text, sizeof text, "%s: ", which->family);
    for (const char *c = which->name; *c != '\0' && used + 1 < sizeof text; c++) {
        if (*c != ' ' || (text[used - 1] != ' ' && c[1] != '\0')) {
            text[used++] = *c;
        }
    }
    while (used > 0 && text[used - 1] == ' ') {
        used--;
    }
    text[used] = '\0';
    verify_json_string(file, text);
}

static void write_gates(FILE *file, const struct suite *suite)
{
    const char *between = "";
    for (size_t i = 0; i < suite->count; i++) {
        const struct verify_mms_case *which = &suite->cases[i];
        for (int v = 0; v < VERIFY_MMS_VARIABLES; v++) {
            double bound = which->asked[v];
            double order = suite->result[i].order[v];
            if (!suite->result[i].asked[v]) {
                continue;
            }
            (void)fprintf(file, "%s\n    {\"name\": \"rate %s\", \"study\": ", between, verify_mms_variable_names[v]);
            write_name(file, which);
            (void)fputs(", \"value\": ", file);
            verify_json_number(file, order);
            (void)fprintf(file, ", \"bound\": %.17g, \"op\": \">=\", \"pass\": %s}", bound,
                          order >= bound ? "true" : "false");
            between = ",";
        }
    }
}

static void write_json(FILE *file, const struct suite *suite, bool pass)
{
    (void)fputs("{\n  \"scene\": \"mms\",\n  \"studies\": [", file);
    for (size_t i = 0; i < suite->count; i++) {
        const struct verify_mms_case *which = &suite->cases[i];
        (void)fprintf(file, "%s\n    {\"name\": ", i == 0 ? "" : ",");
        write_name(file, which);
        (void)fputs(", \"scene\": ", file);
        verify_json_string(file, which->scene);
        (void)fputs(", \"set\": [", file);
        for (size_t s = 0; s < which->setting_count; s++) {
            (void)fputs(s == 0 ? "" : ", ", file);
            verify_json_string(file, which->setting[s]);
        }
        (void)fprintf(file, "], \"levels\": [%d, %d], \"in_time\": %s", which->level[0], which->level[1],
                      which->in_time ? "true" : "false");
        write_variables(file, "errors", suite->result[i].finest);
        write_variables(file, "rates", suite->result[i].order);
        (void)fprintf(file, ", \"seconds\": %.3f, \"pass\": %s}", suite->result[i].seconds,
                      suite->result[i].pass ? "true" : "false");
    }
    (void)fputs("\n  ],\n  \"gates\": [", file);
    write_gates(file, suite);
    (void)fprintf(file, "\n  ],\n  \"pass\": %s\n}\n", pass ? "true" : "false");
}

static bool save_json(const struct suite *suite, const char *path, bool pass, struct solver_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (memory == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "%s: no memory for the report", path);
    }
    write_json(memory, suite, pass);
    bool done = fclose(memory) == 0 && verify_file_write(path, text, size, error);
    free(text);
    return done;
}

/* Before anything is run that would be lost. */
static bool check_files(const struct verify_options *options, struct solver_error *error)
{
    char folder[VERIFY_PATH];
    return verify_out_folder(options, "mms", folder, error) &&
           (options->json == NULL || verify_file_check(options->json, error));
}

static bool save(const struct suite *suite, const struct verify_options *options, bool pass, struct solver_error *error)
{
    char folder[VERIFY_PATH], path[VERIFY_PATH];
    if (!verify_out_folder(options, "mms", folder, error) || !verify_path_join(path, folder, "mms", ".json", error) ||
        !save_json(suite, path, pass, error)) {
        return false;
    }
    (void)printf("\nreport     %s\n", path);
    return options->json == NULL || save_json(suite, options->json, pass, error);
}

/* --- the command --- */

static bool summarise(const struct suite *suite)
{
    size_t failed = 0, claiming = 0;
    double seconds = 0;
    for (size_t i = 0; i < suite->count; i++) {
        claiming += verify_mms_claims(&suite->cases[i]) ? 1 : 0;
        failed += suite->result[i].pass && suite->result[i].ran ? 0 : 1;
        seconds += suite->result[i].seconds;
    }
    (void)printf("\n%zu studies, %zu of which claim an order; %zu fail. %.0f s of one core.\n", suite->count, claiming,
                 failed, seconds);
    (void)printf(failed == 0 ? "PASS: every claim holds\n" : "FAIL: a claim does not hold, or a run broke down\n");
    return failed == 0;
}

/* Cases chosen, run, told and saved; *pass: every claim holds. */
static bool run_chosen(struct suite *suite, const struct verify_options *options, bool *pass,
                       struct solver_error *error)
{
    if (options->override_count > 0 || options->level_count > 0) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "verify mms: the suite sets keys and levels itself and takes neither --set nor --levels; run one "
            "of its scenes, for instance assay verify manufactured --set stencil=closed");
    }
    if (!verify_mms_cases(&suite->cases, &suite->count, error) ||
        (options->operand_count > 1 && !choose(suite, options->operand[1], error)) || !find_scenes(suite, error) ||
        !check_files(options, error)) {
        return false;
    }
    suite->result = calloc(suite->count, sizeof *suite->result);
    if (suite->result == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the suite's results");
    }
    (void)verify_manufactured_find("", "", 0); /* sets up the table, which is not for several threads at a time */
    run_suite(suite);
    *pass = summarise(suite);
    return save(suite, options, *pass, error);
}

int verify_command_mms(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    struct suite *suite = calloc(1, sizeof *suite);
    bool pass = false;
    if (suite == NULL) {
        (void)solver_fail(&error, SOLVER_NO_MEMORY, "no memory for the suite");
        return verify_complain(&error);
    }
    bool done = run_chosen(suite, options, &pass, &error);
    free(suite->cases);
    free(suite->result);
    free(suite);
    if (!done) {
        return verify_complain(&error);
    }
    return pass ? VERIFY_PASSED : VERIFY_FAILED;
}
