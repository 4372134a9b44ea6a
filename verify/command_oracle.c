#include "verify/commands.h"
#include "verify/judge.h"
#include "verify/report.h"
#include "verify/sample_write.h"
#include "verify/terminal.h"
#include "verify/told.h"
#include "verify/units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TIMES = VERIFY_SAMPLES, MOST_PLACES = 1 << 26 };

struct work {
    const struct verify_options *options;
    struct verify_truth truth;
    struct verify_samples places, answers;
    size_t times;
    double time[TIMES]; /* [s] */
};

/* "X0:X1:N" */
static bool read_range(const char *text, double *from, double *to, size_t *count, const char **rest)
{
    char *end = NULL;
    *from = strtod(text, &end);
    bool ok = end != text && *end == ':';
    const char *next = ok ? end + 1 : text;
    *to = strtod(next, &end);
    ok = ok && end != next && *end == ':';
    next = ok ? end + 1 : text;
    long n = strtol(next, &end, 10);
    *rest = *end == ',' ? end + 1 : end;
    *count = n > 0 ? (size_t)n : 0;
    return ok && end != next && (*end == ',' || *end == '\0') && isfinite(*from) && isfinite(*to) && n >= 1 &&
           n <= MOST_PLACES && (n == 1 ? *to == *from : *to > *from);
}

struct grid {
    size_t count[3];
    double from[3], step[3];
};

static bool read_grid(const char *text, int dim, struct grid *grid, struct solver_error *error)
{
    const char *at = text;
    size_t total = 1;
    bool ok = true;
    *grid = (struct grid){.count = {1, 1, 1}};
    for (int i = 0; ok && i < dim; i++) {
        double to;
        ok = read_range(at, &grid->from[i], &to, &grid->count[i], &at) && grid->count[i] <= MOST_PLACES / total;
        total *= ok ? grid->count[i] : 1;
        grid->step[i] = ok && grid->count[i] > 1 ? (to - grid->from[i]) / (double)(grid->count[i] - 1) : 0;
    }
    return (ok && *at == '\0') ||
           solver_fail(error, SOLVER_BAD_INPUT,
                       "--grid %.200s: expected X0:X1:N for each of %d axes, X0 < X1 and N from 2, or X0:X0:1, with "
                       "commas between, and at most %d places",
                       text, dim, (int)MOST_PLACES);
}

/* Weights are those of the trapezium rule, so that norms over the places are integrals. */
static bool make_grid(struct work *work, struct solver_error *error)
{
    struct grid grid;
    int dim = work->truth.kind->dim;
    struct verify_sample *sample = verify_samples_add(&work->places, "--grid", error);
    if (sample == NULL || !read_grid(work->options->grid, dim, &grid, error) ||
        !verify_sample_points(sample, grid.count[0] * grid.count[1] * grid.count[2], dim, error) ||
        !verify_sample_weights(sample, error)) {
        return false;
    }
    for (size_t a = 0; a < sample->count; a++) {
        size_t at = a;
        sample->weight[a] = 1;
        for (int i = 0; i < dim; i++) {
            size_t k = at % grid.count[i], last = grid.count[i] - 1;
            at /= grid.count[i];
            sample->X[3 * a + (size_t)i] = grid.from[i] + grid.step[i] * (double)k;
            sample->weight[a] *= last == 0 ? 1 : grid.step[i] * (k == 0 || k == last ? 0.5 : 1);
        }
    }
    if (grid.step[0] > 0) {
        sample->h.value = grid.step[0];
    }
    return true;
}

/* Numbers of the file in SI units. */
static bool to_si(struct verify_sample *sample, struct solver_error *error)
{
    double length = 1, time = 1, h = 1;
    if ((sample->has_unit && !verify_unit_factor(sample->unit, "m", &length)) ||
        (sample->time.has_unit && !verify_unit_factor(sample->time.unit, "s", &time)) ||
        (sample->h.has_unit && !verify_unit_factor(sample->h.unit, "m", &h))) {
        return verify_sample_refuse(sample, error,
                                    "points are in [%s], time in [%s], h in [%s]; expected m and s, or "
                                    "these with a prefix",
                                    sample->unit, sample->time.unit, sample->h.unit);
    }
    for (size_t i = 0; i < 3 * sample->count; i++) {
        sample->X[i] *= length;
    }
    sample->time.value *= time;
    sample->h.value *= h;
    return true;
}

/* Refuses places outside the body, or with --inside leaves them out. */
static bool keep_inside(const struct work *work, struct verify_sample *sample, struct solver_error *error)
{
    double slack = verify_judged_slack(sample, work->truth.kind->dim, sample->X);
    size_t kept = 0;
    for (size_t a = 0; a < sample->count; a++) {
        const double *X = sample->X + 3 * a;
        double outside = work->truth.kind->outside(work->truth.oracle, X);
        if (!(outside <= slack)) {
            if (!work->options->inside) {
                return verify_sample_refuse(sample, error,
                                            "point %zu, (%.9g, %.9g, %.9g) m, lies %.3g m outside the body; --inside "
                                            "leaves such out",
                                            a, X[0], X[1], X[2], outside);
            }
            continue;
        }
        memmove(sample->X + 3 * kept, X, 3 * sizeof *X);
        if (sample->weight != NULL) {
            sample->weight[kept] = sample->weight[a];
        }
        kept++;
    }
    sample->count = kept;
    return kept > 0 || verify_sample_refuse(sample, error, "none of its points lies within the body");
}

static bool take_places(struct work *work, struct solver_error *error)
{
    const struct verify_options *options = work->options;
    if ((options->points == NULL) == (options->grid == NULL)) {
        return solver_fail(error, SOLVER_BAD_INPUT, "assay oracle wants --points FILE or --grid X0:X1:N,...");
    }
    if (options->grid != NULL ? !make_grid(work, error) : !verify_sample_read(options->points, &work->places, error)) {
        return false;
    }
    for (size_t i = 0; i < work->places.count; i++) {
        struct verify_sample *sample = work->places.sample[i];
        if (sample->dim < work->truth.kind->dim) {
            return verify_sample_refuse(sample, error, "points have %d coordinates; the oracle is %dD", sample->dim,
                                        work->truth.kind->dim);
        }
        if (!to_si(sample, error) || !keep_inside(work, sample, error)) {
            return false;
        }
    }
    return true;
}

/* Those of --time; without it the file's own, which each sample has for itself. */
static bool take_times(struct work *work, struct solver_error *error)
{
    if (work->options->times != NULL) {
        return verify_told_numbers("--time", work->options->times, work->time, TIMES, &work->times, error);
    }
    for (size_t i = 0; i < work->places.count; i++) {
        if (isnan(work->places.sample[i]->time.value)) {
            return verify_sample_refuse(work->places.sample[i], error,
                                        "does not say its time; give --time T[,T...] [s]");
        }
    }
    return true;
}

static bool add_fields(const struct oracle_kind *kind, struct verify_sample *sample, size_t of[VERIFY_SAMPLE_FIELDS],
                       struct solver_error *error)
{
    int width_of[] = {1, kind->dim, kind->dim * kind->dim};
    for (size_t field = 0; field < verify_judged_count(kind); field++) {
        struct verify_judged_field about = verify_judged_field(kind, field);
        if (field == VERIFY_P_ALL || field == VERIFY_SIGMA_ALL) {
            continue; /* other errors of fields that are there */
        }
        struct verify_sample_field *added = verify_sample_add(sample, about.name, width_of[about.shape], error);
        if (added == NULL) {
            return false;
        }
        (void)snprintf(added->unit, sizeof added->unit, "%s", about.unit);
        of[sample->field_count - 1] = field;
    }
    return true;
}

/* The oracle's fields at one place into the sample. */
static void answer_at(const struct work *work, struct verify_sample *sample, size_t a,
                      const size_t of[VERIFY_SAMPLE_FIELDS], const struct oracle_state *state, const double *extra)
{
    size_t dim = (size_t)work->truth.kind->dim;
    for (size_t i = 0; i < sample->field_count; i++) {
        double value[9];
        size_t width = (size_t)sample->field[i].width,
               full = verify_judged_exact(&work->truth, of[i], state, extra, value);
        for (size_t j = 0; j < width; j++) {
            sample->field[i].value[a * width + j] = value[full == 9 ? j / dim * 3 + j % dim : j];
        }
    }
}

static bool answer(struct work *work, const struct verify_sample *places, double time, struct solver_error *error)
{
    const struct oracle_kind *kind = work->truth.kind;
    size_t of[VERIFY_SAMPLE_FIELDS] = {0};
    if (!(time >= 0)) {
        return verify_sample_refuse(places, error, "t = %.12g s; every oracle begins at t = 0", time);
    }
    struct verify_sample *sample = verify_samples_add(&work->answers, places->place, error);
    if (sample == NULL || !verify_sample_points(sample, places->count, kind->dim, error) ||
        !add_fields(kind, sample, of, error) || (places->weight != NULL && !verify_sample_weights(sample, error))) {
        return false;
    }
    memcpy(sample->X, places->X, 3 * places->count * sizeof *places->X);
    if (places->weight != NULL) {
        memcpy(sample->weight, places->weight, places->count * sizeof *places->weight);
    }
    sample->time.value = time;
    sample->h.value = places->h.value;
    for (size_t a = 0; a < places->count; a++) {
        struct oracle_state state;
        double extra[ORACLE_EXTRAS] = {0};
        kind->state(work->truth.oracle, places->X + 3 * a, time, &state);
        if (kind->extras != NULL) {
            kind->extras(work->truth.oracle, places->X + 3 * a, time, extra);
        }
        if (!isfinite(state.u[0])) {
            return verify_sample_refuse(places, error, "the oracle \"%s\" does not reach t = %.9g s", kind->name, time);
        }
        answer_at(work, sample, a, of, &state, extra);
    }
    return true;
}

static bool answer_all(struct work *work, struct solver_error *error)
{
    for (size_t i = 0; i < work->places.count; i++) {
        const struct verify_sample *places = work->places.sample[i];
        for (size_t j = 0; j < (work->times > 0 ? work->times : 1); j++) {
            if (!answer(work, places, work->times > 0 ? work->time[j] : places->time.value, error)) {
                return false;
            }
        }
    }
    return true;
}

static void write_table_to(FILE *file, const struct work *work)
{
    const struct verify_sample *sample = work->answers.sample[0];
    enum verify_columns columns[VERIFY_SAMPLE_FIELDS];
    for (size_t i = 0; i < sample->field_count; i++) {
        size_t field = 0;
        while (!verify_judged_is(work->truth.kind, field, sample->field[i].name)) {
            field++;
        }
        enum verify_shape shape = verify_judged_field(work->truth.kind, field).shape;
        columns[i] = shape == VERIFY_SCALAR ? VERIFY_PLAIN : shape == VERIFY_VECTOR ? VERIFY_BY_AXIS : VERIFY_BY_PAIR;
    }
    verify_sample_write_csv(file, sample, columns);
}

/* A verify_writer. */
static bool write_table(FILE *file, const void *context, struct solver_error *error)
{
    (void)error;
    write_table_to(file, context);
    return true;
}

static bool ends_in(const char *path, const char *ending)
{
    size_t length = strlen(path), size = strlen(ending);
    return length > size && strcmp(path + length - size, ending) == 0;
}

static bool write_answers(const struct work *work, struct solver_error *error)
{
    const char *path = work->options->table;
    bool hdf5 = path != NULL && ends_in(path, ".h5"), table = path == NULL || ends_in(path, ".csv");
    if (!hdf5 && !table) {
        return solver_fail(error, SOLVER_BAD_INPUT, "--output %.300s: expected a name that ends in .h5 or .csv", path);
    }
    if (table && work->answers.count > 1) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "a table holds one time and one level, not %zu; write them with -o FILE.h5",
                           work->answers.count);
    }
    if (path == NULL) {
        write_table_to(stdout, work);
        return true;
    }
    if (!(hdf5 ? verify_sample_write_hdf5(path, &work->answers, error)
               : verify_report_write(path, write_table, work, error))) {
        return false;
    }
    verify_print_truth(stdout, &work->truth);
    (void)printf("\nfields     %s\n", path);
    return true;
}

static bool run(struct work *work, struct solver_error *error)
{
    return take_places(work, error) && take_times(work, error) && answer_all(work, error) && write_answers(work, error);
}

int verify_command_oracle(const struct verify_options *options)
{
    struct solver_error error = {.code = SOLVER_OK};
    static struct work work; /* too large for the stack of some systems */
    work = (struct work){.options = options};
    bool told = verify_told_oracle(options->operand[0], options, &work.truth, &error);
    if (told && !work.truth.proven) {
        verify_print_truth(stderr, &work.truth);
    }
    bool done = told && (!work.truth.proven || run(&work, &error));
    bool proven = work.truth.proven;
    verify_samples_free(&work.places);
    verify_samples_free(&work.answers);
    verify_truth_free(&work.truth);
    return !done ? verify_complain(&error) : proven ? VERIFY_PASSED : VERIFY_FAILED;
}
