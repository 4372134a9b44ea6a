/* Faces that only hold: of every stage of a step they ask no more than zeros. */
#include "solver/faces.h"
#include "solver/memory.h"

#include <string.h>

static bool only_hold(const struct solver_faces *faces)
{
    bool only = true;
    for (size_t c = 0; c < faces->constraint_count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        only = only && constraint->image == constraint->particle;
        for (size_t i = 0; i < (size_t)faces->dim; i++) {
            only = only && constraint->axis[i].motion < 0;
        }
    }
    return only;
}

bool solver_faces_list_still(struct solver_faces *faces, struct solver_error *error)
{
    size_t count = faces->constraint_count;
    faces->only_hold = only_hold(faces);
    if (!faces->only_hold || count == 0) {
        return true;
    }
    if (!solver_alloc((void **)&faces->still, count, sizeof *faces->still, "particles held", error)) {
        return false;
    }
    for (size_t c = 0; c < count; c++) {
        const struct solver_constraint *constraint = &faces->constraint[c];
        faces->still[c].particle = constraint->particle;
        for (unsigned i = 0; i < (unsigned)faces->dim; i++) {
            faces->still[c].axes |= constraint->axis[i].held ? 1U << i : 0U;
        }
    }
    return true;
}

/* The first of them that is not below `particle`. */
static size_t still_from(const struct solver_faces *faces, size_t particle)
{
    size_t low = 0;
    size_t high = faces->constraint_count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (faces->still[middle].particle < particle) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Bits of a component that stay, by the axes that are held: no branch, as edges and corners take turns. */
#define KEPT(axes)                                                                                                     \
    {                                                                                                                  \
        (uint64_t)((axes)&1) - 1, (uint64_t)((axes) >> 1 & 1) - 1, (uint64_t)((axes) >> 2 & 1) - 1, UINT64_MAX         \
    }
static const uint64_t kept[8][4] = {KEPT(0), KEPT(1), KEPT(2), KEPT(3), KEPT(4), KEPT(5), KEPT(6), KEPT(7)};

static inline __attribute__((always_inline)) void hold(const struct solver_still *still, size_t count, double *v,
                                                       size_t lanes)
{
    enum { WORDS = sizeof *v / sizeof(uint64_t) };
    for (size_t c = 0; c < count; c++) {
        double *of = v + still[c].particle * lanes;
        const uint64_t *keep = kept[still[c].axes];
        for (size_t i = 0; i < lanes; i++) {
            uint64_t bits[WORDS];
            memcpy(bits, of + i, sizeof bits);
            for (size_t word = 0; word < WORDS; word++) {
                bits[word] &= keep[i];
            }
            memcpy(of + i, bits, sizeof bits);
        }
    }
}

static void hold_in_single(const struct solver_still *still, size_t count, struct solver_vectors v)
{
    for (size_t c = 0; c < count; c++) {
        for (size_t i = 0; i < v.lanes; i++) {
            float *of = v.single + still[c].particle * v.lanes + i;
            *of = kept[still[c].axes][i] != 0 ? *of : 0.0F;
        }
    }
}

void solver_faces_hold(const struct solver_faces *faces, struct solver_vectors v, size_t begin, size_t end)
{
    size_t first = still_from(faces, begin);
    size_t count = still_from(faces, end) - first;
    if (v.single != NULL) {
        hold_in_single(faces->still + first, count, v);
    } else if (v.lanes == 4) {
        hold(faces->still + first, count, v.wide, 4);
    } else {
        hold(faces->still + first, count, v.wide, v.lanes);
    }
}
