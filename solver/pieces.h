/* Loops over particles in pieces of work. A piece's result does not depend on who does it, and pieces are combined in
 * order, so results are the same for any number of threads. */
#ifndef SOLVER_PIECES_H
#define SOLVER_PIECES_H

#include <stddef.h>

enum { SOLVER_PIECE = 256 }; /* particles per piece */

static inline size_t solver_pieces(size_t count)
{
    return (count + SOLVER_PIECE - 1) / SOLVER_PIECE;
}

/* The particles [begin, end) of a piece. */
struct solver_piece {
    size_t begin, end;
};

static inline struct solver_piece solver_piece_at(size_t piece, size_t count)
{
    size_t begin = piece * SOLVER_PIECE;
    return (struct solver_piece){begin, begin + SOLVER_PIECE < count ? begin + SOLVER_PIECE : count};
}

#endif
