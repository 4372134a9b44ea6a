/* The cases of the suite: every scheme, stencil, evolved set and material of the solver's tables, with every kind of
 * boundary data, in every dimension. A new member of a table is a new case. */
#include "solver/integrator.h"
#include "solver/material.h"
#include "solver/stencil.h"
#include "verify/mms.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct list {
    struct verify_mms_case *cases;
    size_t count, room;
    bool full; /* no memory */
};

static struct verify_mms_case *append(struct list *list, const struct verify_mms_case *fresh)
{
    static struct verify_mms_case nowhere;
    if (list->count == list->room) {
        size_t room = 2 * list->room + 64;
        struct verify_mms_case *grown = realloc(list->cases, room * sizeof *grown);
        if (grown == NULL) {
            list->full = true;
            nowhere = *fresh;
            return &nowhere;
        }
        list->cases = grown;
        list->room = room;
    }
    list->cases[list->count] = *fresh;
    return &list->cases[list->count++];
}

static __attribute__((format(printf, 2, 3))) void set(struct verify_mms_case *which, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(which->setting[which->setting_count++], VERIFY_MMS_TEXT, format, arguments);
    va_end(arguments);
}

static const char *const boundaries[] = {"motion", "traction", "roller"};
enum { BOUNDARIES = 3 };

static void set_faces(struct verify_mms_case *which, int dim, const char *kind)
{
    for (int face = 0; face < 2 * dim; face++) {
        set(which, "faces.%c%d=%s", "XYZ"[face / 2], face % 2, kind);
    }
}

/* What a stencil claims in space, in the order p, x, F, H, J, P. Where the boundary is differentiated to first order,
 * so are F and H there: in the norm half an order is lost, and J and P are saved by the equation of J. One whose pair
 * vectors are not closed claims nothing. */
static const double second_order[VERIFY_MMS_VARIABLES] = {1.9, 1.8, 1.5, 1.5, 1.8, 1.8};
static const double third_order[VERIFY_MMS_VARIABLES] = {2.8, 2.8, 2.8, 2.8, 2.8, 2.8};

static const double nothing[VERIFY_MMS_VARIABLES] = {0};

static void claim(struct verify_mms_case *which, const double order[VERIFY_MMS_VARIABLES])
{
    memcpy(which->asked, order, sizeof which->asked);
}

static void claim_of(struct verify_mms_case *which, const struct solver_stencil_builder *stencil)
{
    if (stencil->closed) {
        claim(which, stencil->boundary >= 2 ? third_order : second_order);
    }
}

struct upwind {
    const struct solver_stencil_builder *stencil;
    const char *evolved, *material;
    int dim, boundary;
};

static struct verify_mms_case *add_upwind(struct list *list, const char *family, const char *scene, struct upwind of)
{
    struct verify_mms_case *which = append(list, &(struct verify_mms_case){.family = family, .scene = scene});
    (void)snprintf(which->name, sizeof which->name, "%-6s %-4s %-22s %-8s", of.stencil->name, of.evolved, of.material,
                   boundaries[of.boundary]);
    set(which, "dim=%d", of.dim);
    set(which, "stencil=%s", of.stencil->name);
    set(which, "evolved=%s", of.evolved);
    set(which, "material.model=%s", of.material);
    set_faces(which, of.dim, boundaries[of.boundary]);
    claim_of(which, of.stencil);
    return which;
}

static const char *const evolved_sets[] = {"pF", "pFJ", "pFHJ"};
enum { EVOLVED_SETS = 3 };

/* What is asked of the levels of a study that is one of many: order 2 is met, from below, by finer ones. */
static const double second_order_coarse[VERIFY_MMS_VARIABLES] = {1.7, 1.7, 1.5, 1.5, 1.7, 1.7};

/* The claims themselves, at levels fine enough to hold them. */
static void add_claims(struct list *list)
{
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; s->closed && b < BOUNDARIES; b++) {
            struct upwind of = {s, "pFHJ", "neo-hookean", 2, b};
            struct verify_mms_case *which = add_upwind(list, "large strain, 2D, fine", "manufactured", of);
            which->level[0] = 32;
            which->level[1] = 64;
        }
    }
}

/* Forces within the body corrected so that they keep angular momentum (solver/projection.h): no order is lost. */
static void add_projected(struct list *list)
{
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; s->closed && b < BOUNDARIES; b++) {
            struct upwind of = {s, "pFHJ", "neo-hookean", 2, b};
            struct verify_mms_case *which = add_upwind(list, "angular momentum kept", "manufactured", of);
            set(which, "angular_momentum=projected");
            if (s->boundary < 2) {
                claim(which, second_order_coarse);
            }
            which->level[0] = 16;
            which->level[1] = 32;
        }
    }
}

/* Hencky's material is so soft in tension that second-order stencils come to their order late, with errors that are
 * smaller than those of others: in a line 1.77, 1.90, 2.01, 1.99 in p from 1/32 to 1/512, in the plane 1.33 and 2.10 in
 * F from 1/16 to 1/64. */
static bool comes_late(const struct solver_stencil_builder *stencil, const struct solver_material_model *material)
{
    return stencil->closed && stencil->boundary < 2 && strcmp(material->name, "hencky") == 0;
}

/* Everything with everything, in the plane. */
static void add_plane(struct list *list)
{
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (const struct solver_material_model *m = solver_material_models(); m->name != NULL; m++) {
            for (int eb = 0; eb < EVOLVED_SETS * BOUNDARIES; eb++) {
                struct upwind of = {s, evolved_sets[eb / BOUNDARIES], m->name, 2, eb % BOUNDARIES};
                struct verify_mms_case *which = add_upwind(list, "large strain, 2D", "manufactured", of);
                if (s->closed && s->boundary < 2) {
                    claim(which, second_order_coarse);
                }
                bool late = comes_late(s, m);
                which->level[0] = late ? 24 : 16;
                which->level[1] = late ? 48 : 32;
            }
        }
    }
}

/* In a line H is 1, and a roller a moved face. */
static void add_line(struct list *list)
{
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (const struct solver_material_model *m = solver_material_models(); m->name != NULL; m++) {
            for (int eb = 0; eb < (EVOLVED_SETS - 1) * (BOUNDARIES - 1); eb++) {
                struct upwind of = {s, evolved_sets[eb / (BOUNDARIES - 1)], m->name, 1, eb % (BOUNDARIES - 1)};
                struct verify_mms_case *which = add_upwind(list, "large strain, 1D", "manufactured", of);
                which->asked[VERIFY_MMS_OF_H] = 0;
                bool late = comes_late(s, m);
                which->level[0] = late ? 128 : 32;
                which->level[1] = late ? 256 : 64;
            }
        }
    }
}

/* At sizes that a suite can afford the two levels of a body in space are still so coarse that second-order stencils
 * have not come to their order where faces are moved: what they claim is what was measured. */
static void add_space(struct list *list)
{
    static const double measured[VERIFY_MMS_VARIABLES] = {1.7, 1.6, 1.1, 1.2, 1.3, 1.2};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; b < BOUNDARIES; b++) {
            struct upwind of = {s, "pFHJ", "neo-hookean", 3, b};
            struct verify_mms_case *which = add_upwind(list, "strains of 20 %, 3D", "manufactured", of);
            set(which, "amplitude=0.3");
            if (s->closed && s->boundary < 2) {
                claim(which, measured);
            }
            which->level[0] = 12;
            which->level[1] = 18;
        }
    }
}

/* Slopes by the stencil's own gradient are no good there: between particles that are out of line the dissipation of J
 * then feeds energy in, and J of single particles runs away. So they claim nothing, and least-squares slopes what was
 * measured. */
static void add_perturbed(struct list *list)
{
    static const double measured[VERIFY_MMS_VARIABLES] = {1.1, 1.1, 0.9, 0.9, 1.1, 1.1};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; !s->lattice_only && b < 2 * BOUNDARIES; b++) {
            bool least_squares = b >= BOUNDARIES;
            struct upwind of = {s, "pFHJ", "neo-hookean", 2, b % BOUNDARIES};
            struct verify_mms_case *which = add_upwind(list, "large strain, 2D, perturbed by 15 %", "manufactured", of);
            (void)snprintf(which->name, sizeof which->name, "%-6s %-4s %-22s %-8s", s->name, "pFHJ",
                           least_squares ? "least-squares slopes" : "slopes of the stencil",
                           boundaries[b % BOUNDARIES]);
            set(which, "perturb=0.15");
            set(which, "reconstruction=%s", least_squares ? "least-squares" : "stencil");
            claim(which, s->closed && least_squares ? measured : nothing);
            which->level[0] = 20;
            which->level[1] = 40;
        }
    }
}

/* Lattices whose largest spacing is ten times the smallest along X, and three times along Y. At the coarse end second
 * order is met late: with faces that are led sbp2 has 1.87 in p, 1.75 in H and 1.99 in P from 1/48 to 1/96. */
static void add_graded(struct list *list)
{
    static const double measured[VERIFY_MMS_VARIABLES] = {1.8, 1.4, 1.1, 1.1, 1.8, 1.7};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; s->lattice_only && b < BOUNDARIES - 1; b++) {
            struct upwind of = {s, "pFHJ", "neo-hookean", 2, b};
            struct verify_mms_case *which = add_upwind(list, "large strain, 2D, graded", "manufactured", of);
            if (s->boundary < 2) {
                claim(which, measured);
            }
            set(which, "grading.X=10");
            set(which, "grading.Y=3");
            set(which, "grading.fine_Y=both");
            which->level[0] = 24;
            which->level[1] = 48;
        }
    }
}

/* At these levels, as measured, a little below what the stencils claim. */
static void add_isochoric(struct list *list)
{
    static const double second[VERIFY_MMS_VARIABLES] = {1.8, 1.8, 1.4, 1.4, 1.8, 1.8};
    static const double third[VERIFY_MMS_VARIABLES] = {2.7, 2.8, 2.6, 2.6, 2.6, 2.6};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int e = 0; e < EVOLVED_SETS; e++) {
            for (int b = 0; b < BOUNDARIES; b++) {
                struct upwind of = {s, evolved_sets[e], "neo-hookean", 2, b};
                struct verify_mms_case *which =
                    add_upwind(list, "volumes kept, 2D, nu = 0.4999", "manufactured-isochoric", of);
                which->level[0] = 12;
                which->level[1] = 24;
                if (e == 0) { /* F alone lets volumes drift, and is as stiff against that: it locks */
                    claim(which, nothing);
                } else if (s->closed) {
                    claim(which, s->boundary < 2 ? second : third);
                }
            }
        }
    }
}

/* The same of a body that cannot yield in volume at all (solver/pressure.h). Claimed is what was measured at these
 * levels: the velocity of sbp2 between faces with tractions is of order 1.27 here, 2.40 from 1/32 to 1/64, and its
 * pressure of order 1, as what keeps it from alternating has a small factor; 1.9 with incompressible.dissipation=0.1.
 */
static void add_incompressible(struct list *list)
{
    static const double second[VERIFY_MMS_VARIABLES] = {1.2, 1.7, 1.5, 1.5, 0.6, 0.9};
    static const double third[VERIFY_MMS_VARIABLES] = {2.1, 2.6, 3.0, 3.0, 3.2, 1.9};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int eb = BOUNDARIES; s->lattice_only && eb < EVOLVED_SETS * BOUNDARIES; eb++) {
            struct upwind of = {s, evolved_sets[eb / BOUNDARIES], "neo-hookean", 2, eb % BOUNDARIES};
            struct verify_mms_case *which =
                add_upwind(list, "volumes kept, 2D, nu = 0.5", "manufactured-isochoric", of);
            set(which, "material.nu=0.5");
            set(which, "incompressible.solver=poisson");
            set(which, "incompressible.tolerance=1e-10");
            claim(which, s->boundary < 2 ? second : third);
            which->level[0] = 16;
            which->level[1] = 32;
        }
    }
}

static void add_waves(struct list *list)
{
    for (int dim = 1; dim <= 2; dim++) {
        for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
            for (int b = 0; b < (dim == 1 ? BOUNDARIES - 1 : BOUNDARIES); b++) {
                static const char *const family[] = {"small waves, 1D", "small waves, 2D"};
                struct upwind of = {s, "pF", "linear-elastic", dim, b};
                struct verify_mms_case *which = add_upwind(list, family[dim - 1], "manufactured-waves", of);
                if (s->closed && s->boundary < 2) {
                    claim(which, second_order_coarse);
                }
                which->asked[VERIFY_MMS_OF_H] = dim == 1 ? 0 : which->asked[VERIFY_MMS_OF_H];
                which->level[0] = 20;
                which->level[1] = 40;
            }
        }
    }
}

/* JST dissipation has its natural conditions at a boundary (jst.h): there it is of first order in the spacing, and what
 * it leaves of J and of the stress within a layer lets no stencil be better than that allows. Second-order stencils
 * keep their order; what sbp4 claims is what was measured. */
static void add_jst(struct list *list)
{
    static const double fourth[VERIFY_MMS_VARIABLES] = {2.4, 2.6, 2.0, 2.0, 1.8, 2.2};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; s->closed && b < 2 * BOUNDARIES; b++) {
            struct upwind of = {s, evolved_sets[b < BOUNDARIES ? 0 : 2], "neo-hookean", 2, b % BOUNDARIES};
            struct verify_mms_case *which = add_upwind(list, "JST, large strain, 2D", "manufactured", of);
            set(which, "scheme=jst");
            claim(which, s->boundary < 2 ? second_order_coarse : fourth);
            which->level[0] = 16;
            which->level[1] = 32;
        }
    }
}

/* The updated-Lagrangian scheme has no P, and its law is one of rates: it is Hooke's at small strain. */
static void add_ulsph(struct list *list)
{
    static const char *const tension[] = {"none", "control"};
    for (int dim = 1; dim <= 2; dim++) {
        for (int b = 0; b < 2; b++) {
            for (int t = 0; t < 2; t++) {
                struct verify_mms_case *which =
                    append(list, &(struct verify_mms_case){.family = dim == 1 ? "small waves, 1D, updated Lagrangian"
                                                                              : "small waves, 2D, updated Lagrangian",
                                                           .scene = "manufactured-waves"});
                (void)snprintf(which->name, sizeof which->name, "ulsph, tension %-8s %-14s %-8s", tension[t], "",
                               boundaries[b]);
                set(which, "dim=%d", dim);
                set(which, "scheme=ulsph");
                set(which, "ulsph.tension=%s", tension[t]);
                set(which, "integrator=tvd-rk2");
                set(which, "support=2.4");
                set_faces(which, dim, boundaries[b]);
                which->level[0] = 20;
                which->level[1] = 40;
            }
        }
    }
}

/* A body that flows all over and all the time, along a fixed direction at each place: the return map is exact there. At
 * these levels, as measured: where tractions are prescribed stress and plastic strain come late to their order, and
 * with JST the layer at the boundary (see add_jst) shows. */
static void add_flow(struct list *list, bool jst)
{
    static const double second[VERIFY_MMS_VARIABLES] = {1.7, 1.6, 1.6, 1.6, 1.6, 1.5, 1.7};
    static const double third[VERIFY_MMS_VARIABLES] = {2.8, 2.8, 2.5, 2.5, 2.8, 2.6, 2.7};
    static const double with_jst[VERIFY_MMS_VARIABLES] = {1.7, 2.2, 1.4, 1.4, 1.7, 1.0, 1.6};
    for (const struct solver_stencil_builder *s = solver_stencil_builders(); s->name != NULL; s++) {
        for (int b = 0; s->closed && b < (jst ? 1 : 2) * BOUNDARIES; b++) {
            struct upwind of = {s, evolved_sets[jst || b >= BOUNDARIES ? 2 : 0], "hencky", 2, b % BOUNDARIES};
            struct verify_mms_case *which =
                add_upwind(list, jst ? "JST, plastic flow, 2D" : "plastic flow, 2D", "manufactured-flow", of);
            set(which, "scheme=%s", jst ? "jst" : "upwind");
            claim(which, s->boundary < 2 ? second : jst ? with_jst : third);
            which->level[0] = 16;
            which->level[1] = 32;
        }
    }
}

/* The same in time. The discrete motion does not keep the directions quite, and where strain turns the return map,
 * Euler's implicit one, is of first order in the step: TVD-RK2 has order 2 here, and RK4 comes to what the return map
 * leaves, 3e-7 of p. */
static void add_flow_time(struct list *list)
{
    static const struct {
        const char *integrator;
        double order;
    } rows[] = {{"tvd-rk2", 1.85}, {"rk4", 0.9}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct upwind of = {solver_stencil_find("sbp2"), "pFHJ", "hencky", 2, 0};
        struct verify_mms_case *which = add_upwind(list, "in time, plastic flow, 2D, n = 16", "manufactured-flow", of);
        (void)snprintf(which->name, sizeof which->name, "%-8s %-28s %-8s", rows[i].integrator, "", "motion");
        set(which, "integrator=%s", rows[i].integrator);
        which->level[0] = 4;
        which->level[1] = 8;
        for (int v = 0; v < VERIFY_MMS_VARIABLES; v++) {
            which->asked[v] = rows[i].order;
        }
        which->in_time = true;
    }
}

/* Order in time of every integrator, with every kind of boundary data. */
static void add_time(struct list *list)
{
    for (const struct solver_integrator *i = solver_integrators(); i->name != NULL; i++) {
        for (int b = 0; b < BOUNDARIES; b++) {
            struct upwind of = {solver_stencil_find("sbp2"), "pFHJ", "neo-hookean", 2, b};
            struct verify_mms_case *which = add_upwind(list, "in time, large strain, 2D, n = 16", "manufactured", of);
            (void)snprintf(which->name, sizeof which->name, "%-8s order %d %-20s %-8s", i->name, i->order, "",
                           boundaries[b]);
            set(which, "integrator=%s", i->name);
            which->level[0] = 4;
            which->level[1] = 8;
            for (int v = 0; v < VERIFY_MMS_OF_PLASTIC_STRAIN; v++) {
                which->asked[v] = i->order - 0.15;
            }
            which->in_time = true;
        }
    }
}

bool verify_mms_cases(struct verify_mms_case **cases, size_t *count, struct solver_error *error)
{
    struct list list = {.cases = NULL};
    add_claims(&list);
    add_projected(&list);
    add_plane(&list);
    add_line(&list);
    add_space(&list);
    add_perturbed(&list);
    add_graded(&list);
    add_isochoric(&list);
    add_incompressible(&list);
    add_waves(&list);
    add_jst(&list);
    add_flow(&list, false);
    add_flow(&list, true);
    add_ulsph(&list);
    add_time(&list);
    add_flow_time(&list);
    *cases = list.cases;
    *count = list.count;
    if (list.full) {
        free(list.cases);
        *cases = NULL;
        return solver_fail(error, SOLVER_NO_MEMORY, "no memory for the list of manufactured solutions");
    }
    return true;
}
