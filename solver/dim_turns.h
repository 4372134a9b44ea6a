/* Pairs in turn: what is one number of a pair and takes long, a division or a root, is done for two pairs at once, in
 * lanes of their particle that take turns; on a line a vector has no two lanes. */
#ifndef SOLVER_DIM_TURNS_H
#define SOLVER_DIM_TURNS_H

#include "solver/dim_group.h"

enum { TURNS = DIM > 1 ? 2 : 1 };

#if DIM == 1
#define TAKE_TURNS(a, list) ((a)[0])
#else
#define TAKE_TURNS(a, list) __builtin_shufflevector((a)[0], (a)[1], EACH_LANE(list))
#endif

/* Numbers of pairs, which are in every lane. */
static inline wide in_turn(const wide of[TURNS])
{
    return TAKE_TURNS(of, IN_TURN);
}

/* Component I, a constant, of vectors of pairs. */
static inline wide components_in_turn(const wide of[TURNS], int I)
{
#if DIM == 1
    (void)I;
    return of[0];
#else
    return I == 0 ? TAKE_TURNS(of, IN_TURN_0) : I == 1 ? TAKE_TURNS(of, IN_TURN_1) : TAKE_TURNS(of, IN_TURN_2);
#endif
}

/* The number of pair k, a constant, in every lane. */
static inline wide of_turn(wide in_turn, int k)
{
#if DIM == 1
    (void)k;
    return in_turn;
#else
    return k == 0 ? __builtin_shufflevector(in_turn, in_turn, EACH_LANE(EVEN))
                  : __builtin_shufflevector(in_turn, in_turn, EACH_LANE(ODD));
#endif
}

/* The sum over turns, in every lane. */
static inline wide over_turns(wide in_turn)
{
#if DIM == 1
    return in_turn;
#else
    return in_turn + __builtin_shufflevector(in_turn, in_turn, EACH_LANE(OTHER_OF_TWO));
#endif
}

/* a . b of pairs. */
static inline wide dots_in_turn(const wide a[TURNS], const wide b[TURNS])
{
#if DIM == 1
    return a[0] * b[0];
#else
    wide product[2] = {a[0] * b[0], a[1] * b[1]};
    wide dots = TAKE_TURNS(product, EVEN_OF_TWO) + TAKE_TURNS(product, ODD_OF_TWO);
#if DIM == 3
    dots += __builtin_shufflevector(dots, dots, EACH_LANE(OTHER_HALF));
#endif
    return dots;
#endif
}

#endif
