#include "verify/spoiled_drive.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Formulas of the body: edge 1, faces 0 to 5 (X0, X1, Y0, Y1, ...). */
static int face_of(enum solver_formula formula)
{
    return formula >= SOLVER_FACE_X0 ? (int)(formula - SOLVER_FACE_X0) % SOLVER_FACES : -1;
}

static void ask(const struct verify_driven *right, enum solver_formula formula, const double X[3], double t,
                double value[3])
{
    memset(value, 0, 3 * sizeof *value);
    right->drive(right->context, formula, X, t, value);
}

static void scale(double value[3], double factor)
{
    for (int i = 0; i < 3; i++) {
        value[i] *= factor;
    }
}

/* A spoiler that changes the body force, or what faces prescribe, in one statement. */
#define SPOIL_FORCE(name, statement)                                                                                   \
    static void name(const struct verify_driven *right, enum solver_formula formula, const double X[3], double t,      \
                     double value[3])                                                                                  \
    {                                                                                                                  \
        ask(right, formula, X, t, value);                                                                              \
        if (formula == SOLVER_BODY_FORCE) {                                                                            \
            statement;                                                                                                 \
        }                                                                                                              \
    }
#define SPOIL_FACE(name, condition, statement)                                                                         \
    static void name(const struct verify_driven *right, enum solver_formula formula, const double X[3], double t,      \
                     double value[3])                                                                                  \
    {                                                                                                                  \
        int face = face_of(formula);                                                                                   \
        ask(right, formula, X, t, value);                                                                              \
        if (face >= 0 && (condition)) {                                                                                \
            statement;                                                                                                 \
        }                                                                                                              \
    }

static double edge(const struct verify_driven *right)
{
    return right->scene->upper[0] - right->scene->lower[0];
}

static bool is(int face, int which)
{
    return face == which;
}

/* The formula at another place or time. */
static void elsewhere(const struct verify_driven *right, enum solver_formula formula, const double X[3], double shift,
                      double t, double value[3])
{
    const double there[3] = {X[0] + shift * edge(right), X[1], X[2]};
    ask(right, formula, there, t, value);
}

static void swap(double value[3])
{
    double first = value[0];
    value[0] = value[1];
    value[1] = first;
}

/* On the Y faces of a corner, or within a spacing of it. */
static bool at_corner(const struct verify_driven *right, const double X[3])
{
    double spacing = edge(right) / right->scene->n;
    return X[0] < right->scene->lower[0] + 1.5 * spacing && X[1] < right->scene->lower[1] + 1.5 * spacing;
}

SPOIL_FORCE(no_force, scale(value, 0))
SPOIL_FORCE(opposite_force, scale(value, -1))
SPOIL_FORCE(larger_force, scale(value, 1.01))
SPOIL_FORCE(no_x, value[0] = 0)
SPOIL_FORCE(no_y, value[1] = 0)
SPOIL_FORCE(opposite_x, value[0] = -value[0])
SPOIL_FORCE(opposite_y, value[1] = -value[1])
SPOIL_FORCE(swapped_force, swap(value))
SPOIL_FORCE(late_force, ask(right, formula, X, t - right->step, value))
SPOIL_FORCE(early_force, ask(right, formula, X, t + right->step, value))
SPOIL_FORCE(frozen_force, ask(right, formula, X, 0, value))
SPOIL_FORCE(fast_force, ask(right, formula, X, 1.01 * t, value))
SPOIL_FORCE(shifted_force, elsewhere(right, formula, X, 0.5 / right->scene->n, t, value))
SPOIL_FORCE(mirrored_force, elsewhere(right, formula, X, 1 - 2 * X[0] / edge(right), t, value))
SPOIL_FORCE(force_off_faces, if (X[0] == right->scene->lower[0]) scale(value, 0))
SPOIL_FORCE(force_offset, value[0] += 0.02 * hypot(value[0], value[1]))

SPOIL_FACE(no_traction, true, scale(value, 0))
SPOIL_FACE(opposite_traction, true, scale(value, -1))
SPOIL_FACE(larger_traction, true, scale(value, 1.01))
SPOIL_FACE(inner_normal, face % 2 == 0, scale(value, -1))
SPOIL_FACE(no_traction_x1, is(face, 1), scale(value, 0))
SPOIL_FACE(no_traction_y0, is(face, 2), scale(value, 0))
SPOIL_FACE(no_shear, true, value[1 - face / 2] = 0)
SPOIL_FACE(no_normal, true, value[face / 2] = 0)
SPOIL_FACE(swapped_traction, true, swap(value))
SPOIL_FACE(other_face, true, ask(right, (enum solver_formula)(SOLVER_FACE_X0 + (face ^ 1)), X, t, value))
SPOIL_FACE(late_traction, true, ask(right, formula, X, t - right->step, value))
SPOIL_FACE(frozen_traction, true, ask(right, formula, X, 0, value))
SPOIL_FACE(no_traction_at_corner, at_corner(right, X), scale(value, 0))
SPOIL_FACE(shifted_traction, face / 2 == 1, elsewhere(right, formula, X, 0.5 / right->scene->n, t, value))

SPOIL_FACE(held, true, scale(value, 0))
SPOIL_FACE(opposite_velocity, true, scale(value, -1))
SPOIL_FACE(larger_velocity, true, scale(value, 1.01))
SPOIL_FACE(held_x0, is(face, 0), scale(value, 0))
SPOIL_FACE(held_y1, is(face, 3), scale(value, 0))
SPOIL_FACE(slid, true, value[1 - face / 2] = 0)
SPOIL_FACE(swapped_velocity, true, swap(value))
SPOIL_FACE(late_velocity, true, ask(right, formula, X, t - right->step, value))
SPOIL_FACE(shifted_velocity, face / 2 == 1, elsewhere(right, formula, X, 0.5 / right->scene->n, t, value))
SPOIL_FACE(held_at_corner, at_corner(right, X), scale(value, 0))

SPOIL_FACE(roller_held, formula <= SOLVER_FACE_Z1, scale(value, 0))
SPOIL_FACE(roller_late, formula <= SOLVER_FACE_Z1, ask(right, formula, X, t - right->step, value))
SPOIL_FACE(roller_free, formula > SOLVER_FACE_Z1, scale(value, 0))
SPOIL_FACE(roller_opposite, formula > SOLVER_FACE_Z1, scale(value, -1))

static const struct verify_spoiled_drive drives[] = {
    {"no body force", "motion", false, no_force},
    {"body force of the opposite sign", "motion", false, opposite_force},
    {"body force 1 % too large", "motion", false, larger_force},
    {"body force without its x component", "motion", false, no_x},
    {"body force without its y component", "traction", false, no_y},
    {"x component of the opposite sign", "traction", false, opposite_x},
    {"y component of the opposite sign", "motion", false, opposite_y},
    {"components of the body force swapped", "motion", false, swapped_force},
    {"body force a step late", "traction", true, late_force},
    {"body force a step early", "motion", true, early_force},
    {"body force as at the start, always", "motion", false, frozen_force},
    {"body force on a clock that runs 1 % fast", "traction", false, fast_force},
    {"body force from half a spacing beside", "traction", true, shifted_force},
    {"body force mirrored", "motion", false, mirrored_force},
    {"no body force on particles of face X0", "traction", true, force_off_faces},
    {"body force 2 % off along x", "motion", false, force_offset},
    {"no traction", "traction", false, no_traction},
    {"traction of the opposite sign", "traction", false, opposite_traction},
    {"traction 1 % too large", "traction", false, larger_traction},
    {"inner normal on X0 and Y0", "traction", false, inner_normal},
    {"no traction on X1", "traction", false, no_traction_x1},
    {"no traction on Y0", "traction", false, no_traction_y0},
    {"no shear traction", "traction", false, no_shear},
    {"no normal traction", "traction", false, no_normal},
    {"components of the traction swapped", "traction", false, swapped_traction},
    {"traction of the face across", "traction", false, other_face},
    {"traction a step late", "traction", true, late_traction},
    {"traction as at the start, always", "traction", false, frozen_traction},
    {"no traction within a spacing of a corner", "traction", true, no_traction_at_corner},
    {"traction on Y0, Y1 from half a spacing beside", "traction", true, shifted_traction},
    {"moved faces held", "motion", false, held},
    {"velocity of the opposite sign", "motion", false, opposite_velocity},
    {"velocity 1 % too large", "motion", false, larger_velocity},
    {"X0 held", "motion", false, held_x0},
    {"Y1 held", "motion", false, held_y1},
    {"no velocity along faces", "motion", false, slid},
    {"components of the velocity swapped", "motion", false, swapped_velocity},
    {"velocity a step late", "motion", true, late_velocity},
    {"velocity on Y0, Y1 from half a spacing beside", "motion", true, shifted_velocity},
    {"a corner held", "motion", true, held_at_corner},
    {"rollers held", "roller", false, roller_held},
    {"rollers a step late", "roller", true, roller_late},
    {"no traction along rollers", "roller", false, roller_free},
    {"traction along rollers of the opposite sign", "roller", false, roller_opposite},
    {.what = NULL},
};

const struct verify_spoiled_drive *verify_spoiled_drives(void)
{
    return drives;
}
