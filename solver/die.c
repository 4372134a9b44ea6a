#include "solver/die.h"

#include "solver/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double dot(const double a[2], const double b[2])
{
    return a[0] * b[0] + a[1] * b[1];
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Unit vector from a to b; returns the distance. */
static double direction(const double a[2], const double b[2], double unit[2])
{
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    unit[0] = (b[0] - a[0]) / length;
    unit[1] = (b[1] - a[1]) / length;
    return length;
}

/* --- soundness --- */

/* What a fillet at point i takes of the straight pieces on both sides: r tan(turn / 2) [m]. */
static double taken(const struct solver_die_wall *wall, size_t i)
{
    double in[2];
    double out[2];
    if (i == 0 || i + 1 >= wall->count) {
        return 0.0;
    }
    (void)direction(wall->point[i - 1], wall->point[i], in);
    (void)direction(wall->point[i], wall->point[i + 1], out);
    return wall->fillet[i] * tan(0.5 * fabs(atan2(cross(in, out), dot(in, out))));
}

/* Whether segments ab and cd have a point in common. */
static bool meet(const double a[2], const double b[2], const double c[2], const double d[2])
{
    double ab[2] = {b[0] - a[0], b[1] - a[1]};
    double cd[2] = {d[0] - c[0], d[1] - c[1]};
    double ac[2] = {c[0] - a[0], c[1] - a[1]};
    double ad[2] = {d[0] - a[0], d[1] - a[1]};
    double ca[2] = {a[0] - c[0], a[1] - c[1]};
    double cb[2] = {b[0] - c[0], b[1] - c[1]};
    double of_c = cross(ab, ac);
    double of_d = cross(ab, ad);
    double of_a = cross(cd, ca);
    double of_b = cross(cd, cb);
    if (of_c == 0.0 && of_d == 0.0) { /* on one line: whether they overlap */
        double square = dot(ab, ab);
        return fmin(dot(ab, ac), dot(ab, ad)) <= square && fmax(dot(ab, ac), dot(ab, ad)) >= 0.0;
    }
    return of_c * of_d <= 0.0 && of_a * of_b <= 0.0;
}

bool solver_die_cross(const struct solver_die_wall *a, const struct solver_die_wall *b)
{
    for (size_t i = 0; i + 1 < a->count; i++) {
        for (size_t j = a == b ? i + 2 : 0; j + 1 < b->count; j++) {
            if (meet(a->point[i], a->point[i + 1], b->point[j], b->point[j + 1])) {
                return true;
            }
        }
    }
    return false;
}

bool solver_die_is_wrong(const struct solver_die_wall *wall, char *why, size_t size)
{
    for (size_t i = 0; i + 1 < wall->count; i++) {
        double along[2];
        double length = direction(wall->point[i], wall->point[i + 1], along);
        if (!(length > 0.0)) {
            (void)snprintf(why, size, "points %zu and %zu are the same", i + 1, i + 2);
            return true;
        }
        double next[2] = {along[0], along[1]};
        if (i + 2 < wall->count) {
            (void)direction(wall->point[i + 1], wall->point[i + 2], next);
        }
        if (dot(along, next) <= -1.0 + 1e-9) {
            (void)snprintf(why, size, "the path turns back at point %zu", i + 2);
            return true;
        }
        double both = taken(wall, i) + taken(wall, i + 1);
        if (both > length * (1.0 + 1e-9)) {
            (void)snprintf(why, size, "the fillets between points %zu and %zu take %g m of %g m; expected smaller ones",
                           i + 1, i + 2, both, length);
            return true;
        }
    }
    (void)snprintf(why, size, "the path crosses itself");
    return solver_die_cross(wall, wall);
}

/* --- pieces --- */

static void add(struct solver_die *die, struct solver_die_piece piece)
{
    die->piece[die->count++] = piece;
}

/* The corner at point i, of which the pieces before and after go along `in` and `out`. */
static void add_corner(struct solver_die *die, const struct solver_die_wall *wall, size_t i, const double in[2],
                       const double out[2])
{
    double turn = cross(in, out);
    double radius = wall->fillet[i];
    double side = turn > 0.0 ? 1.0 : -1.0; /* of the centre */
    if (turn == 0.0) {
        return;
    }
    if (turn > 0.0 && radius == 0.0) {
        die->piece[die->count - 1].folds = true;
        return;
    }
    double back = taken(wall, i);
    struct solver_die_piece arc = {.kind = turn > 0.0 ? SOLVER_DIE_HOLLOW : SOLVER_DIE_ROUND, .length = radius};
    for (int k = 0; k < 2; k++) {
        double normal = k == 0 ? -in[1] : in[0];
        arc.from[k] = wall->point[i][k] - back * in[k] + side * radius * normal;
        arc.along[k] = in[k];
        arc.after[k] = out[k];
    }
    add(die, arc);
}

static void add_wall(struct solver_die *die, const struct solver_die_wall *wall)
{
    double along[2];
    double next[2];
    double length = direction(wall->point[0], wall->point[1], along);
    for (size_t i = 0; i + 1 < wall->count; i++) {
        double start = taken(wall, i);
        struct solver_die_piece straight = {.kind = SOLVER_DIE_STRAIGHT, .length = length - start - taken(wall, i + 1)};
        for (int k = 0; k < 2; k++) {
            straight.from[k] = wall->point[i][k] + start * along[k];
            straight.along[k] = along[k];
        }
        add(die, straight);
        if (i + 2 < wall->count) {
            length = direction(wall->point[i + 1], wall->point[i + 2], next);
            add_corner(die, wall, i + 1, along, next);
            memcpy(along, next, sizeof along);
        }
    }
}

bool solver_die_create(const struct solver_scene *scene, struct solver_die *die, struct solver_error *error)
{
    *die = (struct solver_die){.wall_count = scene->die_count};
    for (size_t w = 0; w < scene->die_count; w++) {
        die->room += 2 * scene->die[w].count;
    }
    if (die->room == 0) {
        return true;
    }
    if (!solver_alloc((void **)&die->piece, die->room, sizeof *die->piece, "pieces of walls", error)) {
        return false;
    }
    for (size_t w = 0; w < scene->die_count; w++) {
        die->first[w] = die->count;
        add_wall(die, &scene->die[w]);
        die->first[w + 1] = die->count;
    }
    return true;
}

void solver_die_free(struct solver_die *die)
{
    free(die->piece);
    *die = (struct solver_die){.count = 0};
}

/* --- distance --- */

static struct solver_die_near near_plane(const struct solver_die_piece *piece, const double x[2])
{
    double d[2] = {x[0] - piece->from[0], x[1] - piece->from[1]};
    return (struct solver_die_near){.gap = cross(piece->along, d), .normal = {-piece->along[1], piece->along[0]}};
}

/* False if x is not beside the piece: another one is nearer, or the wall ends. Pieces overlap by round-off, so that no
 * place between two of them is lost. */
static bool near_piece(const struct solver_die_piece *piece, const double x[2], struct solver_die_near *near)
{
    double d[2] = {x[0] - piece->from[0], x[1] - piece->from[1]};
    double far = hypot(d[0], d[1]);
    double give = 1e-12 * (far + piece->length);
    double s = dot(d, piece->along);
    if (piece->kind == SOLVER_DIE_STRAIGHT) {
        *near = near_plane(piece, x);
        return s >= -give && s <= piece->length + give;
    }
    double side = piece->kind == SOLVER_DIE_HOLLOW ? -1.0 : 1.0;
    near->gap = side * (far - piece->length);
    for (int k = 0; k < 2; k++) { /* at the centre of a sharp corner any direction between its sides will do */
        near->normal[k] = far > 0.0 ? side * d[k] / far : (k == 0 ? -piece->along[1] : piece->along[0]);
    }
    return s >= -give && dot(d, piece->after) <= give;
}

/* Whether x is not beyond the far end of a straight piece, which begins or ends in the corner. */
static bool is_before_end(const struct solver_die_piece *piece, const double x[2], bool begins)
{
    double d[2] = {x[0] - piece->from[0], x[1] - piece->from[1]};
    double s = dot(d, piece->along);
    return begins ? s <= piece->length : s >= 0.0;
}

size_t solver_die_look(const struct solver_die *die, size_t wall, const double x[2],
                       struct solver_die_near near[SOLVER_DIE_NEAR])
{
    size_t nearest = die->count;
    for (size_t i = die->first[wall]; i < die->first[wall + 1]; i++) {
        struct solver_die_near here;
        if (near_piece(&die->piece[i], x, &here) && (nearest == die->count || fabs(here.gap) < fabs(near[0].gap))) {
            near[0] = here;
            nearest = i;
        }
    }
    if (nearest == die->count) {
        return 0;
    }
    if (die->piece[nearest].folds && is_before_end(&die->piece[nearest + 1], x, true)) {
        near[1] = near_plane(&die->piece[nearest + 1], x);
        return 2;
    }
    if (nearest > die->first[wall] && die->piece[nearest - 1].folds &&
        is_before_end(&die->piece[nearest - 1], x, false)) {
        near[1] = near_plane(&die->piece[nearest - 1], x);
        return 2;
    }
    return 1;
}
