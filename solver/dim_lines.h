/* The pairs of a group along one axis, where rows are sorted by axis (stencil_align.c). */
#ifndef SOLVER_DIM_LINES_H
#define SOLVER_DIM_LINES_H

#include "solver/dim_pairs.h"

#include <string.h>

/* Pairs of the particles of a group along one axis. */
struct line {
    size_t first[PLACES], end[PLACES];
    size_t shortest, longest;
};

/* Those along I, which follow those along I - 1; `each` as below. */
static inline __attribute__((always_inline)) void next_line(const struct solver_upwind *work, const struct group *group,
                                                            int I, size_t each, struct line *line)
{
    line->shortest = each > 0 ? each : SIZE_MAX;
    line->longest = each;
    for (int g = 0; g < PLACES; g++) {
        size_t count = each > 0 ? each : work->along[group->at[g] * LANES + (size_t)I];
        line->first[g] = I == 0 ? group->row[g] : line->end[g];
        line->end[g] = line->first[g] + count;
        line->shortest = count < line->shortest ? count : line->shortest;
        line->longest = count > line->longest ? count : line->longest;
    }
}

/* Away from the ends of lines, rows of sbp2 have two pairs along each axis: a loop that knows is shorter. */
enum { INNER = 2 };

/* Whether those of a group have. */
static inline __attribute__((always_inline)) bool are_inner(const struct solver_upwind *work, const struct group *group)
{
    static const uint8_t inner[4] = {INNER, DIM > 1 ? INNER : 0, DIM > 2 ? INNER : 0};
    bool all = true;
    for (int g = 0; g < PLACES; g++) {
        all = all && memcmp(work->along + group->at[g] * LANES, inner, LANES) == 0;
    }
    return all;
}

/* The k-th pair of each, or beyond a line's end the last of the row, idle. */
static inline __attribute__((always_inline)) struct pairs
line_pairs(const struct solver_upwind *work, const struct group *group, const struct line *line, size_t k, bool idle)
{
    struct pairs pairs;
    for (int g = 0; g < PLACES; g++) {
        size_t ab = line->first[g] + k;
        set_pair(work, group, g, ab, idle && ab >= line->end[g], &pairs);
    }
    return pairs;
}

/* Pairs along an axis, as many as take turns; of a line's last pair, if it is left alone, a second that is idle. */
struct turn {
    struct pairs pairs[TURNS];
    const size_t *b[TURNS];
    int count;
};

static inline __attribute__((always_inline)) void next_turn(const struct solver_upwind *work, const struct group *group,
                                                            const struct line *line, size_t k, bool idle, int count,
                                                            struct turn *turn)
{
    turn->count = count;
    for (int t = 0; t < count; t++) {
        turn->pairs[t] = line_pairs(work, group, line, k + (size_t)t, idle);
    }
    for (int t = 0; t < TURNS; t++) {
        turn->b[t] = turn->pairs[t < count ? t : 0].b;
    }
}

/* A number of the pairs' records: I of C_ab along I, DIM the face measure. */
static inline __attribute__((always_inline)) wide of_record(const struct solver_upwind *work, const struct turn *turn,
                                                            int t, int I, bool narrow)
{
    real each[PLACES];
    if (t >= turn->count) {
        return (wide){0};
    }
    const struct pairs *pairs = &turn->pairs[t];
    for (int g = 0; g < PLACES; g++) {
        size_t at = pairs->record[g] * PAIR + (size_t)I;
        real number = narrow ? (real)work->narrow[at] : (real)work->pair[at];
        each[g] = pairs->idle[g] ? (real)0.0 : number;
    }
    return join_each(each);
}

/* Does ADD for each turn of the pairs of a line. */
#define FOR_TURNS(work, group, line, ADD)                                                                              \
    do {                                                                                                               \
        size_t k = 0;                                                                                                  \
        for (; k + TURNS <= (line)->shortest; k += TURNS) {                                                            \
            struct turn turn;                                                                                          \
            next_turn(work, group, line, k, false, TURNS, &turn);                                                      \
            ADD;                                                                                                       \
        }                                                                                                              \
        for (; PLACES > 1 && k + TURNS <= (line)->longest; k += TURNS) {                                               \
            struct turn turn;                                                                                          \
            next_turn(work, group, line, k, true, TURNS, &turn);                                                       \
            ADD;                                                                                                       \
        }                                                                                                              \
        if (k < (line)->longest) {                                                                                     \
            struct turn turn;                                                                                          \
            next_turn(work, group, line, k, PLACES > 1, 1, &turn);                                                     \
            ADD;                                                                                                       \
        }                                                                                                              \
    } while (0)

#endif
