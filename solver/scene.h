/* A scene: what is simulated, read from a sandboxed Lua 5.4 file.
 *
 * The file assigns globals, one per key (`title = "..."`, `material = { model = ..., E = ... }`). Keys, types and
 * admissible values are one table in scene_keys.c. `parameters = { A = 1, ... }` declares numbers of the scene's own;
 * each is then a global that formulas read and `--set A=2` overrides. An override takes effect where the file assigns
 * the key, so that values computed further down see it; those for keys the file leaves at their default are applied
 * at the end. */
#ifndef SOLVER_SCENE_H
#define SOLVER_SCENE_H

#include "solver/error.h"
#include "solver/grading.h"
#include "solver/hardening.h"
#include "solver/shape.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SOLVER_NAME = 64,
    SOLVER_TEXT = 512,
    SOLVER_LEVELS = 16,
    SOLVER_PROBES = 16,
    SOLVER_SNAPSHOTS = 16,
    SOLVER_FIGURES = 16,
    SOLVER_OPTIONS = 8,
    SOLVER_GATES = 32,
    SOLVER_NAMED = 16,
    SOLVER_PARAMETERS = 24,
    SOLVER_ROWS = 16,
    SOLVER_VARIANTS = 8,
    SOLVER_FACES = 7,
    SOLVER_BODIES = 16,
    SOLVER_DIE_WALLS = 4,
    SOLVER_DIE_POINTS = 16
};

/* Formulas a scene may hold. All are called as f(X, Y, Z, t) in metres and seconds (missing dimensions are 0) and
 * return dim numbers (F: dim*dim, row by row). */
enum solver_formula {
    SOLVER_INITIAL_DISPLACEMENT, /* initial.displacement [m] */
    SOLVER_INITIAL_VELOCITY,     /* initial.velocity [m/s] */
    SOLVER_INITIAL_F,            /* initial.F [-]; without it F is the stencil's gradient of x */
    SOLVER_BODY_FORCE,           /* body_force [N/m^3], per unit reference volume */
    SOLVER_MATERIAL_AT, /* material.at: E [Pa], nu, rho [kg/m^3] at X; without it they are the same everywhere */
    SOLVER_DISTANCE,    /* domain.distance: one number [m]; negative inside */
    SOLVER_FACE_X0,     /* faces.X0.value: traction [Pa] or velocity [m/s]; X1, Y0, Y1, Z0, Z1 follow */
    SOLVER_FACE_Z1 = SOLVER_FACE_X0 + 5,
    SOLVER_FACE_SURFACE, /* the same of the curved face of a round domain */
    SOLVER_SHEAR_X0,     /* faces.X0.traction: traction [Pa] of a roller; X1, Y0, Y1, Z0, Z1 follow */
    SOLVER_SHEAR_SURFACE = SOLVER_SHEAR_X0 + 6, /* no scene has it */
    SOLVER_FORMULAS
};

enum solver_face_kind {
    SOLVER_FREE,      /* no traction */
    SOLVER_SYMMETRIC, /* no displacement along the normal */
    SOLVER_SKEW,      /* no displacement across the normal (skew-symmetric) */
    SOLVER_CLAMPED,   /* no displacement */
    SOLVER_TRACTION,  /* first Piola-Kirchhoff traction by formula [Pa] */
    SOLVER_MOTION,    /* velocity by formula [m/s] */
    SOLVER_ROLLER     /* along the normal velocity by formula [m/s], across it traction by formula [Pa], default none */
};

/* Where particles lie: on the corners of the cells of a lattice, or in their centres. */
enum solver_lattice { SOLVER_NODES, SOLVER_CENTRES };

/* How particles of walls move: as the face they stand for, or against those of the body on its other side. */
enum solver_wall_motion { SOLVER_WALL_RIGID, SOLVER_WALL_MIRRORED };

/* Evolved sets of 000_e9ec29e1bde7947d.txt: the geometric measures that have an equation of their own. */
enum solver_evolved { SOLVER_PF, SOLVER_PFJ, SOLVER_PFHJ };

/* What keeps bodies apart (contact.h). */
enum solver_contact_law {
    SOLVER_CONTACT_NONE,
    SOLVER_CONTACT_PRINTED,  /* stops the velocity of approach now */
    SOLVER_CONTACT_PREDICTED /* stops that at the end of the step */
};

/* What the updated-Lagrangian scheme is made of (001_363f711843f01da4.txt); every ingredient can be left out. */
enum solver_ulsph_gradient {
    SOLVER_ULSPH_CORRECTED, /* by the corrective matrix L (eq. 27 to 29) */
    SOLVER_ULSPH_PLAIN      /* of the kernel alone (eq. 8, 9, 13) */
};
/* What damps the motion of neighbours against one another. */
enum solver_ulsph_dissipation {
    SOLVER_ULSPH_RIEMANN,   /* R, eq. 43, 44 */
    SOLVER_ULSPH_VISCOSITY, /* AV, eq. 15, 16 */
    SOLVER_ULSPH_INVISCID
};
/* What keeps particles from clumping in tension. */
enum solver_ulsph_tension {
    SOLVER_ULSPH_CONTROL,           /* TIC, eq. 51; artificial stress at the surface alone */
    SOLVER_ULSPH_ARTIFICIAL_STRESS, /* AS, eq. 17, 31 */
    SOLVER_ULSPH_BARE
};
/* Which part of the artificial stress acts. */
enum solver_ulsph_repulsion {
    SOLVER_ULSPH_PRINTED, /* all of it (eq. 17), at the initial spacing too: it does not vanish as n grows */
    SOLVER_ULSPH_EXCESS   /* what exceeds its value at the initial spacing: between particles that came closer */
};
/* What weighs a particle on a face of the body in kernel sums. */
enum solver_ulsph_cells {
    SOLVER_ULSPH_WHOLE, /* the cell it would have within the body */
    SOLVER_ULSPH_CUT    /* its volume, as printed for particles that lie on no face */
};
struct solver_ulsph_terms {
    int gradient, dissipation, tension, repulsion, cells; /* of the enums above */
    double viscosity;                                     /* alpha of AV */
    double stress_factor, stress_exponent;                /* epsilon and n of AS */
    double xsph;                                          /* epsilon of the transport velocity (eq. 14); 0: none */
    double delta;                                         /* of the density diffusion (eq. 33); 0: none */
};

/* The dissipation of 004_0c0448173ed5e9bd.txt, eq. 3.13. */
struct solver_jst_terms {
    double kappa2, kappa4; /* of the harmonic and the biharmonic part; 0: none */
    bool fades;            /* kappa4 falls to kappa4_plastic while the plastic strain grows to plastic_at (eq. 4.2) */
    double kappa4_plastic, plastic_at;
};

/* How the pressure of an incompressible or nearly incompressible body is found (pressure.h). */
enum solver_pressure_solver { SOLVER_PRESSURE_NONE, SOLVER_PRESSURE_POISSON, SOLVER_PRESSURE_PSEUDO_TIME };
struct solver_incompressible {
    int solver;         /* enum solver_pressure_solver */
    double tolerance;   /* share of a particle's volume that a stage may leave unbalanced */
    int iterations;     /* most of them, per stage */
    double dissipation; /* of pressure jumps, over that of the printed flux */
    double restore;     /* share of a stray volume that is given back within a step */
    double modulus;     /* fictitious bulk modulus over the shear modulus */
    double gamma;       /* artificial compressibility over the fictitious bulk modulus */
    double alpha;       /* of the Laplacian in pseudo-time */
};

/* A rigid plane wall without friction (wall.h); a normal of zeros: none. */
struct solver_rigid_wall {
    double point[3], normal[3]; /* [m]; towards the body, of any length */
};

/* A rigid wall without friction in the plane: a path with rounded corners, the body to its left (die.h). */
struct solver_die_wall {
    size_t count;
    double point[SOLVER_DIE_POINTS][2]; /* [count] [m] */
    double fillet[SOLVER_DIE_POINTS];   /* [count] radii [m]; 0 at both ends */
};

struct solver_named {
    char name[SOLVER_NAME];
    double value;
};

/* A row of the published table: error values at `n` spacings. */
struct solver_published_row {
    int n;
    size_t count;
    struct solver_named value[SOLVER_NAMED];
};

/* Keys and the values they have, as `--set` would spell them, in the order of the keys. */
struct solver_settings {
    size_t count;
    char key[SOLVER_NAMED][SOLVER_NAME];
    char text[SOLVER_NAMED][SOLVER_NAME];
};

/* The same problem set up another way (less of it by symmetry, for instance), as a study of costs may vary it. */
struct solver_variant {
    char name[SOLVER_NAME];
    struct solver_settings settings;
};

/* One entry of `gates`: bounds that hold where every key under `when` has the given value in this run.
 * Bound names: an error name ("p", "P": largest error at the finest level) or "rate NAME" (smallest observed order
 * between the two finest levels). An entry without `when` holds where no other does. */
struct solver_gate_rule {
    size_t conditions;
    char key[SOLVER_NAMED][SOLVER_NAME];
    char text[SOLVER_NAMED][SOLVER_NAME]; /* the value as `--set` would spell it */
    size_t bounds;
    struct solver_named bound[SOLVER_NAMED];
};

/* One option of a figure: text, or up to four numbers. */
struct solver_option {
    char name[SOLVER_NAME];
    char text[SOLVER_NAME]; /* "" if numbers were given */
    size_t count;
    double number[4];
};

/* A number that a study measures in the run, and how. What measures there are, and their options, the study knows. */
struct solver_figure {
    char name[SOLVER_NAME];
    char measure[SOLVER_NAME];
    size_t option_count;
    struct solver_option option[SOLVER_OPTIONS]; /* ordered by name */
};

struct solver_probe {
    char name[SOLVER_NAME];
    double X[3]; /* [m]; the nearest particle is recorded */
};

/* The fixed view of the scene's picture. */
struct solver_view {
    char
        field[SOLVER_NAME]; /* a scalar of the record: "pressure", "von_mises", "displacement", "displacement_x", ... */
    double range[2];        /* colour range, in the field's unit; {0, 0}: that of the field */
    int bands;              /* filled contour bands; 0: as many as round numbers ask for */
    double direction[3];    /* from the body towards the eye */
    double up[3];
    double magnify;  /* displacement shown = magnify * displacement */
    int size[2];     /* pixels */
    double frame[6]; /* x0 x1 y0 y1 z0 z1 [m]: what stays in sight; all zero: the body with room around it */
};

/* The state at t = 0 at X [m]: displacement [m], velocity [m/s], F row by row, 3D. */
typedef void solver_start(const void *context, const double X[3], double u[3], double v[3], double F[9]);
/* What drives the body at X [m] and t [s]: what the formula would give that it stands in for, of body_force and those
 * of faces; 3D. */
typedef void solver_drive(const void *context, enum solver_formula formula, const double X[3], double t,
                          double value[3]);

struct solver_scene {
    char path[4096];
    char name[SOLVER_NAME]; /* file name without folder and .lua */
    char title[SOLVER_TEXT];
    char source[SOLVER_TEXT]; /* paper and section, may be empty */
    char *text;               /* the whole file */
    char *overrides;          /* "KEY=value\n" lines as given, "" if none */

    int dim;                       /* 1, 2, 3 */
    double lower[3], upper[3];     /* box domain, or the box around a round one or around all bodies [m] */
    struct solver_shape domain;    /* its kind; without its box */
    char domain_file[SOLVER_TEXT]; /* of triangles; relative to the scene's folder */
    double domain_scale;           /* [m] of the lengths in it */
    bool symmetric[3];             /* the lower face across each axis is a plane of symmetry (domain.symmetry) */
    size_t shape_count;            /* 0: one body, the domain */
    struct solver_shape shape[SOLVER_BODIES];
    enum solver_lattice lattice;
    enum solver_wall_motion wall_motion;
    int wall;                  /* layers of particles beyond a face that holds or moves them, in SOLVER_CENTRES */
    double reference_length;   /* [m]; spacing = reference_length / n */
    int n;                     /* spacings along the reference length */
    int levels[SOLVER_LEVELS]; /* values of n for a study, increasing */
    size_t level_count;
    struct solver_grading grading[3]; /* along each axis of a box; n spacings are then means */
    double perturb;                   /* random shift of interior particles, as a fraction of the spacing, [0, 0.45] */
    uint64_t seed;

    char material_model[SOLVER_NAME];
    double E, nu, rho; /* [Pa], [-], [kg/m^3] */
    struct solver_hardening hardening;

    char scheme[SOLVER_NAME]; /* "upwind", "jst", "ulsph" */
    enum solver_evolved evolved;
    char stencil[SOLVER_NAME];          /* "sph", "closed", "sbp2", "sbp4" */
    double support;                     /* support radius / spacing */
    char reconstruction[SOLVER_NAME];   /* "stencil", "least-squares", "lattice", "none"; never empty */
    char angular_momentum[SOLVER_NAME]; /* "free", "projected" (projection.h) */
    char volume_flux[SOLVER_NAME];      /* dissipation of J by the jump of "pressure" or of the whole "stress" */
    struct solver_jst_terms jst;
    struct solver_ulsph_terms ulsph;
    int contact_law;         /* enum solver_contact_law */
    double contact_distance; /* [m]; 0: the spacing */
    struct solver_incompressible incompressible;
    struct solver_rigid_wall rigid_wall;
    size_t die_count; /* 0: none */
    struct solver_die_wall die[SOLVER_DIE_WALLS];
    char integrator[SOLVER_NAME];
    double cfl;
    double t_end;        /* [s] */
    double golden_t_end; /* [s] of the stored record; 0: t_end */
    size_t snapshot_count;
    double snapshot[SOLVER_SNAPSHOTS]; /* [s] increasing, in (0, t_end]: a study's run stops there and is compared */
    int history;                       /* rows of the time history over t_end */
    bool balance;                      /* what numerical dissipation and a rigid wall take is measured */
    char precision[SOLVER_NAME];       /* "double", "mixed", "single" */
    int threads;                       /* 0: as many as there are cores and the work is worth */

    enum solver_face_kind face[SOLVER_FACES]; /* X0, X1, Y0, Y1, Z0, Z1, surface */
    char initial_from[SOLVER_NAME];           /* "formulas", or "oracle": see solver_scene_start_from */
    char loads_from[SOLVER_NAME];             /* likewise for what drives the body: see solver_scene_drive_from */
    double face_until[SOLVER_FACES];          /* [s] a moved face is free after this time; infinite otherwise */
    double face_within[SOLVER_FACES][2]
                      [3]; /* [m] corners of the box around what moves of a moved face; infinite: all */
    struct solver_probe probe[SOLVER_PROBES];
    size_t probe_count;
    double probe_scale; /* [m] what the error "probes_nrmse" is relative to; 0 if not given */

    size_t figure_count;
    struct solver_figure figure[SOLVER_FIGURES]; /* ordered by name */

    char oracle[SOLVER_NAME]; /* "" if the scene answers to none */
    size_t oracle_told_count; /* oracle.KEY = number: told to the oracle in place of the scene's own value */
    struct solver_named oracle_told[SOLVER_NAMED];
    char published_source[SOLVER_TEXT];
    size_t published_count;
    struct solver_published_row published[SOLVER_ROWS];
    size_t gate_count;
    struct solver_gate_rule gate[SOLVER_GATES];
    struct solver_settings beside; /* what another configuration overrides, beside which this one is looked at */
    size_t variant_count;
    struct solver_variant variant[SOLVER_VARIANTS]; /* of the key `trade`, ordered by name */
    bool has_view;
    struct solver_view view;

    solver_start *start; /* NULL: the formulas */
    void *start_context;
    solver_drive *drive; /* NULL: the formulas */
    void *drive_context;
    void (*drive_release)(void *context);
    struct solver_scene_lua *lua; /* the interpreter that holds the formulas; private */
};

/* Reads a scene file and applies `overrides` ("key=value", value a number, true, false or a bare word; a list is
 * written {1,2,3}). Errors name file and key and say what was expected. On failure *scene is NULL. */
bool solver_scene_load(const char *path, const char *const *overrides, size_t override_count,
                       struct solver_scene **scene, struct solver_error *error);
/* The same of a text in memory, such as a record or a checkpoint holds, under the path that it once had: nothing is
 * read from there. */
bool solver_scene_load_text(const char *path, const char *text, const char *const *overrides, size_t override_count,
                            struct solver_scene **scene, struct solver_error *error);
void solver_scene_free(struct solver_scene *scene);

/* Whether its material flows plastically. */
static inline bool solver_scene_flows(const struct solver_scene *scene)
{
    return scene->hardening.yield > 0.0;
}

/* Layers of particles that hold or move a face (0..5) from beyond it; 0: none. */
int solver_scene_wall(const struct solver_scene *scene, int face);

/* Whether the scene gives this formula. */
bool solver_scene_has(const struct solver_scene *scene, enum solver_formula formula);
/* As if the scene did not give it; one that its keys need is not to be forgotten. */
void solver_scene_forget(struct solver_scene *scene, enum solver_formula formula);
/* Evaluates a formula at X [m] (3 entries) and t [s]: `count` numbers into out. Runs under an instruction budget;
 * errors name file, key and place. Not thread-safe: one interpreter per scene. */
bool solver_scene_eval(const struct solver_scene *scene, enum solver_formula formula, const double X[3], double t,
                       double *out, size_t count, struct solver_error *error);
/* Initial displacement, velocity and F come from `start` in place of formulas, while `context` lasts. A scene with
 * initial.from = "oracle" needs this before a run of it is created: the solver knows no oracles. */
void solver_scene_start_from(struct solver_scene *scene, solver_start *start, void *context);
/* Body force and what faces prescribe come from `drive` in place of formulas; NULL: from the formulas again. The
 * context is released (release may be NULL) when it is replaced or the scene freed. A scene with loads.from = "oracle"
 * needs this before a run of it is created. `drive` may be called by several threads at a time. */
void solver_scene_drive_from(struct solver_scene *scene, solver_drive *drive, void *context,
                             void (*release)(void *context));
/* A number of the scene by its path: "material.nu", "cfl", or one of the scene's parameters ("U0").
 * False if there is none of that name. */
bool solver_scene_number(const struct solver_scene *scene, const char *path, double *value);
/* The value of a plain key as `--set` would spell it ("closed", "0.3"): for gate conditions and reports. */
bool solver_scene_text(const struct solver_scene *scene, const char *path, char *out, size_t size);

/* The words that a plain key can have as its value, in the order of their table; none if it takes no words. */
size_t solver_scene_words(const char *key, char (*word)[SOLVER_NAME], size_t room);

/* What a key says: what is simulated, how it is solved, or what is watched, judged and shown of it, and by how many
 * threads. */
enum solver_key_says { SOLVER_KEY_PROBLEM, SOLVER_KEY_METHOD, SOLVER_KEY_REPORT };

/* The keys every scene understands, for `assay list`; ends with a NULL key. */
struct solver_scene_key {
    const char *key;
    const char *expects; /* "number > 0 [Pa]", "one of upwind" */
    const char *meaning;
    const char *preset; /* what it has unless given, as `--set` spells it; "": nothing, or `meaning` says; NULL: it must
                           be given */
    enum solver_key_says says;
};
const struct solver_scene_key *solver_scene_keys(void);
/* Of so many bytes of a path, as `--set` spells it: what of no key, a parameter of the scene, says is of the problem.
 */
enum solver_key_says solver_scene_key_says(const char *path, size_t length);

#endif
