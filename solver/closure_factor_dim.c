/* The dense loops of closure_factor.h, compiled per dimension and path. Every number is found from the same sums in the
 * same order on any path with fused multiply-adds. */
#include "solver/closure.h"

#include "solver/dim.h"

#include <math.h>
#include <string.h>

enum { WIDTH = DIM + 1 };

/* Columns in a register, and rows that share what is loaded of them. */
#if defined __AVX512F__
enum { COLUMNS = 8, ROWS = 8 };
#elif defined __AVX__
enum { COLUMNS = 4, ROWS = 4 };
#else
enum { COLUMNS = 2, ROWS = 4 };
#endif
enum { TILE = 2 * COLUMNS };
typedef double columns __attribute__((vector_size(COLUMNS * sizeof(double))));

static inline columns columns_at(const double *from)
{
    return *(const columns *)from;
}

/* --- a node's rows --- */

/* Where a border's place stands in it. */
static size_t on_border(const uint32_t *border, size_t count, uint32_t place)
{
    size_t low = 0, high = count;
    while (low + 1 < high) {
        size_t middle = low + (high - low) / 2;
        if (border[middle] <= place) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static void assemble(const struct solver_closure *of, size_t index, double shift, double *rows)
{
    const struct solver_graph *graph = of->graph;
    const struct solver_closure_factor *factor = &of->factor;
    const struct solver_closure_node *node = &factor->node[index];
    struct solver_front front = solver_front_of(factor, node);
    for (size_t n = node->begin; n < node->end; n++) {
        size_t a = factor->particle[n];
        double *row = rows + (n - node->begin) * WIDTH * front.length;
        double *own = row + (n - node->begin) * WIDTH;
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            uint32_t b = graph->neighbour[ab], place = factor->place[b];
            vec half = of->scale * (load(of->X + (size_t)b * LANES) - load(of->X + a * LANES));
            double of_a[WIDTH] = {1.0}, of_b[WIDTH] = {-1.0}, *at = NULL;
            for (int i = 0; i < DIM; i++) {
                of_a[i + 1] = of_b[i + 1] = half[i];
            }
            if (place >= node->end) {
                at = row + front.start + WIDTH * on_border(factor->border + node->border, node->border_count, place);
            } else if (place > n) {
                at = row + (place - node->begin) * WIDTH;
            }
            for (size_t i = 0; i < WIDTH; i++) {
                double weighted = of->weight[ab] * of_a[i];
                for (size_t j = 0; j < WIDTH; j++) {
                    own[i * front.length + j] += weighted * of_a[j];
                    if (at != NULL) {
                        at[i * front.length + j] = weighted * of_b[j];
                    }
                }
            }
        }
        for (size_t i = 0; i < WIDTH; i++) {
            own[i * front.length + i] *= 1.0 + shift;
        }
    }
}

/* --- elimination --- */

/* The rows of a block that stands on the diagonal: only they are wanted for the pivots. A pivot of round-off stands for
 * an unknown that nothing holds: it becomes zero. */
static void pivots(double *rows, size_t length, size_t from, size_t to)
{
    for (size_t k = from; k < to; k++) {
        double *row = rows + k * length;
        double whole = row[k];
        for (size_t before = from; before < k; before++) {
            const double *above = rows + before * length;
            for (size_t j = k; j < to; j++) {
                row[j] -= above[k] * above[j];
            }
        }
        double reciprocal = row[k] > 1e-15 * whole && row[k] > 0.0 ? 1.0 / sqrt(row[k]) : 0.0;
        for (size_t j = k + 1; j < to; j++) {
            row[j] *= reciprocal;
        }
        row[k] = reciprocal;
    }
}

static void eliminate(double *rows, size_t length, size_t from, size_t to)
{
    pivots(rows, length, from, to);
    for (size_t j = solver_front_padded(to); j < length; j += COLUMNS) {
        for (size_t k = from; k < to; k++) {
            columns left = columns_at(rows + k * length + j);
            for (size_t before = from; before < k; before++) {
                left -= rows[before * length + k] * columns_at(rows + before * length + j);
            }
            *(columns *)(rows + k * length + j) = rows[k * length + k] * left;
        }
    }
}

/* `many` rows from i on, TILE columns from j on. */
static inline __attribute__((always_inline)) void subtract_tile(size_t many, const double *rows, size_t length,
                                                                size_t from, size_t to, size_t i, size_t j, double *out,
                                                                size_t out_length)
{
    columns sum[ROWS][2] = {{{0}}};
    for (size_t k = from; k < to; k++) {
        const double *row = rows + k * length;
        columns first = columns_at(row + j), second = columns_at(row + j + COLUMNS);
        for (size_t n = 0; n < many; n++) {
            sum[n][0] += row[i + n] * first;
            sum[n][1] += row[i + n] * second;
        }
    }
    for (size_t n = 0; n < many; n++) {
        columns *at = (columns *)(out + n * out_length);
        at[0] -= sum[n][0];
        at[1] -= sum[n][1];
    }
}

/* The last tile may be half a one. */
static inline __attribute__((always_inline)) void subtract_half(size_t many, const double *rows, size_t length,
                                                                size_t from, size_t to, size_t i, size_t j, double *out,
                                                                size_t out_length)
{
    columns sum[ROWS] = {{0}};
    for (size_t k = from; k < to; k++) {
        const double *row = rows + k * length;
        columns first = columns_at(row + j);
        for (size_t n = 0; n < many; n++) {
            sum[n] += row[i + n] * first;
        }
    }
    for (size_t n = 0; n < many; n++) {
        *(columns *)(out + n * out_length) -= sum[n];
    }
}

static void subtract(const double *rows, size_t length, size_t from, size_t to, size_t start, double *out,
                     size_t out_length, size_t begin, size_t end)
{
    for (size_t i = begin; i < end;) {
        bool whole = i + ROWS <= end;
        double *row = out + i * out_length;
        size_t j = i / SOLVER_FRONT_PAD * SOLVER_FRONT_PAD;
        for (; j + TILE <= out_length; j += TILE) {
            if (whole) {
                subtract_tile(ROWS, rows, length, from, to, start + i, start + j, row + j, out_length);
            } else {
                subtract_tile(1, rows, length, from, to, start + i, start + j, row + j, out_length);
            }
        }
        for (; j < out_length; j += COLUMNS) {
            if (whole) {
                subtract_half(ROWS, rows, length, from, to, start + i, start + j, row + j, out_length);
            } else {
                subtract_half(1, rows, length, from, to, start + i, start + j, row + j, out_length);
            }
        }
        i += whole ? ROWS : 1;
    }
}

/* --- solutions --- */

/* Rows of U that go through what they act on at a time. */
enum { ABREAST = 4 };

/* Takes from `count` numbers per component what `many` rows give with theirs. */
static inline __attribute__((always_inline)) void take(const double *rows, size_t length, size_t many, const vec *own,
                                                       double *x, size_t count)
{
    for (size_t j = 0; j < count; j++) {
        vec left = load(x + j * LANES);
        for (size_t n = 0; n < many; n++) {
            left -= rows[n * length + j] * own[n];
        }
        store(x + j * LANES, left);
    }
}

/* The sums over `count` numbers per component of what `many` rows have times those. */
static inline __attribute__((always_inline)) void gather(const double *rows, size_t length, size_t many,
                                                         const double *x, size_t count, vec *sum)
{
    for (size_t j = 0; j < count; j++) {
        vec of_j = load(x + j * LANES);
        for (size_t n = 0; n < many; n++) {
            sum[n] += rows[n * length + j] * of_j;
        }
    }
}

static void forward(const struct solver_closure_factor *of, size_t index)
{
    const struct solver_closure_node *node = &of->node[index];
    struct solver_front front = solver_front_of(of, node);
    double *x = of->x + node->begin * WIDTH * LANES, *border = of->carried + node->border * WIDTH * LANES;
    memset(border, 0, front.border * LANES * sizeof *border);
    for (size_t last = index; last > node->first; last = of->node[last - 1].first) {
        const struct solver_closure_node *child = &of->node[last - 1];
        const uint32_t *place = of->border + child->border;
        const double *carried = of->carried + child->border * WIDTH * LANES;
        for (size_t n = 0, at = 0; n < child->border_count; n++, carried += WIDTH * LANES) {
            double *to = x + (place[n] - node->begin) * WIDTH * LANES;
            if (place[n] >= node->end) {
                while (of->border[node->border + at] < place[n]) {
                    at++;
                }
                to = border + at * WIDTH * LANES;
            }
            for (size_t i = 0; i < WIDTH * LANES; i++) {
                to[i] += carried[i];
            }
        }
    }
    const double *rows = of->U + node->rows;
    for (size_t k = 0; k < front.own; k += ABREAST) {
        size_t many = k + ABREAST <= front.own ? ABREAST : front.own - k;
        vec own[ABREAST] = {{0}};
        for (size_t n = 0; n < many; n++) {
            own[n] = load(x + (k + n) * LANES);
            for (size_t above = 0; above < n; above++) {
                own[n] -= rows[(k + above) * front.length + k + n] * own[above];
            }
            own[n] *= rows[(k + n) * front.length + k + n];
            store(x + (k + n) * LANES, own[n]);
        }
        if (many == ABREAST) {
            take(rows + k * front.length + k + ABREAST, front.length, ABREAST, own, x + (k + ABREAST) * LANES,
                 front.own - k - ABREAST);
            take(rows + k * front.length + front.start, front.length, ABREAST, own, border, front.border);
        } else {
            take(rows + k * front.length + front.start, front.length, many, own, border, front.border);
        }
    }
}

static void backward(const struct solver_closure_factor *of, size_t index)
{
    const struct solver_closure_node *node = &of->node[index];
    struct solver_front front = solver_front_of(of, node);
    double *x = of->x + node->begin * WIDTH * LANES, *border = of->carried + node->border * WIDTH * LANES;
    for (size_t n = 0; n < node->border_count; n++) {
        memcpy(border + n * WIDTH * LANES, of->x + of->border[node->border + n] * WIDTH * LANES,
               WIDTH * LANES * sizeof *border);
    }
    /* the last group is the one that is not whole */
    for (size_t after = front.own; after > 0;) {
        size_t many = after % ABREAST == 0 ? ABREAST : after % ABREAST, k = after - many;
        const double *rows = of->U + node->rows + k * front.length;
        vec sum[ABREAST] = {{0}};
        if (many == ABREAST) {
            gather(rows + front.start, front.length, ABREAST, border, front.border, sum);
            gather(rows + after, front.length, ABREAST, x + after * LANES, front.own - after, sum);
        } else {
            gather(rows + front.start, front.length, many, border, front.border, sum);
        }
        for (size_t n = many; n-- > 0;) {
            const double *row = rows + n * front.length;
            vec left = load(x + (k + n) * LANES) - sum[n];
            for (size_t j = k + n + 1; j < after; j++) {
                left -= row[j] * load(x + j * LANES);
            }
            store(x + (k + n) * LANES, row[k + n] * left);
        }
        after = k;
    }
}

const struct solver_front_loops DIM_NAME(solver_front) = {
    .assemble = assemble,
    .eliminate = eliminate,
    .subtract = subtract,
    .forward = forward,
    .backward = backward,
};
