/* The loops of the multipliers of a closed stencil (closure.h), compiled per dimension. */
#include "solver/closure.h"

#include "solver/dim.h"
#include "solver/small.h"

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

static void blocks(struct solver_closure *of, size_t begin, size_t end)
{
    const struct solver_graph *graph = of->graph;
    for (size_t a = begin; a < end; a++) {
        double block[4][4] = {{0}};
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            vec half = half_distance(of, a, graph->neighbour[ab]);
            double g[WIDTH] = {1.0};
            for (int i = 0; i < DIM; i++) {
                g[i + 1] = half[i];
            }
            for (int i = 0; i < WIDTH; i++) {
                for (int j = 0; j < WIDTH; j++) {
                    block[i][j] += of->weight[ab] * g[i] * g[j];
                }
            }
        }
        /* a block that is singular to round-off: what its neighbours cannot meet is refused by the residual */
        double kept[4][4];
        memcpy(kept, block, sizeof block);
        if (!solver_small_invert(WIDTH, block)) {
            memset(block, 0, sizeof block);
            for (int i = 0; i < WIDTH; i++) {
                block[i][i] = kept[i][i] > 0.0 ? 1.0 / (WIDTH * kept[i][i]) : 0.0;
            }
        }
        for (int i = 0; i < WIDTH; i++) {
            for (int j = 0; j < WIDTH; j++) {
                of->inverse[(a * WIDTH + (size_t)i) * WIDTH + (size_t)j] = 0.5 * (block[i][j] + block[j][i]);
            }
        }
    }
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

static inline void times_inverse(const struct solver_closure *of, size_t a, const vec r[WIDTH], vec out[WIDTH])
{
    const double *inverse = of->inverse + a * WIDTH * WIDTH;
    for (int i = 0; i < WIDTH; i++) {
        out[i] = inverse[i * WIDTH] * r[0];
        for (int j = 1; j < WIDTH; j++) {
            out[i] += inverse[i * WIDTH + j] * r[j];
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

static void precondition(const struct solver_closure *of, double factor, const double *r, double *out, size_t begin,
                         size_t end)
{
    for (size_t a = begin; a < end; a++) {
        vec in[WIDTH], z[WIDTH];
        for (int i = 0; i < WIDTH; i++) {
            in[i] = load(r + a * BLOCK + i * LANES);
        }
        times_inverse(of, a, in, z);
        for (int i = 0; i < WIDTH; i++) {
            store(out + a * BLOCK + i * LANES, factor * z[i]);
        }
    }
}

static void smooth(const struct solver_closure *of, double keep, double factor, const double *d, double *x, double *r,
                   double *next, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        vec sum[WIDTH], z[WIDTH];
        image_of(of, d, a, sum);
        for (int i = 0; i < WIDTH; i++) {
            size_t at = a * BLOCK + (size_t)(i * LANES);
            store(x + at, load(x + at) + load(d + at));
            sum[i] = load(r + at) - sum[i];
            store(r + at, sum[i]);
        }
        if (next != NULL) {
            times_inverse(of, a, sum, z);
            for (int i = 0; i < WIDTH; i++) {
                size_t at = a * BLOCK + (size_t)(i * LANES);
                store(next + at, keep * load(d + at) + factor * z[i]);
            }
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

/* Spline (i, j, k) of those: its value, then its half slopes. */
static inline void product(const struct splines *at, const int place[3], double out[WIDTH])
{
    out[0] = at->value[0][place[0]];
    for (int i = 1; i < DIM; i++) {
        out[0] *= at->value[i][place[i]];
    }
    for (int s = 0; s < DIM; s++) {
        double slope = at->slope[s][place[s]];
        for (int i = 0; i < DIM; i++) {
            slope *= i == s ? 1.0 : at->value[i][place[i]];
        }
        out[s + 1] = slope;
    }
}

static inline void place_of(int index, int base, int place[3])
{
    for (int i = 0; i < DIM; i++) {
        place[i] = index % base;
        index /= base;
    }
}

/* Adds what particle a gives to the change on a pair for each spline of its box: sign value + half . slope. */
static inline void onto_box(const struct solver_closure *of, size_t a, double sign, vec half, const int shift[3],
                            double box[BOX], uint32_t spline[BOX])
{
    struct splines at = splines_at(of, a);
    const uint32_t *of_cell = of->cell_spline + (size_t)of->cell_of[a] * SPLINES;
    for (int n = 0; n < SPLINES; n++) {
        int place[3] = {0};
        double f[WIDTH];
        place_of(n, 3, place);
        product(&at, place, f);
        int index = 0;
        for (int i = DIM - 1; i >= 0; i--) {
            index = 4 * index + place[i] + shift[i];
        }
        double sum = sign * f[0];
        for (int i = 0; i < DIM; i++) {
            sum += half[i] * f[i + 1];
        }
        box[index] += sum;
        spline[index] = of_cell[n];
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
            double box[BOX] = {0};
            uint32_t spline[BOX];
            int shift_a[3] = {0}, shift_b[3] = {0};
            for (int i = 0; i < DIM; i++) {
                shift_a[i] = cell_a[i] > cell_b[i];
                shift_b[i] = cell_b[i] > cell_a[i];
            }
            vec half = half_distance(of, a, b);
            onto_box(of, a, 1.0, half, shift_a, box, spline);
            onto_box(of, b, -1.0, half, shift_b, box, spline);
            for (int i = 0; i < BOX; i++) {
                if (box[i] == 0.0) {
                    continue;
                }
                double factor = of->weight[ab] * box[i];
                double *row = dense + (size_t)spline[i] * DENSE;
                /* lines of four splines along axis 0, from that of i on: the others are the transpose's */
                for (int j = i & ~3; j < BOX; j += 4) {
                    int offset = SOLVER_CLOSURE_REACH - (i & 3);
                    if (DIM > 1) {
                        offset += SPAN * (SOLVER_CLOSURE_REACH + (j >> 2 & 3) - (i >> 2 & 3));
                    }
                    if (DIM > 2) {
                        offset += SPAN * SPAN * (SOLVER_CLOSURE_REACH + (j >> 4) - (i >> 4));
                    }
                    for (int n = 0; n < 4; n++) {
                        row[offset + n] += factor * box[j + n];
                    }
                }
            }
        }
    }
}

static void sum_cells(const struct solver_closure *of, const double *r, size_t begin, size_t end)
{
    for (size_t cell = begin; cell < end; cell++) {
        vec sum[SPLINES] = {{0}};
        for (size_t p = of->cell_start[cell]; p < of->cell_start[cell + 1]; p++) {
            size_t a = of->cell_particle[p];
            struct splines at = splines_at(of, a);
            for (int n = 0; n < SPLINES; n++) {
                int place[3] = {0};
                double f[WIDTH];
                place_of(n, 3, place);
                product(&at, place, f);
                for (int i = 0; i < WIDTH; i++) {
                    sum[n] += f[i] * load(r + a * BLOCK + i * LANES);
                }
            }
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
        const uint32_t *spline = of->cell_spline + (size_t)of->cell_of[a] * SPLINES;
        vec sum[WIDTH];
        for (int i = 0; i < WIDTH; i++) {
            sum[i] = load(u + a * BLOCK + i * LANES);
        }
        for (int n = 0; n < SPLINES; n++) {
            int place[3] = {0};
            double f[WIDTH];
            vec value = load(x + (size_t)spline[n] * LANES);
            place_of(n, 3, place);
            product(&at, place, f);
            for (int i = 0; i < WIDTH; i++) {
                sum[i] += f[i] * value;
            }
        }
        for (int i = 0; i < WIDTH; i++) {
            store(u + a * BLOCK + i * LANES, sum[i]);
        }
    }
}

/* --- grids --- */

static void grid_smooth(const struct solver_closure_grid *grid, double keep, double factor, const double *d, double *x,
                        double *r, double *next, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        vec sum = splat(0.0);
        for (size_t ij = grid->row[i]; ij < grid->row[i + 1]; ij++) {
            sum += grid->value[ij] * load(d + (size_t)grid->column[ij] * LANES);
        }
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
    .blocks = blocks,
    .apply = apply,
    .precondition = precondition,
    .smooth = smooth,
    .dot = dot_of,
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
