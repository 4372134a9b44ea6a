#include "oracles/ritz_system.h"

#include <stdlib.h>
#include <string.h>

/* -1 where u_x = 0 by symmetry. */
static int local(const struct ritz_system *s, int component, int j)
{
    return component == 0 ? j - 1 : s->y->functions - 1 + j;
}

/* Bubbles from the highest order down, and a node only after the bubbles of both its elements: so bubbles couple with
 * two blocks before them, and only the few nodes have long rows. */
static void order(struct ritz_system *s)
{
    int next = 0;
    for (int e = 0; e < s->x->elements; e++) {
        for (int a = s->x->first[e + 1] - 1; a > s->x->first[e]; a--) {
            s->block[a] = next++;
        }
        s->block[s->x->first[e]] = e == 0 ? -1 : next++;
    }
    s->block[s->x->functions - 1] = next++;
}

bool ritz_system_unknown(const struct ritz_system *s, int a, int component, int j, size_t *index)
{
    int at = local(s, component, j);
    *index = (size_t)(s->block[a] * s->block_size + at);
    return s->block[a] >= 0 && at >= 0;
}

/* Integral of lambda div v div u + 2 e(v) : e(u) for one pair of products. */
static double stiffness(const struct ritz_system *s, int c, int a, int i, int d, int b, int j)
{
    const struct axis_matrices *X = &s->of_x, *Y = &s->of_y;
    int n = s->x->functions, m = s->y->functions, ab = a * n + b, ba = b * n + a, ij = i * m + j, ji = j * m + i;
    double stretch = s->lambda + 2;
    if (c == 0 && d == 0) {
        return stretch * X->stiffness[ab] * Y->mass[ij] + X->mass[ab] * Y->stiffness[ij];
    }
    if (c == 1 && d == 1) {
        return X->stiffness[ab] * Y->mass[ij] + stretch * X->mass[ab] * Y->stiffness[ij];
    }
    if (c == 0) {
        return s->lambda * X->mixed[ba] * Y->mixed[ij] + X->mixed[ab] * Y->mixed[ji];
    }
    return s->lambda * X->mixed[ab] * Y->mixed[ji] + X->mixed[ba] * Y->mixed[ij];
}

/* Rows begin at the first block that they couple with. */
static bool allocate(struct ritz_system *s)
{
    size_t *first = malloc(s->unknowns * sizeof *first);
    if (first == NULL) {
        return false;
    }
    for (int a = 0; a < s->x->functions; a++) {
        int begin = s->block[a];
        for (int b = 0; b < s->x->functions && begin >= 0; b++) {
            if (s->block[b] >= 0 && s->block[b] < begin && axis_coupled(s->x, a, b)) {
                begin = s->block[b];
            }
        }
        for (int k = 0; k < s->block_size && begin >= 0; k++) {
            first[s->block[a] * s->block_size + k] = (size_t)(begin * s->block_size);
        }
    }
    bool done = skyline_create(&s->stiffness, s->unknowns, first);
    free(first);
    return done;
}

static void assemble_pair(struct ritz_system *s, int a, int b)
{
    for (int c = 0; c < 2; c++) {
        for (int i = 0; i < s->y->functions; i++) {
            for (int d = 0; d < 2; d++) {
                for (int j = 0; j < s->y->functions; j++) {
                    size_t row, column;
                    if (ritz_system_unknown(s, a, c, i, &row) && ritz_system_unknown(s, b, d, j, &column) &&
                        column <= row) {
                        skyline_add(&s->stiffness, row, column, stiffness(s, c, a, i, d, b, j));
                    }
                }
            }
        }
    }
}

static void assemble(struct ritz_system *s)
{
    for (int a = 0; a < s->x->functions; a++) {
        for (int b = 0; b < s->x->functions; b++) {
            if (s->block[a] >= s->block[b] && s->block[b] >= 0 && axis_coupled(s->x, a, b)) {
                assemble_pair(s, a, b);
            }
        }
    }
}

/* out = M z. */
void ritz_system_mass(const struct ritz_system *s, const double *z, double *out)
{
    int m = s->y->functions;
    memset(out, 0, s->unknowns * sizeof *out);
    for (int a = 0; a < s->x->functions; a++) {
        for (int b = 0; b < s->x->functions; b++) {
            if (s->block[a] < 0 || s->block[b] < 0 || !axis_coupled(s->x, a, b)) {
                continue;
            }
            double weight = s->of_x.mass[a * s->x->functions + b];
            for (int c = 0; c < 2; c++) {
                for (int i = 1 - c; i < m; i++) {
                    double sum = 0;
                    const double *from = z + s->block[b] * s->block_size + local(s, c, 0);
                    for (int j = 1 - c; j < m; j++) {
                        sum += s->of_y.mass[i * m + j] * from[j];
                    }
                    out[s->block[a] * s->block_size + local(s, c, i)] += weight * sum;
                }
            }
        }
    }
}

bool ritz_system_create(struct ritz_system *s, const struct axis *x, const struct axis *y, double lambda)
{
    *s = (struct ritz_system){.lambda = lambda, .x = x, .y = y, .block_size = 2 * y->functions - 1};
    s->unknowns = (size_t)((x->functions - 1) * s->block_size);
    s->block = malloc((size_t)x->functions * sizeof *s->block);
    if (s->block == NULL || !axis_integrate(x, &s->of_x) || !axis_integrate(y, &s->of_y)) {
        return false;
    }
    order(s);
    if (!allocate(s)) {
        return false;
    }
    assemble(s);
    return skyline_factorise(&s->stiffness);
}

void ritz_system_free(struct ritz_system *s)
{
    free(s->block);
    axis_free(&s->of_x);
    axis_free(&s->of_y);
    skyline_free(&s->stiffness);
}
