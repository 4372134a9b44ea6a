#include "solver/cost.h"

#include "solver/memory.h"

void solver_cost_bytes(struct solver_cost_arrays *arrays, const char *group, const char *name, size_t bytes)
{
    if (bytes > 0 && arrays->count < SOLVER_COST_ARRAYS) {
        arrays->array[arrays->count++] = (struct solver_cost_array){group, name, bytes};
    }
}

void solver_cost_array(struct solver_cost_arrays *arrays, const char *group, const char *name, const void *array,
                       size_t count, size_t size)
{
    solver_cost_bytes(arrays, group, name, array != NULL ? solver_alloc_bytes(count, size) : 0);
}

size_t solver_cost_total(const struct solver_cost_arrays *arrays)
{
    size_t bytes = 0;
    for (size_t i = 0; i < arrays->count; i++) {
        bytes += arrays->array[i].bytes;
    }
    return bytes;
}

static void add(struct solver_cost_terms *terms, struct solver_cost_term term)
{
    if (term.flops > 0.0 && terms->count < SOLVER_COST_TERMS) {
        terms->term[terms->count++] = term;
    }
}

void solver_cost_term(struct solver_cost_terms *terms, const char *name, int loop, double flops)
{
    add(terms, (struct solver_cost_term){name, loop, false, flops});
}

void solver_cost_once(struct solver_cost_terms *terms, const char *name, double flops)
{
    add(terms, (struct solver_cost_term){name, 0, true, flops});
}

double solver_cost_flops(const struct solver_cost_terms *terms, int stages)
{
    double flops = 0.0;
    for (size_t i = 0; i < terms->count; i++) {
        flops += terms->term[i].flops * (terms->term[i].once ? 1.0 : (double)stages);
    }
    return flops;
}
