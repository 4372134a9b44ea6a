#include "solver/contact.h"

#include "solver/memory.h"

#include <stdlib.h>

bool solver_contact_create(const struct solver_body *body, const double *V, struct solver_contact *contact,
                           struct solver_error *error)
{
    const struct solver_scene *scene = body->scene;
    const struct solver_cloud *cloud = body->cloud;
    *contact = (struct solver_contact){.law = (enum solver_contact_law)scene->contact_law};
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
    free(contact->impulse);
    *contact = (struct solver_contact){.law = SOLVER_CONTACT_NONE};
}

/* The impulse that stops the approach of a and b, over their distance; 0 where they are apart or part. */
static double stopping(const struct solver_contact *contact, const double *x, size_t lanes, const double *v, size_t a,
                       size_t b)
{
    double square = 0.0;
    double approach = 0.0;
    for (size_t i = 0; i < (size_t)contact->skin.cloud->dim; i++) {
        double r = x[b * lanes + i] - x[a * lanes + i];
        square += r * r;
        approach += r * (v[b * lanes + i] - v[a * lanes + i]);
    }
    if (square >= contact->distance * contact->distance || approach >= 0.0) {
        return 0.0;
    }
    return contact->mass[a] * contact->mass[b] / (contact->mass[a] + contact->mass[b]) * approach / square;
}

static void give(const struct solver_contact *contact, const double *x, size_t lanes, double *v, size_t a, size_t b,
                 double impulse)
{
    for (size_t i = 0; i < (size_t)contact->skin.cloud->dim; i++) {
        double r = x[b * lanes + i] - x[a * lanes + i];
        v[a * lanes + i] += impulse * r / contact->mass[a];
        v[b * lanes + i] -= impulse * r / contact->mass[b];
    }
}

static bool make_room(struct solver_contact *contact, size_t pairs, struct solver_error *error)
{
    if (pairs <= contact->impulse_room) {
        return true;
    }
    free(contact->impulse);
    contact->impulse = NULL;
    contact->impulse_room = 0;
    if (!solver_alloc((void **)&contact->impulse, 2 * pairs, sizeof(double), "contacts", error)) {
        return false;
    }
    contact->impulse_room = 2 * pairs;
    return true;
}

bool solver_contact_apply(struct solver_contact *contact, const double *x, size_t lanes, double *v,
                          struct solver_error *error)
{
    const struct solver_graph *graph = &contact->skin.graph;
    bool at_once = contact->law == SOLVER_CONTACT_PAIRWISE; /* all impulses from the velocities before any of them */
    if (contact->law == SOLVER_CONTACT_NONE) {
        return true;
    }
    if (!solver_skin_update(&contact->skin, x, lanes, error) ||
        (at_once && !make_room(contact, graph->row[graph->count], error))) {
        return false;
    }
    for (size_t a = 0; a < graph->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            size_t b = graph->neighbour[ab];
            double impulse = a < b ? stopping(contact, x, lanes, v, a, b) : 0.0;
            if (at_once) {
                contact->impulse[ab] = impulse;
            } else if (impulse != 0.0) {
                give(contact, x, lanes, v, a, b, impulse);
            }
        }
    }
    for (size_t a = 0; at_once && a < graph->count; a++) {
        for (size_t ab = graph->row[a]; ab < graph->row[a + 1]; ab++) {
            if (contact->impulse[ab] != 0.0) {
                give(contact, x, lanes, v, a, graph->neighbour[ab], contact->impulse[ab]);
            }
        }
    }
    return true;
}
