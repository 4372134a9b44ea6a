#include "oracles/ritz_system.h"

#include <stdlib.h>
#include <string.h>

/* u_x begins with y function 1: function 0, the only one that is not zero on y = 0, is left out by symmetry. */
static int first_function(int component)
{
    return component == 0 ? 1 : 0;
}

static int block_size(const struct ritz_system *s, int component)
{
    return s->y->functions - first_function(component);
}

static void place(struct ritz_system *s, int a, int component, int *next)
{
    s->block[2 * a + component] = *next;
    *next += block_size(s, component);
}

/* Bubbles from the highest order down, a node only after the bubbles of both its elements. Within an element bubbles
 * are even or odd about its middle, and a mode of one kind takes u_x from the even and u_y from the odd ones, one of
 * the other kind the reverse: so there are two chains, in which a block couples with the two before it, and only the
 * few nodes have long rows. */
static void order(struct ritz_system *s)
{
    int next = 0;
    for (int e = 0; e < s->x->elements; e++) {
        int first = s->x->first[e], top = s->x->first[e + 1] - 1;
        for (int kind = 0; kind < 2; kind++) {
            for (int a = top; a > first; a--) {
                place(s, a, (a - first + kind) % 2, &next);
            }
        }
        for (int c = 0; c < 2 && e > 0; c++) {
            place(s, first, c, &next);
        }
    }
    place(s, s->x->functions - 1, 0, &next);
    place(s, s->x->functions - 1, 1, &next);
    s->block[0] = s->block[1] = -1; /* the clamp */
}

bool ritz_system_unknown(const struct ritz_system *s, int a, int component, int j, size_t *index)
{
    int block = s->block[2 * a + component], at = j - first_function(component);
    *index = (size_t)block + (size_t)at;
    return block >= 0 && at >= 0;
}

/* Whether component c of x function a and component d of b have entries in A: of two bubbles, equal components go with
 * an even difference of their orders, different ones with an odd one. */
static bool couple(const struct ritz_system *s, int a, int c, int b, int d)
{
    struct axis_function f = axis_function(s->x, a), g = axis_function(s->x, b);
    return s->block[2 * a] >= 0 && s->block[2 * b] >= 0 && axis_coupled(s->x, a, b) &&
           (f.order == 1 || g.order == 1 || (f.order + g.order + c + d) % 2 == 0);
}

static void note_couples(struct ritz_system *s)
{
    int fields = 2 * s->x->functions;
    for (int f = 0; f < fields; f++) {
        for (int g = 0; g < fields; g++) {
            s->coupled[f * fields + g] = couple(s, f / 2, f % 2, g / 2, g % 2);
        }
    }
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
    int fields = 2 * s->x->functions;
    if (first == NULL) {
        return false;
    }
    for (int f = 2; f < fields; f++) {
        int begin = s->block[f];
        for (int g = 2; g < fields; g++) {
            if (s->block[g] < begin && s->coupled[f * fields + g]) {
                begin = s->block[g];
            }
        }
        for (int k = 0; k < block_size(s, f % 2); k++) {
            first[s->block[f] + k] = (size_t)begin;
        }
    }
    bool done = skyline_create(&s->stiffness, s->unknowns, first);
    free(first);
    return done;
}

static void assemble_pair(struct ritz_system *s, int a, int c, int b, int d)
{
    for (int i = first_function(c); i < s->y->functions; i++) {
        for (int j = first_function(d); j < s->y->functions; j++) {
            size_t row, column;
            (void)ritz_system_unknown(s, a, c, i, &row);
            (void)ritz_system_unknown(s, b, d, j, &column);
            if (column <= row) {
                skyline_add(&s->stiffness, row, column, stiffness(s, c, a, i, d, b, j));
            }
        }
    }
}

static void assemble(struct ritz_system *s)
{
    int fields = 2 * s->x->functions;
    for (int f = 0; f < fields; f++) {
        for (int g = 0; g < fields; g++) {
            if (s->block[f] >= s->block[g] && s->coupled[f * fields + g]) {
                assemble_pair(s, f / 2, f % 2, g / 2, g % 2);
            }
        }
    }
}

/* out += weight times the mass matrix of y, for one component. */
static void add_mass(const struct ritz_system *s, int component, double weight, const double *z, double *out)
{
    int m = s->y->functions, first = first_function(component);
    for (int i = first; i < m; i++) {
        double sum = 0;
        for (int j = first; j < m; j++) {
            sum += s->of_y.mass[i * m + j] * z[j - first];
        }
        out[i - first] += weight * sum;
    }
}

void ritz_system_mass(const struct ritz_system *s, const double *z, double *out)
{
    int n = s->x->functions, fields = 2 * n;
    memset(out, 0, s->unknowns * sizeof *out);
    for (int f = 0; f < fields; f++) {
        for (int g = f % 2; g < fields; g += 2) {
            if (s->coupled[f * fields + g]) {
                add_mass(s, f % 2, s->of_x.mass[f / 2 * n + g / 2], z + s->block[g], out + s->block[f]);
            }
        }
    }
}

bool ritz_system_create(struct ritz_system *s, const struct axis *x, const struct axis *y, double lambda)
{
    *s = (struct ritz_system){.lambda = lambda, .x = x, .y = y};
    s->unknowns = ((size_t)x->functions - 1) * (2 * (size_t)y->functions - 1);
    size_t fields = 2 * (size_t)x->functions;
    s->block = malloc(fields * sizeof *s->block);
    s->coupled = malloc(fields * fields * sizeof *s->coupled);
    if (s->block == NULL || s->coupled == NULL || !axis_integrate(x, &s->of_x) || !axis_integrate(y, &s->of_y)) {
        return false;
    }
    order(s);
    note_couples(s);
    if (!allocate(s)) {
        return false;
    }
    assemble(s);
    return skyline_factorise(&s->stiffness);
}

void ritz_system_free(struct ritz_system *s)
{
    free(s->block);
    free(s->coupled);
    axis_free(&s->of_x);
    axis_free(&s->of_y);
    skyline_free(&s->stiffness);
}
