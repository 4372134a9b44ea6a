/* A small made-up body for tests of records: a lattice of 3 x 4 x 5 particles whose fields are simple formulas. */
#ifndef TESTS_BODY_H
#define TESTS_BODY_H

#include "solver/record.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BODY_ROWS = 5, BODY_PROBES = 2, BODY_MOST = 60 };

struct body {
    struct solver_scene scene;
    struct solver_cloud cloud;
    struct solver_output output;
    struct solver_history history;
    double X[3 * BODY_MOST], V[BODY_MOST], u[3 * BODY_MOST], v[3 * BODY_MOST], p[3 * BODY_MOST];
    double F[9 * BODY_MOST], H[9 * BODY_MOST], J[BODY_MOST], P[9 * BODY_MOST];
    double sigma[9 * BODY_MOST], sigma_normal[BODY_MOST];
    double pressure[BODY_MOST], von_mises[BODY_MOST], P_normal[BODY_MOST];
    uint32_t tags[BODY_MOST], cell[8 * BODY_MOST];
    struct solver_totals totals[BODY_ROWS];
    char probe_name[BODY_PROBES][64];
    double probe_u[BODY_ROWS * BODY_PROBES * 3], probe_v[BODY_ROWS * BODY_PROBES * 3];
    char text[256], overrides[64];
};

static inline void body_cells(struct body *body, int dim, const int points[3])
{
    static const int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    size_t next = 0;
    for (int k = 0; k < (dim > 2 ? points[2] - 1 : 1); k++) {
        for (int j = 0; j < (dim > 1 ? points[1] - 1 : 1); j++) {
            for (int i = 0; i < points[0] - 1; i++) {
                for (int c = 0; c < 1 << dim; c++) {
                    const int *o = corner[c];
                    int at = ((k + o[2]) * points[1] + j + o[1]) * points[0] + i + o[0];
                    body->cell[next++] = (uint32_t)at;
                }
            }
        }
    }
    body->cloud.cell_count = next >> dim;
}

/* Fields of particle a at X: displacement linear, everything else distinct and easy to name in a test. */
static inline void body_particle(struct body *body, size_t a, size_t dim, const double X[3])
{
    double trace = 0.0;
    for (size_t i = 0; i < dim; i++) {
        body->X[a * dim + i] = X[i];
        for (size_t j = 0; j < dim; j++) {
            const double G = 1e-3 * (double)(1 + i + 2 * j) * (1.0 + 0.1 * X[0]), unit = i == j ? 1.0 : 0.0;
            body->u[a * dim + i] += G * X[j];
            body->F[(a * dim + i) * dim + j] = unit + G;
            body->H[(a * dim + i) * dim + j] = unit - G;
            body->P[(a * dim + i) * dim + j] = 1e6 * G;
            body->sigma[(a * dim + i) * dim + j] = 5e5 * G;
            trace += unit * G;
        }
        body->v[a * dim + i] = 10.0 * body->u[a * dim + i] + 0.5;
        body->p[a * dim + i] = 1100.0 * body->v[a * dim + i];
    }
    body->J[a] = 1.0 + trace;
    body->pressure[a] = 1e6 * trace / 3.0;
    body->von_mises[a] = 2e6 * trace;
    body->P_normal[a] = 3e5 + (double)a;
    body->sigma_normal[a] = 4e5 + (double)a;
    body->V[a] = 0.125 + 0.001 * (double)a;
    body->tags[a] = (uint32_t)(a % 64);
}

static inline void body_history(struct body *body)
{
    for (size_t r = 0; r < BODY_ROWS; r++) {
        const double t = 0.05 * (double)r;
        body->totals[r] = (struct solver_totals){.time = t,
                                                 .linear = {1.0 + t, 2.0 + t, 3.0 + t},
                                                 .angular = {-1.0 - t, -2.0 - t, -3.0 - t},
                                                 .kinetic = 5.0 + t,
                                                 .strain = 4.0 - t,
                                                 .external = 0.5 * t};
        for (size_t k = 0; k < 3 * BODY_PROBES; k++) {
            body->probe_u[r * 3 * BODY_PROBES + k] = 1e-3 * (t + (double)k);
            body->probe_v[r * 3 * BODY_PROBES + k] = t - (double)k;
        }
    }
    (void)snprintf(body->probe_name[0], sizeof body->probe_name[0], "corner");
    (void)snprintf(body->probe_name[1], sizeof body->probe_name[1], "middle");
    body->history = (struct solver_history){.count = BODY_ROWS,
                                            .totals = body->totals,
                                            .probe_count = BODY_PROBES,
                                            .probe_name = body->probe_name,
                                            .probe_u = body->probe_u,
                                            .probe_v = body->probe_v};
}

/* free() releases. */
static inline struct body *body_make(int dim)
{
    struct body *body = calloc(1, sizeof *body);
    if (body == NULL) {
        abort();
    }
    const int points[3] = {3, dim > 1 ? 4 : 1, dim > 2 ? 5 : 1};
    size_t count = 0;
    for (int k = 0; k < points[2]; k++) {
        for (int j = 0; j < points[1]; j++) {
            for (int i = 0; i < points[0]; i++) {
                body_particle(body, count++, (size_t)dim, (double[]){0.5 * i, 0.5 * j, 0.5 * k});
            }
        }
    }
    body_cells(body, dim, points);
    body_history(body);
    (void)snprintf(body->scene.name, sizeof body->scene.name, "made & <up> \"%dD\"", dim);
    (void)snprintf(body->text, sizeof body->text, "-- no scene, really\ntitle = 'caf\xc3\xa9'\n");
    (void)snprintf(body->overrides, sizeof body->overrides, "n=2\n");
    body->scene.text = body->text;
    body->scene.overrides = body->overrides;
    body->scene.dim = dim;
    body->scene.evolved = SOLVER_PFHJ;
    body->cloud.dim = dim;
    body->cloud.count = count;
    body->cloud.X = body->X;
    body->cloud.V = body->V;
    body->cloud.tags = body->tags;
    body->cloud.cell = body->cell;
    body->output = (struct solver_output){.cloud = &body->cloud,
                                          .time = 0.25,
                                          .step = 40,
                                          .V = body->V,
                                          .u = body->u,
                                          .v = body->v,
                                          .p = body->p,
                                          .F = body->F,
                                          .H = body->H,
                                          .J = body->J,
                                          .P = body->P,
                                          .P_normal = dim < 3 ? body->P_normal : NULL,
                                          .sigma = body->sigma,
                                          .sigma_normal = dim < 3 ? body->sigma_normal : NULL,
                                          .pressure = body->pressure,
                                          .von_mises = body->von_mises};
    return body;
}

static inline bool body_record(const struct body *body, struct solver_record **record, struct solver_error *error)
{
    return solver_record_make(&body->scene, &body->output, &body->history, "assay run made-up", "0.1.0", record, error);
}

#endif
