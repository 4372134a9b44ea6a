/* The loops of the multipliers of a closed stencil (closure.h), compiled per dimension. */
#include "solver/closure.h"

#include "solver/dim.h"

#include <math.h>
#include <string.h>

enum {
    WIDTH = DIM + 1,
    BLOCK = WIDTH * LANES,
    PAIR = DIM + 1,
    SPLINES = DIM == 3   ? 27
              : DIM == 2 ? 9
                         : 3,
    BOX = DIM == 3   ? 64
          : DIM == 2 ? 16
                     : 4, /* splines that two neighbours touch: at most four along an axis */
    SPAN = 2 * SOLVER_CLOSURE_REACH + 1,
    DENSE = DIM == 3   ? SPAN * SPAN * SPAN
            : DIM == 2 ? SPAN * SPAN
                       : SPAN,
    CHILDREN = 1 << DIM,
};

/* --- particles --- */

/* 1/2 (X_b - X_a), in spacings. */
static inline vec half_distance(const struct solver_closure *of, size_t a, size_t b)
{
    return of->scale * (load(of->X + b * LANES) - load(of->X + a * LANES));
}

/* Opposite, bit for bit, where a and b change places. */
static inline vec step_of(const double *u, size_t a, size_t b, vec half)
{
    const double *of_a = u + a * BLOCK;
    const double *of_b = u + b * BLOCK;
    vec step = load(of_a) - load(of_b);
    for (int i = 0; i < DIM; i++) {
        vec beta = load(of_a + (i + 1) * LANES) + load(of_b + (i + 1) * LANES);
        step += splat(half[i]) * beta;
    }
    return step;
}

/* (M u)_a */
static inline void image_of(const struct solver_closure *of, const double *u, size_t a, vec sum[WIDTH])
{
    const struct solver_graph *graph = of->graph;
    for (int i = 0; i < WIDTH; i++) {
        sum[i] = splat(0.0);
    }
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        size_t b = graph->neighbour[ab];
        vec half = half_distance(of, a, b);
        vec step = of->weight[ab] * step_of(u, a, b, half);
        sum[0] += step;
        for (int i = 0; i < DIM; i++) {
            sum[i + 1] += splat(half[i]) * step;
        }
    }
}

static void apply(const struct solver_closure *of, const double *u, double *out, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        vec sum[WIDTH];
        image_of(of, u, a, sum);
        for (int i = 0; i < WIDTH; i++) {
            store(out + a * BLOCK + i * LANES, sum[i]);
        }
    }
}

static void dot_of(const double *x, const double *y, double *sum, size_t begin, size_t end)
{
    vec total = splat(0.0);
    for (size_t i = begin * WIDTH; i < end * WIDTH; i++) {
        total += load(x + i * LANES) * load(y + i * LANES);
    }
    store(sum, total);
}

static double largest_of(const double *x, size_t begin, size_t end)
{
    double most[4] = {0.0}, failed[4] = {0.0}; /* in turns: none waits for the one before */
    size_t room = (end - begin) * BLOCK;
    x += begin * BLOCK;
    for (size_t i = 0; i < room; i++) {
        double size = fabs(x[i]);
        most[i % 4] = size > most[i % 4] ? size : most[i % 4];
        failed[i % 4] += 0.0 * x[i];
    }
    return fmax(fmax(most[0], most[1]), fmax(most[2], most[3])) + (failed[0] + failed[1] + failed[2] + failed[3]);
}

static void add(const struct solver_closure *of, const double *factor, const double *y, double *x, size_t begin,
                size_t end)
{
    vec by = load(factor);
    (void)of;
    for (size_t i = begin * WIDTH; i < end * WIDTH; i++) {
        store(x + i * LANES, load(x + i * LANES) + by * load(y + i * LANES));
    }
}

static void scale_add(const struct solver_closure *of, const double *factor, const double *y, double *x, size_t begin,
                      size_t end)
{
    vec by = load(factor);
    (void)of;
    for (size_t i = begin * WIDTH; i < end * WIDTH; i++) {
        store(x + i * LANES, by * load(x + i * LANES) + load(y + i * LANES));
    }
}

static void change(const struct solver_closure *of, const double *u, double face, double *pair, size_t begin,
                   size_t end)
{
    const struct solver_graph *graph = of->graph;
    for (size_t a = begin; a < end; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            vec step = face * of->weight[ab] * step_of(u, a, b, half_distance(of, a, b));
            for (int k = 0; k < DIM; k++) {
                pair[ab * PAIR + (size_t)k] += step[k];
            }
        }
    }
}

static void residuals(const struct solver_closure *of, const double *area, const double *V, double per_face,
                      const double *pair, double *r, size_t begin, size_t end)
{
    const struct solver_graph *graph = of->graph;
    for (size_t a = begin; a < end; a++) {
        vec sum[WIDTH] = {{0}};
        for (int k = 0; k < DIM; k++) {
            sum[0][k] = -area[a * DIM + (size_t)k];
            sum[k + 1][k] = 2.0 * of->scale * V[a];
        }
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            vec half = half_distance(of, a, graph->neighbour[ab]);
            vec C = splat(0.0);
            for (int k = 0; k < DIM; k++) {
                C[k] = pair[ab * PAIR + (size_t)k];
            }
            sum[0] -= C;
            for (int i = 0; i < DIM; i++) {
                sum[i + 1] -= splat(half[i]) * C;
            }
        }
        for (int i = 0; i < WIDTH; i++) {
            store(r + a * BLOCK + i * LANES, per_face * sum[i]);
        }
    }
}

/* --- the finest splines --- */

/* Values and half slopes, per axis, of the three splines of each axis that are not zero at a particle. */
struct splines {
    double value[DIM][3], slope[DIM][3];
};

static inline struct splines splines_at(const struct solver_closure *of, size_t a)
{
    struct splines at;
    const int32_t *cell = of->cell_at + (size_t)of->cell_of[a] * 3;
    double per_width = 1.0 / of->width;
    double half = 0.5 * per_width / of->scale;
    for (int i = 0; i < DIM; i++) {
        double s = (of->X[a * LANES + (size_t)i] - of->origin[i]) * per_width - cell[i];
        at.value[i][0] = 0.5 * (1.0 - s) * (1.0 - s);
        at.value[i][1] = 0.5 + s * (1.0 - s);
        at.value[i][2] = 0.5 * s * s;
        at.slope[i][0] = half * (s - 1.0);
        at.slope[i][1] = half * (1.0 - 2.0 * s);
        at.slope[i][2] = half * s;
    }
    return at;
}

/* Adds to each spline its values and half slopes times r = (r_0, r_1 .. r_dim), axis by axis. */
static inline void onto_splines(const struct splines *at, const vec r[WIDTH], vec sum[SPLINES])
{
    for (int i = 0; i < 3; i++) {
        vec x = at->value[0][i] * r[0] + at->slope[0][i] * r[1];
#if DIM == 1
        sum[i] += x;
#else
        vec beyond = at->value[0][i] * r[2];
        for (int j = 0; j < 3; j++) {
            vec xy = at->value[1][j] * x + at->slope[1][j] * beyond;
#if DIM == 2
            sum[3 * j + i] += xy;
#else
            vec last = at->value[0][i] * at->value[1][j] * r[3];
            for (int k = 0; k < 3; k++) {
                sum[9 * k + 3 * j + i] += at->value[2][k] * xy + at->slope[2][k] * last;
            }
#endif
        }
#endif
    }
}

/* The other way round: the value and half slopes of splines' sum x. */
static inline void of_splines(const struct splines *at, const double *x, const uint32_t spline[SPLINES], vec u[WIDTH])
{
    for (int i = 0; i < WIDTH; i++) {
        u[i] = splat(0.0);
    }
    for (int i = 0; i < 3; i++) {
#if DIM == 1
        vec value = load(x + (size_t)spline[i] * LANES);
#else
        vec value = splat(0.0), slope = splat(0.0);
#if DIM == 3
        vec last = splat(0.0);
#endif
        for (int j = 0; j < 3; j++) {
#if DIM == 2
            vec along = load(x + (size_t)spline[3 * j + i] * LANES);
#else
            vec along = splat(0.0), across = splat(0.0);
            for (int k = 0; k < 3; k++) {
                vec one = load(x + (size_t)spline[9 * k + 3 * j + i] * LANES);
                along += at->value[2][k] * one;
                across += at->slope[2][k] * one;
            }
            last += at->value[1][j] * across;
#endif
            value += at->value[1][j] * along;
            slope += at->slope[1][j] * along;
        }
        u[2] += at->value[0][i] * slope;
#if DIM == 3
        u[3] += at->value[0][i] * last;
#endif
#endif
        u[0] += at->value[0][i] * value;
        u[1] += at->slope[0][i] * value;
    }
}

/* The splines that a pair touches, in lines of four along axis 0: the change on the pair for each. */
typedef double line __attribute__((vector_size(32)));
enum { LINES = BOX / 4 };
struct box {
    line of[LINES];
    uint32_t spline[BOX];
    bool touched[LINES];
};

/* Adds what particle a gives: sign value + half . slope. */
static inline void onto_box(const struct solver_closure *of, size_t a, double sign, vec half, const int shift[3],
                            struct box *box)
{
    struct splines at = splines_at(of, a);
    const uint32_t *of_cell = of->cell_spline + (size_t)of->cell_of[a] * SPLINES;
    line value = {0}, slope = {0};
    for (int i = 0; i < 3; i++) {
        value[i + shift[0]] = at.value[0][i];
        slope[i + shift[0]] = at.slope[0][i];
    }
    line x = sign * value + half[0] * slope;
    for (int n = 0; n < SPLINES / 3; n++) {
        int at_line = 0;
#if DIM == 1
        line sum = x;
#else
        int j = n % 3;
        at_line = j + shift[1];
        line sum = at.value[1][j] * x + half[1] * at.slope[1][j] * value;
#endif
#if DIM > 2
        int k = n / 3;
        at_line += 4 * (k + shift[2]);
        sum = at.value[2][k] * sum + half[2] * at.slope[2][k] * at.value[1][j] * value;
#endif
        box->of[at_line] += sum;
        box->touched[at_line] = true;
        memcpy(box->spline + 4 * at_line + shift[0], of_cell + (size_t)(3 * n), 3 * sizeof *of_cell);
    }
}

/* Adds factor times the box to the row of spline i of the first of the given lines; what comes before them is the
 * transpose's. */
static inline void onto_row(const struct box *box, double factor, int i, const int *lines, int count, double *row)
{
    typedef line anywhere __attribute__((aligned(sizeof(double))));
    for (int n = 0; n < count; n++) {
        int offset = SOLVER_CLOSURE_REACH - i;
        if (DIM > 1) {
            offset += SPAN * (SOLVER_CLOSURE_REACH + (lines[n] & 3) - (lines[0] & 3));
        }
        if (DIM > 2) {
            offset += SPAN * SPAN * (SOLVER_CLOSURE_REACH + (lines[n] >> 2) - (lines[0] >> 2));
        }
        *(anywhere *)(row + offset) += factor * box->of[lines[n]];
    }
}

static void assemble(const struct solver_closure *of, double *dense, size_t begin, size_t end)
{
    const struct solver_graph *graph = of->graph;
    for (size_t p = of->cell_start[begin]; p < of->cell_start[end]; p++) {
        size_t a = of->cell_particle[p];
        const int32_t *cell_a = of->cell_at + (size_t)of->cell_of[a] * 3;
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            if (b < a) {
                continue;
            }
            const int32_t *cell_b = of->cell_at + (size_t)of->cell_of[b] * 3;
            struct box box = {.of = {{0}}};
            int shift_a[3] = {0}, shift_b[3] = {0}, lines[LINES], count = 0;
            for (int i = 0; i < DIM; i++) {
                shift_a[i] = cell_a[i] > cell_b[i];
                shift_b[i] = cell_b[i] > cell_a[i];
            }
            vec half = half_distance(of, a, b);
            onto_box(of, a, 1.0, half, shift_a, &box);
            onto_box(of, b, -1.0, half, shift_b, &box);
            for (int n = 0; n < LINES; n++) {
                lines[count] = n;
                count += box.touched[n];
            }
            for (int m = 0; m < count; m++) {
                for (int i = 0; i < 4; i++) {
                    double entry = box.of[lines[m]][i];
                    if (entry != 0.0) {
                        double *row = dense + (size_t)box.spline[4 * lines[m] + i] * DENSE;
                        onto_row(&box, of->weight[ab] * entry, i, lines + m, count - m, row);
                    }
                }
            }
        }
    }
}

static void sum_cells(const struct solver_closure *of, const double *r, const double *image, size_t begin, size_t end)
{
    for (size_t cell = begin; cell < end; cell++) {
        vec sum[SPLINES] = {{0}};
        for (size_t p = of->cell_start[cell]; p < of->cell_start[cell + 1]; p++) {
            size_t a = of->cell_particle[p];
            struct splines at = splines_at(of, a);
            vec of_a[WIDTH];
            for (int i = 0; i < WIDTH; i++) {
                of_a[i] = load(r + a * BLOCK + i * LANES) - load(image + a * BLOCK + i * LANES);
            }
            onto_splines(&at, of_a, sum);
        }
        for (int n = 0; n < SPLINES; n++) {
            store(of->cell_sum + (cell * SPLINES + (size_t)n) * LANES, sum[n]);
        }
    }
}

static void sum_splines(const struct solver_closure *of, double *r, size_t begin, size_t end)
{
    for (size_t spline = begin; spline < end; spline++) {
        vec sum = splat(0.0);
        for (size_t n = 0; n < SPLINES; n++) {
            uint32_t cell = of->spline_cell[spline * SPLINES + n];
            if (cell != UINT32_MAX) {
                sum += load(of->cell_sum + (cell * SPLINES + n) * LANES);
            }
        }
        store(r + spline * LANES, sum);
    }
}

static void spread_splines(const struct solver_closure *of, const double *x, double *u, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        struct splines at = splines_at(of, a);
        vec sum[WIDTH];
        of_splines(&at, x, of->cell_spline + (size_t)of->cell_of[a] * SPLINES, sum);
        for (int i = 0; i < WIDTH; i++) {
            store(u + a * BLOCK + i * LANES, load(u + a * BLOCK + i * LANES) + sum[i]);
        }
    }
}

/* --- grids --- */

static void grid_smooth(const struct solver_closure_grid *grid, double keep, double factor, const double *d, double *x,
                        double *r, double *next, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        vec part[4] = {{0}}; /* sums that do not wait for each other */
        for (size_t at = grid->row[i]; at < grid->row[i + 1]; at++) {
            const double *from = d + (size_t)grid->column[at] * LANES;
            const double *value = grid->value + at * SOLVER_CLOSURE_LINE;
            for (size_t n = 0; n < SPAN; n++) {
                part[n % 4] += value[n] * load(from + n * LANES);
            }
        }
        vec sum = (part[0] + part[1]) + (part[2] + part[3]);
        store(x + i * LANES, load(x + i * LANES) + load(d + i * LANES));
        sum = load(r + i * LANES) - sum;
        store(r + i * LANES, sum);
        if (next != NULL) {
            store(next + i * LANES, keep * load(d + i * LANES) + factor * grid->diagonal[i] * sum);
        }
    }
}

static inline double share_of(const int32_t *place, unsigned parent)
{
    double share = 1.0;
    for (unsigned i = 0; i < DIM; i++) {
        share *= solver_closure_share(place[i], parent >> i & 1);
    }
    return share;
}

static void grid_sum(const struct solver_closure_grid *fine, const double *r, double *out, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        vec sum = splat(0.0);
        for (size_t n = fine->child_row[i]; n < fine->child_row[i + 1]; n++) {
            size_t child = fine->child[n] / CHILDREN;
            sum += share_of(fine->at + child * 3, fine->child[n] % CHILDREN) * load(r + child * LANES);
        }
        store(out + i * LANES, sum);
    }
}

static void grid_spread(const struct solver_closure_grid *fine, const double *x, double *out, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        vec sum = load(out + i * LANES);
        for (unsigned n = 0; n < CHILDREN; n++) {
            sum += share_of(fine->at + i * 3, n) * load(x + (size_t)fine->parent[i * CHILDREN + n] * LANES);
        }
        store(out + i * LANES, sum);
    }
}

const struct solver_closure_loops DIM_NAME(solver_closure) = {
    .lanes = LANES,
    .apply = apply,
    .dot = dot_of,
    .largest = largest_of,
    .add = add,
    .scale_add = scale_add,
    .change = change,
    .residuals = residuals,
    .assemble = assemble,
    .sum_cells = sum_cells,
    .sum_splines = sum_splines,
    .spread = spread_splines,
    .grid_smooth = grid_smooth,
    .grid_sum = grid_sum,
    .grid_spread = grid_spread,
};
