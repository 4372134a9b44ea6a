/* The factor of a closed stencil's equation (closure.h): M + shift = U^T U, U upper, for clouds on which that costs
 * less than iterations over spline spaces do: in 1D and 2D, and small ones in 3D.
 *
 * Particles are eliminated in the order of a nested dissection by place: a set is halved along its longest side, and
 * particles of one half that are neighbours of the other come last. What is halved no more is a leaf. A node of this
 * tree holds its own particles, and its border: those that come later and that its elimination couples. Nodes are in
 * postorder, and so are `places`, the particles' places in the order of elimination.
 *
 * A node's rows of U are [own][columns] with own = width * particles, width = dim + 1: columns of its own, padded to
 * whole registers, then its border's. What its elimination leaves on the border, [border][border], is added to its
 * parent's rows (multifrontal elimination: I. Duff, J. Reid, ACM TOMS 9, 1983, 302).
 *
 * It is not CHOLMOD's, which takes about twice as long in 2D and whose sums depend on the BLAS at hand and its threads:
 * the same cloud would have other bits. */
#ifndef SOLVER_CLOSURE_FACTOR_H
#define SOLVER_CLOSURE_FACTOR_H

#include "solver/error.h"
#include "solver/path.h"

#include <stddef.h>
#include <stdint.h>

struct solver_closure;

enum { SOLVER_FRONT_PAD = 8 }; /* columns are a multiple of this */

struct solver_closure_node {
    size_t begin, end;           /* places of its own particles */
    size_t first;                /* the first node of its subtree, whose last is itself */
    size_t border, border_count; /* where its border begins in `border` */
    size_t rows;                 /* where its rows of U begin */
    size_t parent;               /* SIZE_MAX at the root */
    int depth;
};

struct solver_closure_factor {
    size_t width;
    size_t node_count;
    struct solver_closure_node *node;
    uint32_t *particle; /* [count] at each place */
    uint32_t *place;    /* [count] of each particle */
    uint32_t *border;   /* places, ascending for each node */
    size_t border_total;
    double operations; /* multiply-adds of the elimination */
    size_t size;       /* numbers in U */
    double *U;         /* its diagonal holds reciprocals */
    double **left;     /* [node_count] what each has left on its border; NULL but between it and its parent */
    double *x;         /* [count][width][lanes] by places */
    double *carried;   /* [border_total][width][lanes] what solutions hand to borders */
};

static inline size_t solver_front_padded(size_t columns)
{
    return (columns + SOLVER_FRONT_PAD - 1) / SOLVER_FRONT_PAD * SOLVER_FRONT_PAD;
}

/* Of a node: its own columns, where its border's begin, and the length of a row of U and of what it leaves. */
struct solver_front {
    size_t own, start, border, length, left_length;
};

static inline struct solver_front solver_front_of(const struct solver_closure_factor *of,
                                                  const struct solver_closure_node *node)
{
    struct solver_front front = {.own = (node->end - node->begin) * of->width,
                                 .border = node->border_count * of->width};
    front.start = solver_front_padded(front.own);
    front.left_length = solver_front_padded(front.border);
    front.length = front.start + front.left_length;
    return front;
}

/* Dense loops, compiled for each path. */
struct solver_front_loops {
    /* Adds to a node's rows what M and `shift` times its diagonal have there. */
    void (*assemble)(const struct solver_closure *of, size_t node, double shift, double *rows);
    /* Rows [from, to) of U from what is left of them, all columns from `from` on. */
    void (*eliminate)(double *rows, size_t length, size_t from, size_t to);
    /* Row i of `out` -= sum over rows k in [from, to) of U_ki U_kj for j >= i, i in [begin, end), where out's column 0
     * is U's column `start`. */
    void (*subtract)(const double *rows, size_t length, size_t from, size_t to, size_t start, double *out,
                     size_t out_length, size_t begin, size_t end);
    /* x = U^-T x of its own particles, what that takes from its border; and x = U^-1 x, its border's x known. */
    void (*forward)(const struct solver_closure_factor *of, size_t node);
    void (*backward)(const struct solver_closure_factor *of, size_t node);
};
SOLVER_DECLARE_LOOPS(struct solver_front_loops, solver_front);

/* The tree of a cloud, from which its costs are known. */
bool solver_closure_tree(struct solver_closure *of, struct solver_error *error);
/* The factor, where it takes so many multiply-adds for a particle at most, and no more memory than there may be: *made
 * says whether. Weights are filled in before. */
bool solver_closure_factor_make(struct solver_closure *of, double most, bool *made, struct solver_error *error);
/* z = (M + shift)^-1 r. */
void solver_closure_substitute(struct solver_closure *of, const double *r, double *z);
void solver_closure_factor_free(struct solver_closure_factor *of);

#endif
