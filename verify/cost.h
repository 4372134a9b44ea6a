/* What a scene switches on, what each item costs, and what would be saved without it. */
#ifndef VERIFY_COST_H
#define VERIFY_COST_H

#include "solver/run.h"
#include "verify/options.h"

/* One configuration of the scene: declared operations and memory (solver/cost.h), and its steps timed. */
struct verify_cost_case {
    bool runs;                 /* else `why` says why not */
    struct solver_error why;   /* of the build, or of the steps */
    struct solver_facts facts; /* of the run when it was built */
    struct solver_cost_arrays arrays;
    struct solver_cost_terms terms;
    int stages;
    double flops;   /* per particle and step */
    double bytes;   /* per particle, all that is allocated */
    double seconds; /* per particle and step; NAN if it was not timed */
};

/* What may be left out, in the words that leave it out. */
struct verify_cost_item {
    const char *name, *words; /* of --set, separated by blanks; NULL: no key does */
    struct verify_cost_case without;
    double beside; /* seconds of the whole scene's particle and step, timed just before */
};

enum { VERIFY_COST_ITEMS = 24 };

struct verify_cost {
    struct solver_scene *scene;
    struct verify_cost_case whole;
    size_t item_count;
    struct verify_cost_item item[VERIFY_COST_ITEMS];
    /* The recorded history: rows over t_end or as many as there are steps, bytes of each, seconds that one takes. */
    double rows, row_bytes, row_seconds, steps;
    int stopped; /* by this signal (signals.h), after the items that there are; 0: all there is was measured */
};

/* Builds and times the scene and each of its variants; what is measured when the program is asked to end is the last.
 * False if the scene itself does not run. *cost is the caller's to
 * free. */
bool verify_cost_measure(const struct verify_options *options, struct verify_cost *cost, struct solver_error *error);
void verify_cost_free(struct verify_cost *cost);

void verify_cost_print(const struct verify_cost *cost);
/* A verify_writer (report.h) of a struct verify_cost. */
bool verify_cost_json(FILE *file, const void *cost, struct solver_error *error);

#endif
