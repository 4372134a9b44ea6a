/* Affine motions F = F0 + t F' of large stretch, shear and turn, made to fit what the faces of a block can bear. */
#ifndef TESTS_AFFINE_MOTIONS_H
#define TESTS_AFFINE_MOTIONS_H

#include "solver/small.h"
#include "tests/unit/motions.h"

#include <gsl/gsl_eigen.h>

/* How a body moves while it is looked at. */
enum affine_pace {
    AFFINE_HELD,
    AFFINE_DRIFTING,   /* F' = 0 */
    AFFINE_SHEARING,   /* F' = a (x) e1: the plane X = 0 stands still */
    AFFINE_STRETCHING, /* F diagonal: no normal velocity on the planes X = 0, Y = 0, Z = 0 */
    AFFINE_GENERAL     /* F = R U(t), U symmetric from one random stretch to another, R a rotation */
};

struct affine_case {
    const char *name, *faces; /* letters of motion_scene, the first two for each dimension */
    enum affine_pace pace;
};

/* Every kind of face, alone and beside others. */
static const struct affine_case affine_cases[] = {
    {"held by tractions", "TTTTTT", AFFINE_HELD},
    {"drifting under tractions", "TTTTTT", AFFINE_DRIFTING},
    {"stretched, sheared and turned by tractions", "TTTTTT", AFFINE_GENERAL},
    {"led by all its faces", "MMMMMM", AFFINE_GENERAL},
    {"clamped at one face, drawn by the others", "CMTMTT", AFFINE_SHEARING},
    {"drawn by rollers beside tractions", "RRTRTM", AFFINE_GENERAL},
    {"stretched between planes of symmetry", "STSMST", AFFINE_STRETCHING},
    {"free across, held by a clamp, tractions and a face at rest", "FFTCMT", AFFINE_HELD},
    {"one face free beside a traction, drifting", "FTTTTT", AFFINE_DRIFTING},
    {"drifting across skew-symmetric faces", "KKTTTT", AFFINE_DRIFTING},
    {"drifting between planes of symmetry", "SSTTTT", AFFINE_DRIFTING},
};
enum { AFFINE_CASES = sizeof affine_cases / sizeof *affine_cases };

static inline bool affine_has(const struct affine_case *of, size_t dim, const char *letters)
{
    return strcspn(of->faces, letters) < 2 * dim;
}

/* Q diag(stretches) Q^T, stretches from 1/2 to 2. */
static inline void affine_stretch(size_t dim, double *U)
{
    double Q[9], scaled[9], transposed[9];
    random_rotation(dim, Q);
    for (size_t j = 0; j < dim; j++) {
        double stretch = exp2(uniform(-1.0, 1.0));
        for (size_t i = 0; i < dim; i++) {
            scaled[i * dim + j] = stretch * Q[i * dim + j];
            transposed[j * dim + i] = Q[i * dim + j];
        }
    }
    multiply(dim, scaled, transposed, U);
}

/* Which entries of F a body's faces leave open, those where they allow no stress: all of a column where faces across
 * that axis are free, the normal one where they are skew-symmetric, the others where they are symmetric. */
static inline size_t affine_open(const struct affine_case *of, size_t dim, size_t open[9])
{
    size_t count = 0;
    for (size_t k = 0; k < dim * dim && of->pace != AFFINE_STRETCHING; k++) {
        bool normal = k / dim == k % dim;
        for (size_t face = 2 * (k % dim); face < 2 * (k % dim) + 2; face++) {
            char kind = of->faces[face];
            if (kind == 'F' || (kind == 'K' && normal) || (kind == 'S' && !normal)) {
                open[count++] = k;
                break;
            }
        }
    }
    return count;
}

/* Solves P_k(F) = 0 for the open entries k by Newton's method, damped so that no step turns the body inside out. False
 * if it finds no solution: where a material softens as it is stretched, it may run away. */
static inline bool affine_release(struct motion *motion, const size_t *open, size_t count)
{
    size_t dim = motion->dim;
    double P[9], A[81], before[9], *F = motion->start;
    double modulus = motion->constants.rho * motion->constants.cp * motion->constants.cp, size = 1.0;
    CU_ASSERT_FATAL(count <= 4);
    for (int round = 0; round < 100 && size > 1e-15; round++) {
        double matrix[4][4], step[4];
        motion_stress(motion, 0.0, P);
        motion->material->tangent(&motion->constants, F, A);
        size = 0.0;
        for (size_t i = 0; i < count; i++) {
            step[i] = -P[open[i]] / modulus;
            size = fmax(size, fabs(step[i]));
            for (size_t j = 0; j < count; j++) {
                matrix[i][j] = A[open[i] * dim * dim + open[j]] / modulus;
            }
        }
        if (!solver_small_solve(count, matrix, step)) {
            return false;
        }
        memcpy(before, F, sizeof before);
        for (double damp = 0.2 / fmax(0.2, largest_entry(count, step)); damp > 1e-6; damp *= 0.5) {
            for (size_t i = 0; i < count; i++) {
                F[open[i]] = before[open[i]] + damp * step[i];
            }
            if (motion->material->linear || determinant_of(dim, F) > 0.2 * determinant_of(dim, before)) {
                break;
            }
        }
    }
    return size < 1e-13 && largest_entry(dim * dim, F) < 4.0;
}

/* Smallest eigenvalue of the tangent at time t, over rho cp^2: below zero where loads press the body, which may then
 * turn, wrinkle or buckle. */
static inline double affine_firmness(const struct motion *motion, double t)
{
    double F[9], A[81], modulus = motion->constants.rho * motion->constants.cp * motion->constants.cp;
    size_t entries = motion->dim * motion->dim;
    motion->gradient(motion, t, 0, F);
    motion->material->tangent(&motion->constants, F, A);
    gsl_matrix_view matrix = gsl_matrix_view_array(A, entries, entries);
    gsl_vector *values = gsl_vector_alloc(entries);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(entries);
    CU_ASSERT_FATAL(values != NULL && work != NULL);
    gsl_eigen_symm(&matrix.matrix, values, work);
    double least = gsl_vector_min(values) / modulus;
    gsl_eigen_symm_free(work);
    gsl_vector_free(values);
    return least;
}

/* A motion that fits the case and lasts `duration` [s]; material and constants are set. False if none was found. */
static inline bool affine_draw(const struct affine_case *of, double duration, struct motion *motion)
{
    size_t dim = motion->dim, open[9], count = affine_open(of, dim, open);
    double from[9], to[9], R[9], *F = motion->start;
    motion->gradient = affine_gradient;
    memset(motion->rate, 0, sizeof motion->rate);
    memset(motion->drift, 0, sizeof motion->drift);
    random_rotation(dim, R);
    affine_stretch(dim, from);
    affine_stretch(dim, to);
    if (of->pace == AFFINE_STRETCHING) {
        for (size_t k = 0; k < dim * dim; k++) {
            from[k] = k / dim == k % dim ? exp2(uniform(-1.0, 1.0)) : 0.0;
            to[k] = k / dim == k % dim ? exp2(uniform(-1.0, 1.0)) : 0.0;
        }
    }
    if (of->pace == AFFINE_STRETCHING || count > 0) {
        unit_tensor(dim, R);
    }
    multiply(dim, R, from, F);
    multiply(dim, R, to, motion->rate); /* F at the end */
    double longer = uniform(-0.3, 0.3); /* det F stays positive on the way */
    for (size_t k = 0; k < dim * dim; k++) {
        double way = motion->rate[k] - F[k];
        if (of->pace == AFFINE_SHEARING) {
            way = k % dim == 0 ? longer * F[k] + (dim > 1 ? 0.5 * F[k + 1] : 0.0) : 0.0;
        }
        bool moves = of->pace != AFFINE_HELD && of->pace != AFFINE_DRIFTING;
        motion->rate[k] = moves ? way / duration : 0.0;
    }
    for (size_t i = 0; i < dim && of->pace == AFFINE_DRIFTING; i++) {
        bool across = affine_has(of, 1, "K"), along = affine_has(of, 1, "S"); /* of the faces across X */
        motion->drift[i] = (across && i > 0) || (along && i == 0) ? 0.0 : uniform(0.3, 0.9) * motion->constants.cp;
    }
    return count == 0 || affine_release(motion, open, count);
}

/* The same, and what loads hold is held firmly: where they press it so hard that every unit of round-off may grow fast,
 * the motion is drawn again. Faces that are led keep a body in shape however hard it is pressed. */
static inline void affine_make(const struct affine_case *of, double duration, struct motion *motion)
{
    double firmness = -INFINITY;
    for (int round = 0; round < 10000 && firmness < -0.05; round++) {
        if (!affine_draw(of, duration, motion)) {
            continue;
        }
        firmness = affine_has(of, motion->dim, "TFR")
                       ? fmin(affine_firmness(motion, 0.0), affine_firmness(motion, duration))
                       : 0.0;
    }
    CU_ASSERT_FATAL(firmness >= -0.05);
}

#endif
