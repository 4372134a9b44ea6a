#include "solver/scheme.h"

#include "solver/pieces.h"

#include <math.h>
#include <string.h>

static const struct solver_scheme *const schemes[] = {
    &solver_scheme_upwind,
    &solver_scheme_jst,
    &solver_scheme_ulsph,
    NULL,
};

const struct solver_scheme *const *solver_schemes(void)
{
    return schemes;
}

const struct solver_scheme *solver_scheme_find(const char *name)
{
    for (const struct solver_scheme *const *scheme = schemes; *scheme != NULL; scheme++) {
        if (strcmp((*scheme)->name, name) == 0) {
            return *scheme;
        }
    }
    return NULL;
}

bool solver_scheme_evaluate(const struct solver_scheme *scheme, void *system, size_t count, double t, double dt,
                            struct solver_error *error)
{
    if (scheme->evaluate != NULL) {
        return scheme->evaluate(system, t, dt, error);
    }
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            scheme->gradients(system, false, at.begin, at.end);
        }
#pragma omp for schedule(static)
        for (size_t piece = 0; piece < solver_pieces(count); piece++) {
            struct solver_piece at = solver_piece_at(piece, count);
            scheme->rates(system, false, at.begin, at.end);
        }
    }
    return true;
}

double solver_scheme_largest_step(const struct solver_scheme *scheme, const void *system, size_t count)
{
    double fastest = 0.0;
#pragma omp parallel for schedule(static) reduction(max : fastest)
    for (size_t piece = 0; piece < solver_pieces(count); piece++) {
        struct solver_piece at = solver_piece_at(piece, count);
        fastest = fmax(fastest, scheme->fastest(system, at.begin, at.end));
    }
    return scheme->largest_step(system, fastest);
}
