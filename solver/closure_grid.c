/* The grids of splines of closure.h: which splines there are, and their matrices. The finest has cells no narrower than
 * the neighbours' radius, and its matrix is P^T M P, P the splines' values and slopes on the particles; those of the
 * coarser ones follow from it, as their splines are sums of finer ones. */
#include "solver/closure.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    BITS = 21,
    MARGIN = 8,
    SPAN = 2 * SOLVER_CLOSURE_REACH + 1,
    FEWEST = 4,
    SLAB = 4,
    POWERS = 12,
    LINE = SOLVER_CLOSURE_LINE
};
/* Splines of the coarsest grid at most, in 1D, 2D and 3D. In 2D, 48 would take a tenth to a third more iterations on
 * perturbed particles; 300, where the shift of the factor begins to show, up to a third more on small clouds. */
static const size_t coarsest[] = {12, 160, 160};

static size_t power(size_t base, int dim)
{
    return dim == 1 ? base : base * power(base, dim - 1);
}

static uint64_t key_of(int64_t x, int64_t y, int64_t z)
{
    return (uint64_t)(x + MARGIN) | (uint64_t)(y + MARGIN) << BITS | (uint64_t)(z + MARGIN) << 2 * BITS;
}

static void place_of(uint64_t key, int32_t at[3])
{
    for (int i = 0; i < 3; i++) {
        at[i] = (int32_t)(key >> i * BITS & ((1u << BITS) - 1)) - MARGIN;
    }
}

static int by_key(const void *x, const void *y)
{
    uint64_t a = *(const uint64_t *)x, b = *(const uint64_t *)y;
    return (a > b) - (a < b);
}

static size_t sort_unique(uint64_t *key, size_t count)
{
    size_t unique = 0;
    qsort(key, count, sizeof *key, by_key);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || key[i] != key[unique - 1]) {
            key[unique++] = key[i];
        }
    }
    return unique;
}

/* First of the ascending keys that is not below `key`. */
static size_t first_of(const uint64_t *keys, size_t count, uint64_t key)
{
    size_t low = 0, high = count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (keys[middle] < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static uint32_t find(const uint64_t *keys, size_t count, uint64_t key)
{
    size_t at = first_of(keys, count, key);
    return at < count && keys[at] == key ? (uint32_t)at : UINT32_MAX;
}

/* Splines of the given keys, each of which may come several times. */
static bool make_splines(struct solver_closure_grid *grid, int dim, uint64_t *key, size_t count, size_t lanes,
                         struct solver_error *error)
{
    grid->dim = dim;
    grid->count = sort_unique(key, count);
    if (!solver_alloc((void **)&grid->key, grid->count, sizeof *grid->key, "splines", error) ||
        !solver_alloc((void **)&grid->at, grid->count * 3, sizeof *grid->at, "splines", error) ||
        !solver_alloc((void **)&grid->row, grid->count + 1, sizeof *grid->row, "spline matrix", error) ||
        !solver_alloc((void **)&grid->diagonal, grid->count, sizeof(double), "spline matrix", error) ||
        !solver_alloc((void **)&grid->x, grid->count * lanes, sizeof(double), "spline vectors", error) ||
        !solver_alloc((void **)&grid->r, grid->count * lanes, sizeof(double), "spline vectors", error) ||
        !solver_alloc((void **)&grid->d, (grid->count + LINE) * lanes, sizeof(double), "spline vectors", error) ||
        !solver_alloc((void **)&grid->next, (grid->count + LINE) * lanes, sizeof(double), "spline vectors", error)) {
        return false;
    }
    memcpy(grid->key, key, grid->count * sizeof *key);
    for (size_t i = 0; i < grid->count; i++) {
        place_of(grid->key[i], grid->at + i * 3);
    }
    return true;
}

/* The entries of one line of row i, y and z places beyond its own, from rows that are dense over the places around;
 * where `upper`, only lines of places from the row's own on are there, and the others are the transpose's. Returns the
 * first spline of the line, and whether there is any. */
static size_t line_of(const struct solver_closure_grid *grid, const double *dense, bool upper, size_t i, int y, int z,
                      double value[LINE], bool *any)
{
    const int32_t *at = grid->at + i * 3;
    size_t width = power(SPAN, grid->dim), centre = width / 2;
    uint64_t last = key_of(at[0] + SOLVER_CLOSURE_REACH, at[1] + y, at[2] + z);
    size_t first = first_of(grid->key, grid->count, key_of(at[0] - SOLVER_CLOSURE_REACH, at[1] + y, at[2] + z));
    *any = false;
    memset(value, 0, LINE * sizeof *value);
    for (size_t j = first; j < grid->count && grid->key[j] <= last; j++) {
        long line = z * SPAN + y;
        size_t offset = (size_t)((long)centre + line * SPAN + grid->at[j * 3] - at[0]);
        double entry = upper && line < 0 ? dense[j * width + width - 1 - offset] : dense[i * width + offset];
        value[j - first] = entry;
        *any = *any || entry != 0.0;
    }
    return first;
}

/* The matrix from such rows. */
static bool compress(struct solver_closure_grid *grid, const double *dense, bool upper, struct solver_error *error)
{
    int up = grid->dim > 1 ? SOLVER_CLOSURE_REACH : 0, back = grid->dim > 2 ? SOLVER_CLOSURE_REACH : 0;
    size_t width = power(SPAN, grid->dim);
    for (int pass = 0; pass < 2; pass++) {
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < grid->count; i++) {
            size_t at = pass == 0 ? 0 : grid->row[i];
            for (int n = 0; n < (2 * back + 1) * (2 * up + 1); n++) {
                double value[LINE];
                bool any;
                size_t first =
                    line_of(grid, dense, upper, i, n % (2 * up + 1) - up, n / (2 * up + 1) - back, value, &any);
                if (any && pass == 1) {
                    grid->column[at] = (uint32_t)first;
                    memcpy(grid->value + at * LINE, value, sizeof value);
                }
                at += any;
            }
            if (pass == 0) {
                grid->row[i + 1] = at;
                double own = dense[i * width + width / 2];
                grid->diagonal[i] = own > 0.0 ? 1.0 / own : 0.0;
            }
        }
        for (size_t i = 0; pass == 0 && i < grid->count; i++) {
            grid->row[i + 1] += grid->row[i];
        }
        size_t lines = grid->row[grid->count];
        if (pass == 0 &&
            (!solver_alloc((void **)&grid->column, lines, sizeof *grid->column, "spline matrix", error) ||
             !solver_alloc((void **)&grid->value, lines * LINE, sizeof *grid->value, "spline matrix", error))) {
            return false;
        }
    }
    return true;
}

/* --- the finest grid --- */

struct sorted {
    uint64_t key;
    size_t particle;
};

static int by_cell(const void *x, const void *y)
{
    const struct sorted *a = x, *b = y;
    int order = (a->key > b->key) - (a->key < b->key);
    return order != 0 ? order : (a->particle > b->particle) - (a->particle < b->particle);
}

/* Particles into cells. Axis 0 of the grid is axis 0 of the cloud. */
static bool make_cells(struct solver_closure *of, double radius, struct solver_error *error)
{
    const struct solver_cloud *cloud = of->cloud;
    size_t dim = (size_t)cloud->dim, lanes = of->loops->lanes, count = cloud->count;
    struct sorted *sorted = NULL;
    double upper = 0.0;
    of->width = fmax(2.0 * cloud->spacing, radius * (1.0 + solver_closure_slack));
    for (size_t i = 0; i < dim; i++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t a = 0; a < count; a++) {
            least = fmin(least, of->X[a * lanes + i]);
            most = fmax(most, of->X[a * lanes + i]);
        }
        of->origin[i] = least - solver_closure_slack * cloud->spacing;
        upper = fmax(upper, most - least);
    }
    if (!(upper / of->width < (double)((1 << BITS) - 4 * MARGIN))) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "stencil closed: the cloud is %.3g spacings long, and at most 4e6 are meant; make it "
                           "shorter, or choose another stencil",
                           upper / cloud->spacing);
    }
    if (!solver_alloc((void **)&sorted, count, sizeof *sorted, "cells", error) ||
        !solver_alloc((void **)&of->cell_start, count + 1, sizeof *of->cell_start, "cells", error) ||
        !solver_alloc((void **)&of->cell_particle, count, sizeof *of->cell_particle, "cells", error) ||
        !solver_alloc((void **)&of->cell_of, count, sizeof *of->cell_of, "cells", error) ||
        !solver_alloc((void **)&of->cell_at, count * 3, sizeof *of->cell_at, "cells", error)) {
        free(sorted);
        return false;
    }
    for (size_t a = 0; a < count; a++) {
        int64_t at[3] = {0};
        for (size_t i = 0; i < dim; i++) {
            at[i] = (int64_t)floor((of->X[a * lanes + i] - of->origin[i]) / of->width);
        }
        sorted[a] = (struct sorted){key_of(at[0], at[1], at[2]), a};
    }
    qsort(sorted, count, sizeof *sorted, by_cell);
    of->cell_count = 0;
    for (size_t p = 0; p < count; p++) {
        if (p == 0 || sorted[p].key != sorted[p - 1].key) {
            place_of(sorted[p].key, of->cell_at + of->cell_count * 3);
            of->cell_start[of->cell_count++] = p;
        }
        of->cell_particle[p] = (uint32_t)sorted[p].particle;
        of->cell_of[sorted[p].particle] = (uint32_t)(of->cell_count - 1);
    }
    of->cell_start[of->cell_count] = count;
    free(sorted);
    return true;
}

/* The splines of the cells, and which is which. */
static bool make_finest(struct solver_closure *of, struct solver_error *error)
{
    struct solver_closure_grid *grid = &of->grid[0];
    size_t splines = power(3, of->cloud->dim), wanted = of->cell_count * splines;
    uint64_t *key = NULL;
    if (!solver_alloc((void **)&key, 2 * wanted, sizeof *key, "splines", error)) {
        return false;
    }
    for (size_t n = 0; n < wanted; n++) {
        const int32_t *at = of->cell_at + n / splines * 3;
        size_t place = n % splines;
        key[n] = key[wanted + n] =
            key_of(at[0] + (int64_t)(place % 3), at[1] + (int64_t)(place / 3 % 3), at[2] + (int64_t)(place / 9));
    }
    bool ok =
        make_splines(grid, of->cloud->dim, key, wanted, of->loops->lanes, error) &&
        solver_alloc((void **)&of->cell_spline, wanted, sizeof *of->cell_spline, "splines", error) &&
        solver_alloc((void **)&of->spline_cell, grid->count * splines, sizeof *of->spline_cell, "splines", error) &&
        solver_alloc((void **)&of->cell_sum, wanted * of->loops->lanes, sizeof(double), "spline sums", error);
    if (ok) {
        memset(of->spline_cell, 0xff, grid->count * splines * sizeof *of->spline_cell);
        for (size_t n = 0; n < wanted; n++) {
            of->cell_spline[n] = find(grid->key, grid->count, key[wanted + n]);
            of->spline_cell[of->cell_spline[n] * splines + n % splines] = (uint32_t)(n / splines);
        }
    }
    free(key);
    return ok;
}

/* Slabs of cells along the last axis, every second of which touch different splines: theirs are summed at a time, and
 * in the same order by any number of threads. */
static bool assemble(struct solver_closure *of, struct solver_error *error)
{
    struct solver_closure_grid *grid = &of->grid[0];
    size_t last = (size_t)of->cloud->dim - 1, slabs = 0;
    double *dense = NULL;
    size_t *slab = NULL;
    int32_t longest = of->cell_at[(of->cell_count - 1) * 3 + last];
    if (!solver_alloc((void **)&dense, grid->count * power(SPAN, grid->dim), sizeof *dense, "spline matrix", error) ||
        !solver_alloc((void **)&slab, (size_t)longest / SLAB + 2, sizeof *slab, "slabs", error)) {
        free(dense);
        return false;
    }
    for (size_t cell = 0; cell < of->cell_count; cell++) {
        for (; slabs <= (size_t)of->cell_at[cell * 3 + last] / SLAB; slabs++) {
            slab[slabs] = cell;
        }
    }
    slab[slabs] = of->cell_count;
    for (size_t odd = 0; odd < 2; odd++) {
#pragma omp parallel for schedule(static)
        for (size_t i = odd; i < slabs; i += 2) {
            of->loops->assemble(of, dense, slab[i], slab[i + 1]);
        }
    }
    bool ok = compress(grid, dense, true, error);
    free(slab);
    free(dense);
    return ok;
}

/* --- coarser grids --- */

/* Which two splines of the next grid a spline at `place` is part of: half its place rounded down, and the next. */
static bool make_parents(struct solver_closure_grid *fine, struct solver_closure_grid *coarse, size_t lanes,
                         struct solver_error *error)
{
    size_t parents = power(2, fine->dim), wanted = fine->count * parents;
    uint64_t *key = NULL;
    if (!solver_alloc((void **)&key, 2 * wanted, sizeof *key, "splines", error)) {
        return false;
    }
    for (size_t n = 0; n < wanted; n++) {
        const int32_t *at = fine->at + n / parents * 3;
        int64_t to[3] = {0};
        for (int i = 0; i < fine->dim; i++) {
            to[i] = (at[i] >> 1) + (int64_t)(n % parents >> i & 1);
        }
        key[n] = key[wanted + n] = key_of(to[0], to[1], to[2]);
    }
    bool ok = make_splines(coarse, fine->dim, key, wanted, lanes, error) &&
              solver_alloc((void **)&fine->parent, wanted, sizeof *fine->parent, "splines", error) &&
              solver_alloc((void **)&fine->child_row, coarse->count + 2, sizeof *fine->child_row, "splines", error) &&
              solver_alloc((void **)&fine->child, wanted, sizeof *fine->child, "splines", error);
    for (size_t n = 0; ok && n < wanted; n++) {
        fine->parent[n] = find(coarse->key, coarse->count, key[wanted + n]);
        fine->child_row[fine->parent[n] + 2]++;
    }
    for (size_t i = 0; ok && i < coarse->count; i++) {
        fine->child_row[i + 2] += fine->child_row[i + 1];
    }
    for (size_t n = 0; ok && n < wanted; n++) {
        fine->child[fine->child_row[fine->parent[n] + 1]++] = (uint32_t)n;
    }
    free(key);
    return ok;
}

static double share_of(const int32_t *at, int dim, size_t parent)
{
    double share = 1.0;
    for (int i = 0; i < dim; i++) {
        share *= solver_closure_share(at[i], (int)(parent >> i & 1));
    }
    return share;
}

/* Row i of the coarse matrix, over the places around: first of the rows of its children, over finer places. */
static void coarse_row(const struct solver_closure_grid *fine, const struct solver_closure_grid *coarse, size_t i,
                       double *row)
{
    enum { FINE = 2 * SOLVER_CLOSURE_REACH + FEWEST }; /* finer places along an axis: four children, and their reach */
    double window[FINE * FINE * FINE] = {0.0};
    int dim = fine->dim;
    size_t parents = power(2, dim);
    const int32_t *at = coarse->at + i * 3;
    int32_t first[3] = {0};
    for (int axis = 0; axis < dim; axis++) {
        first[axis] = 2 * at[axis] - 2 - SOLVER_CLOSURE_REACH;
    }
    for (size_t of = fine->child_row[i]; of < fine->child_row[i + 1]; of++) {
        size_t child = fine->child[of] / parents;
        double share = share_of(fine->at + child * 3, dim, fine->child[of] % parents);
        for (size_t n = fine->row[child] * LINE; n < fine->row[child + 1] * LINE; n++) {
            if (fine->value[n] != 0.0) {
                const int32_t *to = fine->at + (fine->column[n / LINE] + n % LINE) * 3;
                int32_t place = ((to[2] - first[2]) * FINE + to[1] - first[1]) * FINE + to[0] - first[0];
                window[place] += share * fine->value[n];
            }
        }
    }
    int sides[3] = {FINE, dim > 1 ? FINE : 1, dim > 2 ? FINE : 1};
    for (int z = 0; z < sides[2]; z++) {
        for (int y = 0; y < sides[1]; y++) {
            for (int x = 0; x < sides[0]; x++) {
                double value = window[(z * FINE + y) * FINE + x];
                const int32_t to[3] = {first[0] + x, first[1] + y, first[2] + z};
                for (size_t parent = 0; value != 0.0 && parent < parents; parent++) {
                    int32_t place = 0;
                    for (size_t axis = (size_t)dim; axis-- > 0;) {
                        place = place * SPAN + (to[axis] >> 1) + (int32_t)(parent >> axis & 1) - at[axis] +
                                SOLVER_CLOSURE_REACH;
                    }
                    row[place] += share_of(to, dim, parent) * value;
                }
            }
        }
    }
}

static bool coarsen(struct solver_closure_grid *fine, struct solver_closure_grid *coarse, size_t lanes,
                    struct solver_error *error)
{
    double *dense = NULL;
    size_t width = power(SPAN, fine->dim);
    if (!make_parents(fine, coarse, lanes, error) ||
        !solver_alloc((void **)&dense, coarse->count * width, sizeof *dense, "spline matrix", error)) {
        return false;
    }
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < coarse->count; i++) {
        coarse_row(fine, coarse, i, dense + i * width);
    }
    bool ok = compress(coarse, dense, false, error);
    free(dense);
    return ok;
}

/* The largest eigenvalue of matrix / diagonal by power iteration, with a margin. */
static void bound(struct solver_closure_grid *grid, const struct solver_closure_loops *loops)
{
    size_t room = grid->count * loops->lanes;
    uint64_t state = 1;
    double largest = 0.0;
    for (size_t i = 0; i < room; i++) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        grid->d[i] = (double)(state >> 40) / 16777216.0 - 0.5;
    }
    for (int round = 0; round < POWERS; round++) {
        double before = 0.0, after = 0.0;
        memset(grid->r, 0, room * sizeof *grid->r);
#pragma omp parallel for schedule(static)
        for (size_t i = 0; i < grid->count; i++) {
            loops->grid_smooth(grid, 0.0, -1.0, grid->d, grid->x, grid->r, grid->next, i, i + 1);
        }
        for (size_t i = 0; i < room; i++) {
            size_t row = i / loops->lanes;
            double weight = grid->diagonal[row] > 0.0 ? 1.0 / grid->diagonal[row] : 0.0;
            before += weight * grid->d[i] * grid->d[i];
            after += weight * grid->next[i] * grid->next[i];
        }
        largest = before > 0.0 ? sqrt(after / before) : 1.0;
        for (size_t i = 0; i < room; i++) {
            grid->d[i] = largest > 0.0 ? grid->next[i] / largest : 0.0;
        }
    }
    grid->largest = largest > 0.0 ? 1.15 * largest : 1.0;
}

bool solver_closure_grids(struct solver_closure *of, double radius, struct solver_error *error)
{
    size_t lanes = of->loops->lanes;
    bool ok = make_cells(of, radius, error) && make_finest(of, error) && assemble(of, error);
    of->levels = 1;
    while (ok && of->grid[of->levels - 1].count > coarsest[of->cloud->dim - 1] && of->levels < SOLVER_CLOSURE_LEVELS) {
        of->levels++;
        ok = coarsen(&of->grid[of->levels - 2], &of->grid[of->levels - 1], lanes, error);
    }
    for (int level = 0; ok && level < of->levels - 1; level++) {
        bound(&of->grid[level], of->loops);
    }
    return ok && solver_closure_factorise(&of->grid[of->levels - 1], error);
}

void solver_closure_grids_free(struct solver_closure *of)
{
    for (int level = 0; level < SOLVER_CLOSURE_LEVELS; level++) {
        struct solver_closure_grid *grid = &of->grid[level];
        free(grid->key);
        free(grid->at);
        free(grid->row);
        free(grid->column);
        free(grid->value);
        free(grid->diagonal);
        free(grid->parent);
        free(grid->child_row);
        free(grid->child);
        free(grid->factor);
        free(grid->x);
        free(grid->r);
        free(grid->d);
        free(grid->next);
    }
    free(of->cell_at);
    free(of->cell_start);
    free(of->cell_particle);
    free(of->cell_of);
    free(of->cell_spline);
    free(of->spline_cell);
    free(of->cell_sum);
}
