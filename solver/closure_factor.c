/* The factor of closure_factor.h, and solutions with it. */
#include "solver/closure.h"
#include "solver/memory.h"

#include <stdlib.h>
#include <string.h>

/* Rows that are eliminated at a time, rows of a piece of work, the depth of subtrees that are one thread's, and of
 * those that go one after the other. */
enum { BLOCK = 16, PIECE = 32, DEEP = 6, GROUP = 2 };
/* Added to M's diagonal, relative to it: quadratic multipliers have no energy, and on lattices others neither.
 * Round-off of the factor is less, and what smooth multipliers have on clouds of 300 spacings is more: it falls like
 * the sixth power of the length. On longer ones, and on lattices that are hardly moved, those of less energy are few,
 * and conjugate residuals with the factor find them; iterations over spline spaces do not get there. */
static const double shift = 3e-15;
/* Of U: 10 GB, and no more than half of the machine's memory, which the system may grant without having it. */
static size_t most_bytes(void)
{
    static const size_t most = (size_t)10 << 30;
    size_t half = solver_memory_bytes() / 2;
    return half < most ? half : most;
}

/* --- elimination --- */

/* A node's rows: of U its own, and behind them what it leaves. */
struct target {
    double *own, *left;
    struct solver_front front;
};

/* Where a column of a row stands; a row of what is left has columns of the border only. */
static double *entry(const struct target *to, size_t row, size_t column)
{
    size_t start = to->front.start;
    return row < start ? to->own + row * to->front.length + column
                       : to->left + (row - start) * to->front.left_length + (column - start);
}

/* Adds what a child has left to its parent's rows, runs of columns at a time; frees it. */
static bool add_child(struct solver_closure_factor *of, const struct solver_closure_node *node, const struct target *to,
                      size_t index, struct solver_error *error)
{
    const struct solver_closure_node *child = &of->node[index];
    const uint32_t *place = of->border + child->border, *border = of->border + node->border;
    size_t length = solver_front_of(of, child).left_length, width = of->width, runs = 0;
    struct run {
        size_t from, to, count; /* columns */
    } *run = NULL;
    if (!solver_alloc((void **)&run, child->border_count + 1, sizeof *run, "borders of sets", error)) {
        return false;
    }
    for (size_t n = 0, at = 0; n < child->border_count; n++) {
        size_t column = (place[n] - node->begin) * width;
        if (place[n] >= node->end) {
            while (border[at] < place[n]) {
                at++;
            }
            column = to->front.start + at * width;
        }
        if (runs > 0 && run[runs - 1].to + run[runs - 1].count == column) {
            run[runs - 1].count += width;
        } else {
            run[runs++] = (struct run){n * width, column, width};
        }
    }
    for (size_t first = 0; first < runs; first++) {
        for (size_t i = 0; i < run[first].count; i++) {
            const double *from = of->left[index] + (run[first].from + i) * length;
            for (size_t r = first; r < runs; r++) {
                size_t skip = r == first ? i : 0; /* before the diagonal, nothing is meant */
                double *out = entry(to, run[first].to + i, run[r].to);
                for (size_t j = skip; j < run[r].count; j++) {
                    out[j] += from[run[r].from + j];
                }
            }
        }
    }
    free(run);
    free(of->left[index]);
    of->left[index] = NULL;
    return true;
}

/* Rows [begin, end) of `out`, of a node near the root in pieces and in parallel: subtrees of others are one thread's.
 */
static void subtract(const struct solver_front_loops *loops, const struct solver_closure_node *node, const double *rows,
                     size_t length, size_t from, size_t to, size_t start, double *out, size_t out_length, size_t begin,
                     size_t end)
{
    if (node->depth >= DEEP || end - begin <= PIECE) {
        loops->subtract(rows, length, from, to, start, out, out_length, begin, end);
        return;
    }
#pragma omp parallel for schedule(dynamic)
    for (size_t i = begin; i < end; i += PIECE) {
        loops->subtract(rows, length, from, to, start, out, out_length, i, i + PIECE < end ? i + PIECE : end);
    }
}

static bool eliminate(struct solver_closure *of, size_t index, struct solver_error *error)
{
    struct solver_closure_factor *factor = &of->factor;
    const struct solver_front_loops *loops = of->fronts;
    const struct solver_closure_node *node = &factor->node[index];
    struct solver_front front = solver_front_of(factor, node);
    double *rows = factor->U + node->rows;
    /* many of them, one after the other: on pages that the one before has left */
    size_t bytes = (front.border * front.left_length + SOLVER_FRONT_PAD) * sizeof(double);
    factor->left[index] = aligned_alloc(SOLVER_FRONT_PAD * sizeof(double), bytes);
    if (factor->left[index] == NULL) {
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the factor of a closed stencil");
    }
    memset(rows, 0, front.own * front.length * sizeof *rows);
    for (size_t i = 0; i < front.border; i++) { /* what comes before is never looked at */
        size_t from = i / SOLVER_FRONT_PAD * SOLVER_FRONT_PAD;
        memset(factor->left[index] + i * front.left_length + from, 0, (front.left_length - from) * sizeof *rows);
    }
    loops->assemble(of, index, shift, rows);
    struct target to = {rows, factor->left[index], front};
    for (size_t last = index; last > node->first; last = factor->node[last - 1].first) {
        if (!add_child(factor, node, &to, last - 1, error)) {
            return false;
        }
    }
    for (size_t from = 0; from < front.own; from += BLOCK) {
        size_t end = from + BLOCK < front.own ? from + BLOCK : front.own;
        loops->eliminate(rows, front.length, from, end);
        subtract(loops, node, rows, front.length, from, end, 0, rows, front.length, end, front.own);
    }
    subtract(loops, node, rows, front.length, 0, front.own, front.start, factor->left[index], front.left_length, 0,
             front.border);
    return true;
}

/* A subtree: those deep in it in parallel, the others in turn. One after the other, since what all of a depth leave on
 * their borders takes as much memory as the factor. */
static bool eliminate_group(struct solver_closure *of, size_t last, struct solver_error *error)
{
    const struct solver_closure_factor *factor = &of->factor;
    size_t failed = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : failed)
    for (size_t n = factor->node[last].first; n <= last; n++) {
        struct solver_error of_node;
        for (size_t in = factor->node[n].first; factor->node[n].depth == DEEP && in <= n && failed == 0; in++) {
            failed += !eliminate(of, in, &of_node);
        }
    }
    for (size_t n = factor->node[last].first; n <= last && failed == 0; n++) {
        if (factor->node[n].depth < DEEP && !eliminate(of, n, error)) {
            return false;
        }
    }
    return failed == 0 || solver_fail(error, SOLVER_NO_MEMORY, "no memory for the factor of a closed stencil");
}

static bool make(struct solver_closure *of, struct solver_error *error)
{
    struct solver_closure_factor *factor = &of->factor;
    size_t block = factor->width * of->loops->lanes;
    if (!solver_alloc_untouched((void **)&factor->U, factor->size, sizeof(double), "factor", error) ||
        !solver_alloc((void **)&factor->left, factor->node_count, sizeof *factor->left, "factor", error) ||
        !solver_alloc((void **)&factor->x, of->cloud->count * block, sizeof(double), "factor", error) ||
        !solver_alloc((void **)&factor->carried, factor->border_total * block, sizeof(double), "factor", error)) {
        return false;
    }
    for (size_t n = 0; n < factor->node_count; n++) {
        if (factor->node[n].depth == GROUP ? !eliminate_group(of, n, error)
                                           : factor->node[n].depth < GROUP && !eliminate(of, n, error)) {
            return false;
        }
    }
    return true;
}

bool solver_closure_factor_make(struct solver_closure *of, double most, bool *made, struct solver_error *error)
{
    *made = false;
    if (!solver_closure_tree(of, error)) {
        return false;
    }
    *made =
        of->factor.operations <= most * (double)of->cloud->count && of->factor.size <= most_bytes() / sizeof(double);
    return !*made || make(of, error);
}

/* --- solutions --- */

void solver_closure_substitute(struct solver_closure *of, const double *r, double *z)
{
    const struct solver_closure_factor *factor = &of->factor;
    size_t count = of->cloud->count, block = factor->width * of->loops->lanes;
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < count; n++) {
        memcpy(factor->x + n * block, r + factor->particle[n] * block, block * sizeof *r);
    }
#pragma omp parallel for schedule(dynamic)
    for (size_t n = 0; n < factor->node_count; n++) {
        for (size_t in = factor->node[n].first; factor->node[n].depth == DEEP && in <= n; in++) {
            of->fronts->forward(factor, in);
        }
    }
    for (size_t n = 0; n < factor->node_count; n++) {
        if (factor->node[n].depth < DEEP) {
            of->fronts->forward(factor, n);
        }
    }
    for (size_t n = factor->node_count; n-- > 0;) {
        if (factor->node[n].depth < DEEP) {
            of->fronts->backward(factor, n);
        }
    }
#pragma omp parallel for schedule(dynamic)
    for (size_t n = 0; n < factor->node_count; n++) {
        for (size_t in = n + 1; factor->node[n].depth == DEEP && in-- > factor->node[n].first;) {
            of->fronts->backward(factor, in);
        }
    }
#pragma omp parallel for schedule(static)
    for (size_t n = 0; n < count; n++) {
        memcpy(z + factor->particle[n] * block, factor->x + n * block, block * sizeof *r);
    }
}

void solver_closure_factor_free(struct solver_closure_factor *of)
{
    for (size_t n = 0; of->left != NULL && n < of->node_count; n++) {
        free(of->left[n]);
    }
    free(of->left);
    free(of->node);
    free(of->particle);
    free(of->place);
    free(of->border);
    free(of->U);
    free(of->x);
    free(of->carried);
    *of = (struct solver_closure_factor){.node = NULL};
}
