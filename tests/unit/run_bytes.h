/* All that a run shows, byte by byte: its record, and what its history has beside that. */
#ifndef TESTS_RUN_BYTES_H
#define TESTS_RUN_BYTES_H

#include "solver/record_format.h"
#include "tests/unit/unit.h"

#include <stdlib.h>
#include <string.h>

struct run_bytes {
    void *record;
    size_t size;
    uint64_t bodies[SOLVER_BODIES][3], contact[2]; /* bits of numbers, of which some may be NaN */
};

static inline struct run_bytes run_bytes_of(const struct solver_scene *scene, struct solver_run *run)
{
    struct solver_error error = {.text = ""};
    struct solver_output output;
    struct solver_record *record;
    struct run_bytes bytes;
    const struct solver_history *history = solver_run_history(run);
    CU_ASSERT_FATAL(solver_run_output(run, &output, &error));
    CU_ASSERT_FATAL(solver_record_make(scene, &output, history, "", "", &record, &error));
    CU_ASSERT_FATAL(record_to_hdf5(record, &bytes.record, &bytes.size, &error));
    solver_record_free(record);
    memcpy(bytes.bodies, history->body_velocity, sizeof bytes.bodies);
    memcpy(&bytes.contact[0], &history->contact_begin, sizeof bytes.contact[0]);
    memcpy(&bytes.contact[1], &history->contact_end, sizeof bytes.contact[1]);
    return bytes;
}

static inline bool run_bytes_same(const struct run_bytes *left, const struct run_bytes *right)
{
    return left->size == right->size && memcmp(left->record, right->record, left->size) == 0 &&
           memcmp(left->bodies, right->bodies, sizeof left->bodies) == 0 &&
           memcmp(left->contact, right->contact, sizeof left->contact) == 0;
}

/* Goes on until so many steps have been made since the start; false if the run does not come so far. */
static inline bool run_bytes_until(void *context, double time, double t_end, size_t step)
{
    (void)time;
    (void)t_end;
    return step < *(const size_t *)context;
}

static inline bool run_to_step(const struct solver_scene *scene, struct solver_run *run, size_t step,
                               struct solver_error *error)
{
    return solver_run_to(run, scene->t_end, run_bytes_until, &step, error) && solver_run_facts(run).steps == step;
}

#endif
