/* The equation of motion as a system in z and w, by an eighth-order Runge-Kutta method of GSL, to nodes so close that a
 * polynomial of fifth degree through values, first and second derivatives of two neighbours is exact to round-off. Its
 * time scale is that of small oscillations or, where the tube is nearly closed and turns at once, what z says. */
#include "oracles/root.h"
#include "oracles/tube.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double PI = 3.14159265358979323846;
static const double SPACING = 0.01;    /* of nodes, in the time scale */
static const double TOLERANCE = 1e-13; /* relative, of a step from node to node: a guard, the steps are shorter */
enum { FIRST_ROOM = 1024, MOST_NODES = 1 << 20 };

/* ln(r/x) where R^2 = 1 + f. */
static double logarithm(const struct tube_instant *at, double f)
{
    return log1p(f * exp(-at->z)) / 2;
}

/* ln(R) - ln(r/x): for small y to the last digit, as for small x. */
static double shortfall(const struct tube_instant *at, double f)
{
    return at->y < -0.5 ? log1p(f) / 2 - logarithm(at, f) : log1p(at->y * f / (1 + f + at->y)) / 2;
}

/* 1/x^2 - 1/r^2. */
static double difference(const struct tube_instant *at, double f)
{
    double x2 = exp(at->z);
    return f / (f + x2) / x2;
}

static struct tube_instant instant(double wall, double z, double w)
{
    struct tube_instant at = {.z = z, .y = expm1(z), .w = w};
    at.acceleration = ((w * w - at.y) / 2 * difference(&at, wall) - shortfall(&at, wall)) / logarithm(&at, wall);
    return at;
}

double tube_radial_stress(const struct tube_instant *at, double f)
{
    return at->acceleration * logarithm(at, f) + (at->y - at->w * at->w) / 2 * difference(at, f) + shortfall(at, f);
}

void tube_energies(double wall, const struct tube_instant *at, double *kinetic, double *strain)
{
    *kinetic = at->w * at->w * logarithm(at, wall);
    *strain = at->y * shortfall(at, wall);
}

double tube_linear(double wall)
{
    return 4 * wall / ((1 + wall) * log1p(wall));
}

static struct tube_node node_at(double t, const struct tube_instant *at)
{
    double fall = 2 * exp(-at->z), rate = fall * at->w;
    return (struct tube_node){.t = t, .z = at->z, .rate = rate, .second = fall * at->acceleration - rate * rate};
}

static int slope(double t, const double y[2], double along[2], void *context)
{
    (void)t;
    const double *wall = context;
    struct tube_instant at = instant(*wall, y[0], y[1]);
    along[0] = 2 * exp(-at.z) * at.w;
    along[1] = at.acceleration;
    return isfinite(along[0]) && isfinite(along[1]) ? GSL_SUCCESS : GSL_EBADFUNC;
}

/* z between two nodes, and its rate. */
static double between(const struct tube_node *node, double t, double *rate)
{
    double h = node[1].t - node[0].t, s = (t - node[0].t) / h;
    double v0 = h * node[0].rate, a0 = h * h * node[0].second;
    double d = node[1].z - node[0].z - v0 - a0 / 2, v = h * node[1].rate - v0 - a0, a = h * h * node[1].second - a0;
    double c3 = 10 * d - 4 * v + a / 2, c4 = -15 * d + 7 * v - a, c5 = 6 * d - 3 * v + a / 2;
    *rate = (v0 + s * (a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / h;
    return node[0].z + s * (v0 + s * (a0 / 2 + s * (c3 + s * (c4 + s * c5))));
}

static double z_between(double t, void *context)
{
    double rate;
    return between(context, t, &rate);
}

/* When z rises through zero between two nodes; they are known to lie on either side. */
static bool rises(struct tube_node *node, double *t)
{
    if (node[0].z == 0 || node[1].z == 0) {
        *t = node[node[0].z == 0 ? 0 : 1].t;
        return true;
    }
    return root_between(z_between, node, node[0].t, node[1].t, t);
}

static bool add(struct tube_motion *motion, size_t *room, struct tube_node node, char why[ORACLE_WHY])
{
    if (motion->count == *room) {
        struct tube_node *more = *room < MOST_NODES ? realloc(motion->node, 2 * *room * sizeof *more) : NULL;
        if (more == NULL) {
            (void)snprintf(why, ORACLE_WHY, "no room for more than %zu instants of the motion of the tube", *room);
            return false;
        }
        motion->node = more;
        *room *= 2;
    }
    motion->node[motion->count++] = node;
    return true;
}

/* Node after node, until z has risen through zero twice: a period lies between the two. */
static bool march(struct tube_motion *motion, gsl_odeiv2_driver *driver, double y[2], char why[ORACLE_WHY])
{
    size_t room = FIRST_ROOM;
    double t = 0, rise[2], own = sqrt(tube_linear(motion->wall));
    for (int risen = 0; risen < 2;) {
        struct tube_instant at = instant(motion->wall, y[0], y[1]);
        struct tube_node node = node_at(t, &at);
        if (!add(motion, &room, node, why)) {
            return false;
        }
        struct tube_node *last = motion->node + (motion->count > 1 ? motion->count - 2 : 0);
        if (motion->count > 1 && last[0].z <= 0 && last[1].z > 0) {
            if (!rises(last, &rise[risen++])) {
                (void)snprintf(why, ORACLE_WHY, "no time when the tube passes its reference near t = %g", t);
                return false;
            }
        }
        double next = t + SPACING / (own + fabs(node.rate) + sqrt(fabs(node.second)));
        if (gsl_odeiv2_driver_apply(driver, &t, next, y) != GSL_SUCCESS) {
            (void)snprintf(why, ORACLE_WHY, "the equation of motion cannot be solved beyond t = %g A sqrt(rho / mu)",
                           t);
            return false;
        }
    }
    motion->period = rise[1] - rise[0];
    return true;
}

/* Where all energy is strain energy, on either side of the reference; its square root is nearly straight. */
struct turn {
    double wall, energy, sign;
};

static double above_turn(double z, void *context)
{
    const struct turn *turn = context;
    struct tube_instant at = {.z = turn->sign * z, .y = expm1(turn->sign * z)};
    double kinetic, strain;
    tube_energies(turn->wall, &at, &kinetic, &strain);
    return sqrt(fmax(0, strain)) - sqrt(turn->energy);
}

static bool turns(struct tube_motion *motion, double sign, double *z)
{
    struct turn turn = {motion->wall, motion->energy, sign};
    bool found = root_between(above_turn, &turn, 0, 2 * log(TUBE_STRETCH), z);
    *z *= sign;
    return found;
}

bool tube_move(double wall, double z, double w, struct tube_motion *motion, char why[ORACLE_WHY])
{
    struct tube_instant at = instant(wall, z, w);
    double kinetic, strain, y[2] = {z, w};
    tube_energies(wall, &at, &kinetic, &strain);
    *motion = (struct tube_motion){.wall = wall, .energy = kinetic + strain};
    if (motion->energy == 0) {
        motion->period = 2 * PI / sqrt(tube_linear(wall));
        return true;
    }
    if (!turns(motion, -1, &motion->lowest) || !turns(motion, 1, &motion->highest)) {
        (void)snprintf(why, ORACLE_WHY,
                       "stretch = %.15g and the velocity take the inner radius beyond 1/%d or %d times its reference, "
                       "where this oracle ends; choose a velocity nearer to 0, and a stretch nearer to 1",
                       exp(z / 2), TUBE_STRETCH, TUBE_STRETCH);
        return false;
    }
    gsl_odeiv2_system system = {slope, NULL, 2, &motion->wall};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_standard_new(&system, gsl_odeiv2_step_rk8pd, SPACING, 0, TOLERANCE, 1, 1);
    motion->node = malloc(FIRST_ROOM * sizeof *motion->node);
    bool moved = driver != NULL && motion->node != NULL;
    if (!moved) {
        (void)snprintf(why, ORACLE_WHY, "no memory for the motion of the tube");
    }
    moved = moved && march(motion, driver, y, why);
    if (driver != NULL) {
        gsl_odeiv2_driver_free(driver);
    }
    if (!moved) {
        tube_free(motion);
    }
    return moved;
}

void tube_free(struct tube_motion *motion)
{
    free(motion->node);
    motion->node = NULL;
    motion->count = 0;
}

struct tube_instant tube_at(const struct tube_motion *motion, double t)
{
    if (motion->count == 0 || !isfinite(t)) {
        return instant(motion->wall, isfinite(t) ? 0 : NAN, 0);
    }
    double rate, since = t - floor(t / motion->period) * motion->period;
    size_t lower = 0, upper = motion->count - 1;
    while (upper - lower > 1) {
        size_t middle = lower + (upper - lower) / 2;
        *(motion->node[middle].t <= since ? &lower : &upper) = middle;
    }
    double z = between(motion->node + lower, since, &rate);
    return instant(motion->wall, z, rate * exp(z) / 2);
}
