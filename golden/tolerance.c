/* Bounds from round-off growth.
 *
 * Two builds of one program differ in which multiplications are fused and how vectors are summed: each operation may
 * round otherwise, by the unit round-off u = 2^-53. What two runs may differ by follows.
 *
 * F is of the order of one and is stored anew in each of up to STAGES stages of each step: each time it picks up an
 * absolute error of u. The increment itself, a sum over up to PAIRS neighbours, adds u sqrt(PAIRS) of dev, where
 * dev = max |F - I| is the strain. Rounding errors are independent and have no preferred sign, so N steps of them grow
 * like a random walk:
 *
 *     noise in F  =  u sqrt(STAGES (N + 1)) (1 + sqrt(PAIRS) dev),
 *
 * times SPREAD standard deviations, because the largest of many values is compared. The schemes are stable: their
 * energy does not grow, so noise in F stays noise of the same energy in momentum, velocity, displacement and stress.
 * Relative to the magnitude of each of these, which is proportional to dev, it is
 *
 *     r  =  SPREAD u sqrt(STAGES (N + 1)) (1 / dev + sqrt(PAIRS)).
 *
 * The bound of a field is r times its own scale. F, H and J are measured by dev, not by their magnitude of one, and get
 * their last bit on top. Of a scheme that keeps the density in place of F, dev is max |J - 1|.
 *
 * r is never more than CAP, half of 1e-10: whatever the run, a change in the tenth digit of the scale is caught. A
 * scene whose strain is so small or whose run is so long that round-off alone would pass CAP is no good golden scene:
 * it would fail from one machine to the next, and never be blind.
 *
 * Measured on the swinging cube at n = 8, with fused multiply-adds against none: linear elasticity differs by at
 * most 0.16 of these bounds. The neo-Hookean model, whose stress is a difference of terms as large as the moduli,
 * differs by up to 4 times these bounds at the same strain of 1e-3: its records hold for one kind of machine only.
 *
 * Pair vectors are taken to be the same. Those of `closed` are solved for, until 2e-14 of a face is left
 * (solver/stencil_closed.c), and two builds leave other remainders: they differ by 1e-14 to 1e-12 of a face. F starts
 * from displacements, so that this acts on its increments alone, by that part of dev, which is less than the bounds
 * while dev is small. At strains of 1e-3 it was at most 0.35 of them after two to four steps, in 480 clouds moved by 2
 * to 45 %, and 0.15 after twelve and more, in the 240 with least-squares slopes. It is no part of r, because a record
 * does not say how its pair vectors came about, and two kinds of `closed` are no golden scenes for it: those of strains
 * of 0.1 (29 of 480 clouds were out of bounds after few steps, by up to 3.7 times, and one of 240 after more), and
 * those whose particles are hardly moved, where the solution is hardly held: at perturb = 1e-4 pair vectors differed by
 * 2e-9 and results by 58 times the bounds. */
#include "golden/tolerance.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define UNIT   (DBL_EPSILON / 2.0)
#define STAGES 4.0
#define PAIRS  256.0
#define SPREAD 8.0
#define CAP    5e-11

static double max_norm(const double *value, size_t count)
{
    double most = 0.0;
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(value[i]));
    }
    return most;
}

static double field_norm(const struct solver_record *record, const char *name)
{
    const struct solver_record_field *field = solver_record_find(record, name);
    return field == NULL ? 0.0 : max_norm(field->value, record->count * (size_t)field->width);
}

/* Largest |F - I| over particles and components, or |J - 1| of a scheme that has no F. */
static double deviation(const struct solver_record *record)
{
    const struct solver_record_field *F = solver_record_find(record, "F");
    const struct solver_record_field *field = F != NULL ? F : solver_record_find(record, "J");
    double most = 0.0;
    for (size_t i = 0; field != NULL && i < (size_t)field->width * record->count; i++) {
        most = fmax(most, fabs(field->value[i] - (i % (size_t)field->width % 4 == 0 ? 1.0 : 0.0)));
    }
    return most;
}

static double relative(const struct solver_record *record, double dev)
{
    const double walk = SPREAD * UNIT * sqrt(STAGES * ((double)record->step + 1.0));
    return fmin(walk * (1.0 / fmax(dev, DBL_MIN) + sqrt(PAIRS)), CAP);
}

static bool is(const char *name, const char *other)
{
    return strcmp(name, other) == 0;
}

double golden_field_bound(const struct solver_record *stored, const struct solver_record_field *field)
{
    const double dev = deviation(stored), r = relative(stored, dev);
    if (is(field->name, "tags")) {
        return 0.0;
    }
    if (is(field->name, "volume")) { /* not evolved: what one sum over the pairs may lose */
        return PAIRS * UNIT * field_norm(stored, "volume");
    }
    if (is(field->name, "F") || is(field->name, "H") || is(field->name, "J")) {
        return r * dev + 2.0 * UNIT;
    }
    if (is(field->name, "pressure") || is(field->name, "von_mises")) { /* parts of a stress that may cancel in them */
        return r * fmax(field_norm(stored, field->name), fmax(field_norm(stored, "P"), field_norm(stored, "sigma")));
    }
    return r * field_norm(stored, field->name);
}

/* The largest entry of all columns whose names start so. */
static double columns_norm(const struct solver_record *record, const char *start)
{
    double most = 0.0;
    for (size_t c = 0; c < record->history_columns; c++) {
        if (strncmp(record->history_name[c], start, strlen(start)) == 0) {
            for (size_t row = 0; row < record->history_count; row++) {
                most = fmax(most, fabs(record->history[row * record->history_columns + c]));
            }
        }
    }
    return most;
}

/* Sum of V |p|: the momentum there is before opposite ones cancel. */
static double momentum_norm(const struct solver_record *record)
{
    const struct solver_record_field *p = solver_record_find(record, "momentum");
    const struct solver_record_field *V = solver_record_find(record, "volume");
    double sum = 0.0;
    for (size_t a = 0; p != NULL && V != NULL && p->width == 3 && V->width == 1 && a < record->count; a++) {
        const double *at = p->value + 3 * a;
        sum += V->value[a] * sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
    }
    return sum;
}

static double energy_norm(const struct solver_record *record)
{
    return fmax(fmax(columns_norm(record, "kinetic_energy"), columns_norm(record, "strain_energy")),
                fmax(fmax(columns_norm(record, "total_energy"), columns_norm(record, "external_work")),
                     columns_norm(record, "plastic_work")));
}

static bool starts(const char *name, const char *start)
{
    return strncmp(name, start, strlen(start)) == 0;
}

/* Whether the last characters of `name`, as many as `end` has and `skip` more, start with `end`. */
static bool ends(const char *name, const char *end, size_t skip)
{
    const size_t length = strlen(name), last = strlen(end) + skip;
    return length >= last && starts(name + length - last, end);
}

/* Columns that are parts of one quantity share its scale: a component, or a balance, that cancels to nothing is known
 * only as well as what cancelled. */
static double column_scale(const struct solver_record *record, size_t column)
{
    const char *name = record->history_name[column];
    if (starts(name, "linear_momentum") || starts(name, "wall_impulse")) {
        return fmax(fmax(columns_norm(record, "linear_momentum"), columns_norm(record, "wall_impulse")),
                    momentum_norm(record));
    }
    if (starts(name, "angular_momentum")) {
        const double reach = max_norm(record->X, 3 * record->count);
        return fmax(columns_norm(record, "angular_momentum"), reach * momentum_norm(record));
    }
    if (is(name, "external_work") || is(name, "plastic_work") || ends(name, "_energy", 0)) {
        return energy_norm(record);
    }
    if (starts(name, "probe_") && ends(name, "_u_", 1)) {
        return fmax(columns_norm(record, name), field_norm(record, "displacement"));
    }
    if (starts(name, "probe_") && ends(name, "_v_", 1)) {
        return fmax(columns_norm(record, name), field_norm(record, "velocity"));
    }
    return columns_norm(record, name);
}

double golden_column_bound(const struct solver_record *stored, size_t column)
{
    return relative(stored, deviation(stored)) * column_scale(stored, column);
}
