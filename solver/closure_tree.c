/* The tree of closure_factor.h: nested dissection by places, and the borders of its nodes. */
#include "solver/closure.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Particles of a leaf, at most. */
enum { LEAF = 8 };

struct dissection {
    const struct solver_closure *of;
    struct solver_closure_factor *factor;
    uint32_t *half; /* [count] which half of which set a particle is in: 2 sets + 1 for upper ones */
    uint32_t sets;
    uint32_t *kept; /* [count] room */
};

static double along(const struct solver_closure *of, uint32_t a, int axis)
{
    return of->X[a * of->loops->lanes + (size_t)axis];
}

/* Along an axis; of two at one height, by number. */
static bool before(const struct solver_closure *of, int axis, uint32_t a, uint32_t b)
{
    double x = along(of, a, axis), y = along(of, b, axis);
    return x < y || (x <= y && a < b);
}

/* Puts the lower ones of set [begin, end) before `middle`. */
static void halve(const struct solver_closure *of, uint32_t *set, size_t begin, size_t middle, size_t end, int axis)
{
    while (begin < middle && end - begin > 1) {
        uint32_t pivot = set[begin + (end - begin) / 2];
        size_t i = begin, j = end - 1;
        while (true) {
            while (before(of, axis, set[i], pivot)) {
                i++;
            }
            while (before(of, axis, pivot, set[j])) {
                j--;
            }
            if (i >= j) {
                break;
            }
            uint32_t kept = set[i];
            set[i++] = set[j];
            set[j--] = kept;
        }
        /* all before i are no higher than the pivot, all from i on no lower */
        if (i == begin) {
            i++; /* the pivot is the lowest and stands first */
        }
        if (middle < i) {
            end = i;
        } else {
            begin = i;
        }
    }
}

static int longest_side(const struct solver_closure *of, const uint32_t *set, size_t count)
{
    int longest = 0;
    double most = -1.0;
    for (int axis = 0; axis < of->cloud->dim; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (size_t n = 0; n < count; n++) {
            low = fmin(low, along(of, set[n], axis));
            high = fmax(high, along(of, set[n], axis));
        }
        if (high - low > most) {
            most = high - low;
            longest = axis;
        }
    }
    return longest;
}

static bool has_neighbour(const struct dissection *work, uint32_t a, uint32_t half)
{
    const struct solver_graph *graph = work->of->graph;
    for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
        if (work->half[graph->neighbour[ab]] == half) {
            return true;
        }
    }
    return false;
}

/* Moves those of set [begin, end) that are neighbours of the other half behind the others; returns how many. */
static size_t part(struct dissection *work, size_t begin, size_t end, uint32_t other)
{
    uint32_t *set = work->factor->particle;
    size_t moved = 0, at = begin;
    for (size_t n = begin; n < end; n++) {
        if (has_neighbour(work, set[n], other)) {
            work->kept[moved++] = set[n];
        } else {
            set[at++] = set[n];
        }
    }
    memcpy(set + at, work->kept, moved * sizeof *set);
    return moved;
}

/* Orders places [begin, end) and appends their nodes. */
static size_t dissect(struct dissection *work, size_t begin, size_t end, int depth)
{
    struct solver_closure_factor *factor = work->factor;
    uint32_t *set = factor->particle;
    struct solver_closure_node node = {.begin = begin, .end = end, .first = factor->node_count, .depth = depth};
    size_t child[2], children = 0;
    if (end - begin > LEAF) {
        size_t middle = begin + (end - begin) / 2;
        halve(work->of, set, begin, middle, end, longest_side(work->of, set + begin, end - begin));
        uint32_t lower = 2 * work->sets++, upper = lower + 1;
        for (size_t n = begin; n < end; n++) {
            work->half[set[n]] = n < middle ? lower : upper;
        }
        size_t between = part(work, begin, middle, upper);
        /* they lie in the middle: behind the upper half with them */
        memcpy(work->kept, set + middle - between, between * sizeof *set);
        memmove(set + middle - between, set + middle, (end - middle) * sizeof *set);
        memcpy(set + end - between, work->kept, between * sizeof *set);
        node.begin = end - between;
        child[children++] = dissect(work, begin, middle - between, depth + 1);
        child[children++] = dissect(work, middle - between, end - between, depth + 1);
    }
    node.parent = SIZE_MAX;
    factor->node[factor->node_count] = node;
    for (size_t n = 0; n < children; n++) {
        factor->node[child[n]].parent = factor->node_count;
    }
    return factor->node_count++;
}

static int ascending(const void *x, const void *y)
{
    uint32_t a = *(const uint32_t *)x, b = *(const uint32_t *)y;
    return (a > b) - (a < b);
}

struct borders {
    struct solver_closure_factor *factor;
    uint32_t *seen; /* [count] the last node that has it, + 1 */
    size_t room;
};

static bool onto_border(struct borders *work, struct solver_closure_node *node, size_t index, uint32_t place)
{
    struct solver_closure_factor *factor = work->factor;
    if (place < node->end || work->seen[place] == index + 1) {
        return true;
    }
    if (factor->border_total == work->room) {
        size_t room = 2 * work->room + 16;
        uint32_t *larger = realloc(factor->border, room * sizeof *larger);
        if (larger == NULL) {
            return false;
        }
        factor->border = larger;
        work->room = room;
    }
    work->seen[place] = (uint32_t)index + 1;
    factor->border[factor->border_total++] = place;
    node->border_count++;
    return true;
}

/* A node's border: its particles' neighbours, and its children's borders, but for what comes before its end. Children
 * are its own last node but one, and the one before that one's subtree. */
static bool make_border(const struct solver_closure *of, struct borders *work, size_t index)
{
    struct solver_closure_factor *factor = work->factor;
    struct solver_closure_node *node = &factor->node[index];
    const struct solver_graph *graph = of->graph;
    node->border = factor->border_total;
    for (size_t n = node->begin; n < node->end; n++) {
        size_t a = factor->particle[n];
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            if (!onto_border(work, node, index, factor->place[graph->neighbour[ab]])) {
                return false;
            }
        }
    }
    for (size_t last = index; last > node->first; last = factor->node[last - 1].first) {
        const struct solver_closure_node *child = &factor->node[last - 1];
        for (size_t n = 0; n < child->border_count; n++) {
            if (!onto_border(work, node, index, factor->border[child->border + n])) {
                return false;
            }
        }
    }
    qsort(factor->border + node->border, node->border_count, sizeof *factor->border, ascending);
    return true;
}

static bool make_borders(const struct solver_closure *of, struct borders *work, struct solver_error *error)
{
    struct solver_closure_factor *factor = work->factor;
    if (!solver_alloc((void **)&factor->border, work->room, sizeof *factor->border, "borders of sets", error)) {
        return false;
    }
    for (size_t n = 0; n < factor->node_count; n++) {
        struct solver_closure_node *node = &factor->node[n];
        if (!make_border(of, work, n)) {
            return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the borders of sets");
        }
        struct solver_front front = solver_front_of(factor, node);
        node->rows = factor->size;
        factor->size += front.own * front.length;
        double own = (double)front.own, border = (double)front.border;
        factor->operations += own * (own * own / 6.0 + 0.5 * own * border + 0.5 * border * border);
    }
    return true;
}

bool solver_closure_tree(struct solver_closure *of, struct solver_error *error)
{
    struct solver_closure_factor *factor = &of->factor;
    size_t count = of->cloud->count;
    struct dissection work = {.of = of, .factor = factor};
    factor->width = (size_t)of->cloud->dim + 1;
    /* a set of more than LEAF has two halves of LEAF / 2 or more, before some go between them */
    size_t most = count + 1;
    bool ok =
        solver_alloc((void **)&factor->particle, count, sizeof *factor->particle, "order of elimination", error) &&
        solver_alloc((void **)&factor->place, count, sizeof *factor->place, "order of elimination", error) &&
        solver_alloc((void **)&factor->node, most, sizeof *factor->node, "sets of particles", error) &&
        solver_alloc((void **)&work.half, count, sizeof *work.half, "sets of particles", error) &&
        solver_alloc((void **)&work.kept, count, sizeof *work.kept, "sets of particles", error);
    for (size_t a = 0; ok && a < count; a++) {
        factor->particle[a] = (uint32_t)a;
        work.half[a] = UINT32_MAX;
    }
    if (ok) {
        (void)dissect(&work, 0, count, 0);
        for (size_t n = 0; n < count; n++) {
            factor->place[factor->particle[n]] = (uint32_t)n;
        }
        memset(work.kept, 0, count * sizeof *work.kept);
        struct borders borders = {factor, work.kept, count};
        ok = make_borders(of, &borders, error);
    }
    free(work.half);
    free(work.kept);
    return ok;
}
