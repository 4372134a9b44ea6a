/* What a run keeps and what a step of it does, item by item. Each item is declared beside what allocates it or computes
 * it; tests hold the sums to the allocator, and to the operations of a program in which each one is counted.
 *
 * Operations are counted as written: an addition, subtraction, multiplication, division or square root of
 * floating-point numbers is one, another function of the mathematical library 20; signs, comparisons and conversions
 * are none. An operation on a padded vector counts all its lanes (dim.h), since that is what is computed. What depends
 * on the data, such as sweeps to a spectrum or pairs within reach, is declared as the most that is usual. Formulas of a
 * scene are not counted. */
#ifndef SOLVER_COST_H
#define SOLVER_COST_H

#include <stdbool.h>
#include <stddef.h>

enum { SOLVER_COST_ARRAYS = 80, SOLVER_COST_TERMS = 48, SOLVER_COST_FUNCTION = 20 };

struct solver_cost_array {
    const char *group, *name;
    size_t bytes; /* as the allocator was asked for */
};

struct solver_cost_arrays {
    size_t count;
    struct solver_cost_array array[SOLVER_COST_ARRAYS];
};

struct solver_cost_term {
    const char *name;
    int loop;     /* of one right-hand side, over the pairs: the first, second ...; 0: over particles */
    bool once;    /* in a step, instead of in each of its right-hand sides */
    double flops; /* of all particles, each time */
};

struct solver_cost_terms {
    size_t count;
    struct solver_cost_term term[SOLVER_COST_TERMS];
};

/* An array of solver_alloc. Of what is NULL, nothing. */
void solver_cost_array(struct solver_cost_arrays *arrays, const char *group, const char *name, const void *array,
                       size_t count, size_t size);
/* Bytes as they are. */
void solver_cost_bytes(struct solver_cost_arrays *arrays, const char *group, const char *name, size_t bytes);
size_t solver_cost_total(const struct solver_cost_arrays *arrays);

/* Terms without operations are left out. */
void solver_cost_term(struct solver_cost_terms *terms, const char *name, int loop, double flops);
/* The same, once in a step. */
void solver_cost_once(struct solver_cost_terms *terms, const char *name, double flops);
/* Of all particles in one step of so many right-hand sides. */
double solver_cost_flops(const struct solver_cost_terms *terms, int stages);

#endif
