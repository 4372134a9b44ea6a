/* Smoothing on the particles, in single precision (closure.h), compiled per dimension and path.
 *
 * A narrow vector is [count][COLUMNS][4] floats: for each component of C four numbers, alpha, then beta by components,
 * padded with zeros; in 3D a fourth column, of zeros, fills the widest vectors. A pair has sqrt(w) (-1, d/2): with
 * s = sum of that times u_b, what b gives to (M u)_a is that times s, but for the sign of the first. What a itself
 * gives is D_a u_a, D_a the block on the diagonal; only D^-1 is kept, as D^-1 (r - M u) is D^-1 (r - what others give)
 * less u_a, and where D has no inverse, what stands for it is that of a larger block. Pairs that hardly weigh are in
 * those blocks only, twice: as (x + y)^2 <= 2 x^2 + 2 y^2 on a pair, the matrix that smoothing sees is at least M, and
 * steps that are stable for it are for M. */
#include "solver/closure.h"

#include "solver/dim.h"
#include "solver/small.h"

#include <math.h>
#include <string.h>

enum { WIDTH = DIM + 1, BLOCK = WIDTH * LANES, FOUR = 4, COLUMNS = DIM == 3 ? 4 : DIM, NARROW = FOUR * COLUMNS };

/* Several columns at a time, as many as a register holds. */
#if DIM == 3 && defined __AVX512F__
enum { PART = 16 };
#elif DIM >= 2 && defined __AVX__
enum { PART = 8 };
#else
enum { PART = 4 };
#endif
enum { PARTS = NARROW / PART };
typedef float part __attribute__((vector_size(PART * sizeof(float))));

#if DIM == 3 && defined __AVX512F__
#define IN_COLUMNS(v, i, j, k, l)                                                                                      \
    __builtin_shufflevector(v, v, i, j, k, l, 4 + (i), 4 + (j), 4 + (k), 4 + (l), 8 + (i), 8 + (j), 8 + (k), 8 + (l),  \
                            12 + (i), 12 + (j), 12 + (k), 12 + (l))
#elif DIM >= 2 && defined __AVX__
#define IN_COLUMNS(v, i, j, k, l) __builtin_shufflevector(v, v, i, j, k, l, 4 + (i), 4 + (j), 4 + (k), 4 + (l))
#else
#define IN_COLUMNS(v, i, j, k, l) __builtin_shufflevector(v, v, i, j, k, l)
#endif

struct narrow {
    part of[PARTS];
};

/* The same four numbers in each column. GCC 12 makes a shuffle of a loaded four a detour through memory. */
static inline part in_each(const float *four)
{
#if DIM == 3 && defined __AVX512F__
    return (part)_mm512_broadcast_f32x4(_mm_load_ps(four));
#elif DIM >= 2 && defined __AVX__
    return (part)_mm256_broadcast_ps((const __m128 *)four);
#else
    return *(const part *)four;
#endif
}

/* In all places of a column, the sum of its four. */
static inline part column_sum(part v)
{
    v += IN_COLUMNS(v, 1, 0, 3, 2);
    return v + IN_COLUMNS(v, 2, 3, 0, 1);
}

static inline struct narrow load_narrow(const float *from)
{
    struct narrow v;
    for (int p = 0; p < PARTS; p++) {
        v.of[p] = *(const part *)(from + p * PART);
    }
    return v;
}

static inline void store_narrow(float *to, struct narrow v)
{
    for (int p = 0; p < PARTS; p++) {
        *(part *)(to + p * PART) = v.of[p];
    }
}

/* A symmetric block times each column of v. */
static inline struct narrow times_block(const float *block, struct narrow v)
{
    struct narrow out;
    for (int p = 0; p < PARTS; p++) {
        part in = v.of[p];
        part sum = in_each(block) * IN_COLUMNS(in, 0, 0, 0, 0);
        sum += in_each(block + FOUR) * IN_COLUMNS(in, 1, 1, 1, 1);
#if DIM > 1
        sum += in_each(block + 2 * FOUR) * IN_COLUMNS(in, 2, 2, 2, 2);
#endif
#if DIM > 2
        sum += in_each(block + 3 * FOUR) * IN_COLUMNS(in, 3, 3, 3, 3);
#endif
        out.of[p] = sum;
    }
    return out;
}

/* What particle a has of M u from its neighbours. Two sums do not wait for each other. */
static inline struct narrow from_others(const struct solver_closure *of, const float *u, size_t a)
{
    static const float flip[FOUR] __attribute__((aligned(16))) = {-1.0f, 1.0f, 1.0f, 1.0f};
    struct narrow sum[2] = {{{{0}}}};
    size_t end = of->strong_row[a + 1];
    for (size_t ab = of->strong_row[a]; ab < end; ab += 2) {
        for (size_t n = 0; n < 2 && ab + n < end; n++) {
            const float *u_b = u + (size_t)of->strong[ab + n] * NARROW;
            part c = in_each(of->pair + (ab + n) * FOUR);
            for (int p = 0; p < PARTS; p++) {
                sum[n].of[p] += c * column_sum(c * *(const part *)(u_b + p * PART));
            }
        }
    }
    for (int p = 0; p < PARTS; p++) {
        sum[0].of[p] = in_each(flip) * (sum[0].of[p] + sum[1].of[p]);
    }
    return sum[0];
}

/* --- what stays --- */

static void to_narrow(const double block[4][4], float *out)
{
    for (int i = 0; i < WIDTH; i++) {
        for (int j = 0; j < WIDTH; j++) {
            out[i * FOUR + j] = (float)(0.5 * (block[i][j] + block[j][i]));
        }
    }
}

static void prepare(struct solver_closure *of, size_t begin, size_t end)
{
    const struct solver_graph *graph = of->graph;
    for (size_t a = begin; a < end; a++) {
        double block[4][4] = {{0}};
        size_t kept_pair = of->strong_row[a];
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            vec half = of->scale * (load(of->X + (size_t)graph->neighbour[ab] * LANES) - load(of->X + a * LANES));
            double g[WIDTH] = {1.0};
            for (int i = 0; i < DIM; i++) {
                g[i + 1] = half[i];
            }
            bool weak = of->weight[ab] < of->weak;
            if (!weak) {
                float *pair = of->pair + kept_pair * FOUR;
                double root = sqrt(of->weight[ab]);
                of->strong[kept_pair++] = graph->neighbour[ab];
                pair[0] = (float)-root;
                for (int i = 0; i < DIM; i++) {
                    pair[i + 1] = (float)(root * half[i]);
                }
            }
            for (int i = 0; i < WIDTH; i++) {
                for (int j = 0; j < WIDTH; j++) {
                    block[i][j] += (weak ? 2.0 : 1.0) * of->weight[ab] * g[i] * g[j];
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
        to_narrow(block, of->inverse + a * FOUR * FOUR);
    }
}

/* --- the steps --- */

/* Changes die away from where they begin, and numbers below a float's usual range take processors a hundred times as
 * long; they count as zero from `begin_flush` on, until what it gave is handed to `end_flush`. */
static inline unsigned begin_flush(void)
{
    unsigned kept = 0;
#ifdef __SSE__
    enum { OF_RESULTS = 0x8000, OF_OPERANDS = 0x40 };
    kept = __builtin_ia32_stmxcsr();
    __builtin_ia32_ldmxcsr(kept | OF_RESULTS | OF_OPERANDS);
#endif
    return kept;
}

static inline void end_flush(unsigned kept)
{
#ifdef __SSE__
    __builtin_ia32_ldmxcsr(kept);
#else
    (void)kept;
#endif
}

static void start(const struct solver_closure *of, float factor, const double *r, const double *image, size_t begin,
                  size_t end)
{
    unsigned kept = begin_flush();
    for (size_t a = begin; a < end; a++) {
        float *rest = of->rest + a * NARROW;
        for (size_t i = 0; i < WIDTH; i++) {
            size_t at = a * BLOCK + i * LANES;
            float row[LANES];
            store_floats(row, image == NULL ? load(r + at) : load(r + at) - load(image + at));
            for (size_t k = 0; k < DIM; k++) {
                rest[k * FOUR + i] = row[k];
            }
        }
        struct narrow x = times_block(of->inverse + a * FOUR * FOUR, load_narrow(rest));
        for (int p = 0; p < PARTS; p++) {
            x.of[p] *= factor;
        }
        store_narrow(of->now + a * NARROW, x);
        store_narrow(of->last + a * NARROW, (struct narrow){{{0}}});
    }
    end_flush(kept);
}

static void smooth(const struct solver_closure *of, float keep, float factor, size_t begin, size_t end)
{
    unsigned kept = begin_flush();
    for (size_t a = begin; a < end; a++) {
        struct narrow rest = load_narrow(of->rest + a * NARROW);
        struct narrow others = from_others(of, of->now, a);
        struct narrow x = load_narrow(of->now + a * NARROW), last = load_narrow(of->last + a * NARROW);
        for (int p = 0; p < PARTS; p++) {
            rest.of[p] -= others.of[p];
        }
        struct narrow own = times_block(of->inverse + a * FOUR * FOUR, rest);
        for (int p = 0; p < PARTS; p++) {
            last.of[p] = x.of[p] + keep * (x.of[p] - last.of[p]) + factor * (own.of[p] - x.of[p]);
        }
        store_narrow(of->last + a * NARROW, last);
    }
    end_flush(kept);
}

static void finish(const struct solver_closure *of, bool add, double *z, size_t begin, size_t end)
{
    for (size_t a = begin; a < end; a++) {
        const float *x = of->now + a * NARROW;
        for (size_t i = 0; i < WIDTH; i++) {
            vec sum = add ? load(z + a * BLOCK + i * LANES) : splat(0.0);
            for (size_t k = 0; k < DIM; k++) {
                sum[k] += (double)x[k * FOUR + i];
            }
            store(z + a * BLOCK + i * LANES, sum);
        }
    }
}

const struct solver_closure_smoother DIM_NAME(solver_closure_smoother) = {
    .width = NARROW,
    .prepare = prepare,
    .start = start,
    .smooth = smooth,
    .finish = finish,
};
