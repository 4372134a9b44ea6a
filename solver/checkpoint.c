#include "solver/checkpoint.h"

#include "solver/build.h"
#include "solver/keep.h"
#include "solver/memory.h"
#include "solver/path.h"
#include "solver/run_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct solver_checkpoint {
    struct solver_keeper keeper;
    char *path;
    struct solver_checkpoint_about about;
    size_t state; /* where in the file the state begins */
};

/* --- what is kept --- */

static bool keep_place(struct solver_keeper *keeper, struct solver_run *run, struct solver_error *error)
{
    return solver_keep(keeper, "time", &run->time, sizeof run->time, 1, error) &&
           solver_keep(keeper, "step", &run->step, sizeof run->step, 1, error) &&
           solver_keep(keeper, "work of loads", &run->external, sizeof run->external, 1, error) &&
           solver_keep(keeper, "numerical dissipation", &run->numerical, sizeof run->numerical, 1, error) &&
           solver_keep(keeper, "bound of what moved faces put in", &run->driven, sizeof run->driven, 1, error) &&
           solver_keep(keeper, "seconds", &run->seconds, sizeof run->seconds, 1, error);
}

/* All fields, also those that follow from others: what a plastic material remembers does not, and which do is for the
 * schemes to know. Rates and stages are within a step. */
static bool keep_fields(struct solver_keeper *keeper, struct solver_run *run, struct solver_error *error)
{
    const struct solver_state *state = &run->state;
    for (size_t i = 0; i < state->field_count; i++) {
        const struct solver_field *field = &state->field[i];
        char name[sizeof keeper->head->name];
        (void)snprintf(name, sizeof name, "field %s", field->name);
        void *value = state->in_single ? (void *)*field->single : (void *)*field->value;
        if (!solver_keep(keeper, name, value, field->width * solver_state_bytes(state), state->count, error)) {
            return false;
        }
    }
    return true;
}

/* The walk. */
static bool keep_state(struct solver_keeper *keeper, struct solver_run *run, struct solver_error *error)
{
    return keep_place(keeper, run, error) && keep_fields(keeper, run, error) &&
           (run->scheme->keep == NULL || run->scheme->keep(run->system, keeper, error)) &&
           solver_contact_keep(&run->contact, keeper, error) && solver_wall_keep(&run->wall, keeper, error) &&
           solver_projection_keep(&run->projection, keeper, error) && solver_run_keep_history(run, keeper, error);
}

/* --- texts --- */

/* One text and where it is put, with its final zero byte. */
struct text {
    const char *name;
    const char **place;
};

enum { TEXTS = 8 };

static void list_texts(struct solver_checkpoint_about *about, struct text text[TEXTS])
{
    const struct text all[TEXTS] = {
        {"version", &about->version},  {"build", &about->build},           {"loops", &about->loops},
        {"command", &about->command},  {"scene path", &about->scene_path}, {"scene file", &about->scene_file},
        {"scene", &about->scene_text}, {"overrides", &about->overrides},
    };
    memcpy(text, all, sizeof all);
}

/* What a checkpoint is written from, which must last until it is. */
struct notes {
    struct solver_checkpoint_about about;
    double number[2];  /* every_seconds, time */
    uint64_t count[2]; /* every_steps, step */
};

static bool keep_notes(struct solver_keeper *keeper, struct notes *notes, struct solver_error *error)
{
    struct text text[TEXTS];
    list_texts(&notes->about, text);
    for (size_t i = 0; i < TEXTS; i++) {
        const char *what = *text[i].place;
        if (!solver_keep(keeper, text[i].name, (void *)what, 1, strlen(what) + 1, error)) {
            return false;
        }
    }
    return solver_keep(keeper, "numbers", notes->number, sizeof *notes->number, 2, error) &&
           solver_keep(keeper, "counts", notes->count, sizeof *notes->count, 2, error);
}

bool solver_checkpoint_write(const char *path, const struct solver_run *run,
                             const struct solver_checkpoint_about *about, struct solver_error *error)
{
    struct solver_keeper keeper;
    struct notes notes = {*about, {about->every_seconds, run->time}, {about->every_steps, run->step}};
    notes.about.build = solver_build();
    notes.about.loops = solver_build_loops();
    solver_keep_begin(&keeper, path);
    /* the walk goes both ways; this way it changes nothing */
    return keep_notes(&keeper, &notes, error) && keep_state(&keeper, (struct solver_run *)run, error) &&
           solver_keep_write(&keeper, error);
}

static bool read_notes(struct solver_checkpoint *checkpoint, struct solver_error *error)
{
    struct solver_keeper *keeper = &checkpoint->keeper;
    struct solver_checkpoint_about *about = &checkpoint->about;
    struct notes notes;
    struct text text[TEXTS];
    list_texts(about, text);
    for (size_t i = 0; i < TEXTS; i++) {
        const void *data = NULL;
        size_t size = 0;
        if (!solver_keep_peek(keeper, text[i].name, &data, &size, error)) {
            return false;
        }
        if (size == 0 || memchr(data, '\0', size) != (const char *)data + size - 1) {
            return solver_keep_refuse(keeper, error, "its \"%s\" is no text", text[i].name);
        }
        *text[i].place = data;
    }
    if (!solver_keep(keeper, "numbers", notes.number, sizeof *notes.number, 2, error) ||
        !solver_keep(keeper, "counts", notes.count, sizeof *notes.count, 2, error)) {
        return false;
    }
    about->every_seconds = notes.number[0];
    about->time = notes.number[1];
    about->every_steps = notes.count[0];
    about->step = notes.count[1];
    checkpoint->state = keeper->at;
    return (isfinite(about->every_seconds) && about->every_seconds >= 0.0 && isfinite(about->time)) ||
           solver_keep_refuse(keeper, error, "its \"numbers\" are not finite, or below 0");
}

/* A run that goes on gives the same bytes only by the same arithmetic. */
static bool check_build(const struct solver_checkpoint *checkpoint, struct solver_error *error)
{
    const struct solver_checkpoint_about *about = &checkpoint->about;
    if (strcmp(about->build, solver_build()) != 0) {
        return solver_keep_refuse(&checkpoint->keeper, error,
                                  "a build by %.160s wrote it, and this is one by %.160s, whose results may differ in "
                                  "their last digits; go on with the one that wrote it",
                                  about->build, solver_build());
    }
    return strcmp(about->loops, solver_build_loops()) == 0 ||
           solver_keep_refuse(&checkpoint->keeper, error,
                              "its loops had %.32s multiplications and additions, and those for %s have %s ones, whose "
                              "results differ in their last digits; go on %s",
                              about->loops, solver_path_name(solver_path()), solver_build_loops(),
                              strcmp(about->loops, "separate") == 0
                                  ? "with ASSAY_ISA=baseline in the environment"
                                  : "without ASSAY_ISA=baseline, on a processor that has AVX2");
}

bool solver_checkpoint_read(const char *path, struct solver_checkpoint **out, struct solver_error *error)
{
    struct solver_checkpoint *checkpoint = NULL;
    *out = NULL;
    if (!solver_alloc((void **)&checkpoint, 1, sizeof *checkpoint, "checkpoint", error)) {
        return false;
    }
    checkpoint->path = strdup(path);
    bool good = checkpoint->path != NULL || solver_fail(error, SOLVER_NO_MEMORY, "checkpoint: no memory for its name");
    if (!good || !solver_keep_open(&checkpoint->keeper, checkpoint->path, error) || !read_notes(checkpoint, error) ||
        !check_build(checkpoint, error)) {
        solver_checkpoint_free(checkpoint);
        return false;
    }
    *out = checkpoint;
    return true;
}

void solver_checkpoint_free(struct solver_checkpoint *checkpoint)
{
    if (checkpoint != NULL) {
        solver_keep_close(&checkpoint->keeper);
        free(checkpoint->path);
    }
    free(checkpoint);
}

const struct solver_checkpoint_about *solver_checkpoint_about(const struct solver_checkpoint *checkpoint)
{
    return &checkpoint->about;
}

/* --- putting back --- */

/* The first field that holds what is no number; NULL: none does. Of some none is seen in what a step checks, H of a
 * linear material for one. */
static const char *without_number(const struct solver_state *state)
{
    for (const struct solver_field *field = state->field; field < state->field + state->field_count; field++) {
        for (size_t k = 0; k < field->width * state->count; k++) {
            if (!isfinite(state->in_single ? (double)(*field->single)[k] : (*field->value)[k])) {
                return field->name;
            }
        }
    }
    return NULL;
}

/* A sealed file may still have been made up. */
static bool check(const struct solver_checkpoint *checkpoint, struct solver_run *run, struct solver_error *error)
{
    struct solver_error broken;
    if (run->time != checkpoint->about.time || run->step != checkpoint->about.step || !(run->time >= 0.0) ||
        run->time > run->scene->t_end) {
        return solver_keep_refuse(&checkpoint->keeper, error,
                                  "it stands at t = %g s, step %zu, which is not on the way to t_end = %g s", run->time,
                                  run->step, run->scene->t_end);
    }
    if (!isfinite(run->external) || !isfinite(run->numerical) || !(run->driven >= 0.0) || !isfinite(run->driven) ||
        !(run->seconds >= 0.0) || !isfinite(run->seconds)) {
        return solver_keep_refuse(&checkpoint->keeper, error, "its work, dissipation or seconds are no numbers");
    }
    if (!solver_run_check(run, &broken)) {
        return solver_keep_refuse(&checkpoint->keeper, error, "its state is broken: %.300s", broken.text);
    }
    const char *field = without_number(&run->state);
    return field == NULL || solver_keep_refuse(&checkpoint->keeper, error, "its field %s is not finite", field);
}

bool solver_checkpoint_restore(struct solver_checkpoint *checkpoint, struct solver_run *run, struct solver_error *error)
{
    struct solver_keeper *keeper = &checkpoint->keeper;
    struct solver_error why = {.code = SOLVER_OK};
    keeper->at = checkpoint->state;
    run->fastest = 0.0;
    if (!keep_state(keeper, run, &why)) {
        *error = why;
        return why.code != SOLVER_BROKE_DOWN ? false : solver_keep_refuse(keeper, error, "%.400s", why.text);
    }
    return solver_keep_end(keeper, error) && check(checkpoint, run, error);
}
