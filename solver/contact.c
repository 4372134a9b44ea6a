#include "solver/contact.h"

#include "solver/keep.h"
#include "solver/memory.h"

#include <math.h>
#include <stdlib.h>

static const double most_spacings = 4.0; /* every particle is asked about all others within */

bool solver_contact_create(const struct solver_body *body, const double *V, struct solver_contact *contact,
                           struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_cloud *cloud = body->cloud;
    *contact = (struct solver_contact){.law = (enum solver_contact_law)scene->contact_law, .begin = NAN, .end = NAN};
    if (contact->law == SOLVER_CONTACT_NONE) {
        return true;
    }
    if (cloud->body == NULL) {
        return solver_fail(error, SOLVER_BAD_INPUT,
                           "%s: contact.law: there is one body, and no other that it could touch; expected several "
                           "under bodies",
                           scene->path);
    }
    contact->distance = scene->contact_distance > 0.0 ? scene->contact_distance : cloud->spacing;
    if (contact->distance > most_spacings * cloud->spacing) {
        return solver_fail(
            error, SOLVER_BAD_INPUT,
            "%s: contact.distance: expected at most %g spacings, %g m, got %g m: bodies touch where their "
            "particles are about a spacing apart",
            scene->path, most_spacings, most_spacings * cloud->spacing, contact->distance);
    }
    if (!solver_alloc((void **)&contact->mass, cloud->count, sizeof(double), "masses", error)) {
        return false;
    }
    for (size_t a = 0; a < cloud->count; a++) {
        contact->mass[a] = V[a] * body->constants[a * body->stride].rho;
    }
    return solver_skin_create(cloud, contact->distance, SOLVER_PAIRS_BETWEEN, &contact->skin, error);
}

void solver_contact_free(struct solver_contact *contact)
{
    solver_skin_free(&contact->skin);
    free(contact->mass);
    *contact = (struct solver_contact){.law = SOLVER_CONTACT_NONE};
}

/* The force that stops the approach of a and b, over their distance; 0 where they are apart or part. The predicted law
 * takes pairs one after the other, each with the accelerations that those before it have left. */
static double stopping(const struct solver_contact *contact, const double *x, const double *v, size_t lanes, double dt,
                       const double *v_rate, size_t a, size_t b)
{
    double square = 0.0;
    double approach = 0.0;
    double foreseen = contact->law == SOLVER_CONTACT_PREDICTED ? dt : 0.0;
    for (size_t i = 0; i < (size_t)contact->skin.cloud->dim; i++) {
        size_t at = a * lanes + i;
        size_t bt = b * lanes + i;
        double r = x[bt] - x[at];
        square += r * r;
        approach += r * (v[bt] - v[at] + foreseen * (v_rate[bt] - v_rate[at]));
    }
    if (square >= contact->distance * contact->distance || approach >= 0.0) {
        return 0.0;
    }
    return contact->mass[a] * contact->mass[b] / (contact->mass[a] + contact->mass[b]) * approach / (square * dt);
}

/* An upper bound of the speed [m/s] of any particle past any other. */
static double relative_speed(const struct solver_contact *contact, const double *v, size_t lanes)
{
    double square = 0.0;
    for (size_t i = 0; i < (size_t)contact->skin.cloud->dim; i++) {
        double low = INFINITY;
        double high = -INFINITY;
        for (size_t a = 0; a < contact->skin.cloud->count; a++) {
            low = fmin(low, v[a * lanes + i]);
            high = fmax(high, v[a * lanes + i]);
        }
        square += (high - low) * (high - low);
    }
    return sqrt(square);
}

bool solver_contact_act(struct solver_contact *contact, const double *x, const double *v, size_t lanes, double t,
                        double dt, double *v_rate, struct solver_error *error)
{
    const struct solver_graph *graph = &contact->skin.graph;
    if (contact->law == SOLVER_CONTACT_NONE) {
        return true;
    }
    double way = relative_speed(contact, v, lanes) * dt;
    if (way > contact->distance) {
        return solver_fail(error, SOLVER_BROKE_DOWN,
                           "particles move past one another by up to %g m in one step, and bodies touch at %g m: they "
                           "would go through one another unseen",
                           way, contact->distance);
    }
    if (!solver_skin_update(&contact->skin, x, lanes, error)) {
        return false;
    }
    for (size_t a = 0; a < graph->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double force = a < b ? stopping(contact, x, v, lanes, dt, v_rate, a, b) : 0.0;
            if (force != 0.0) {
                contact->begin = isnan(contact->begin) ? t : contact->begin;
                contact->end = t;
            }
            for (size_t i = 0; force != 0.0 && i < (size_t)contact->skin.cloud->dim; i++) {
                double r = x[b * lanes + i] - x[a * lanes + i];
                v_rate[a * lanes + i] += force * r / contact->mass[a];
                v_rate[b * lanes + i] -= force * r / contact->mass[b];
            }
        }
    }
    return true;
}

/* The list of pairs makes itself anew; which pairs beyond the distance it holds changes nothing. */
bool solver_contact_keep(struct solver_contact *contact, struct solver_keeper *keeper, struct solver_error *error)
{
    return contact->law == SOLVER_CONTACT_NONE ||
           (solver_keep(keeper, "contact begins", &contact->begin, sizeof contact->begin, 1, error) &&
            solver_keep(keeper, "contact ends", &contact->end, sizeof contact->end, 1, error));
}

void solver_contact_arrays(const struct solver_contact *contact, struct solver_cost_arrays *arrays)
{
    static const char group[] = "contact";
    if (contact->law != SOLVER_CONTACT_NONE) {
        solver_skin_arrays(&contact->skin, group, arrays);
        solver_cost_array(arrays, group, "masses", contact->mass, contact->skin.cloud->count, sizeof *contact->mass);
    }
}

void solver_contact_terms(const struct solver_contact *contact, struct solver_cost_terms *terms)
{
    if (contact->law != SOLVER_CONTACT_NONE) {
        double dim = contact->skin.cloud->dim;
        double pairs = 0.5 * (double)solver_skin_pairs(&contact->skin); /* each is asked once */
        solver_cost_term(terms, "contact: whether particles moved", 0, 3.0 * dim * (double)contact->skin.cloud->count);
        solver_cost_term(terms, "contact: pairs", 0, pairs * (9.0 * dim + 1.0));
    }
}
