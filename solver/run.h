/* A run: scene -> cloud -> stencil -> scheme x integrator, advanced in time. */
#ifndef SOLVER_RUN_H
#define SOLVER_RUN_H

#include "solver/cloud.h"
#include "solver/cost.h"
#include "solver/error.h"
#include "solver/scene.h"

#include <stddef.h>

struct solver_run;

/* What the body is doing now. Arrays belong to the run and hold until its next call. [count] particles; tensors
 * row by row; F, H, P and sigma are the in-plane [dim][dim] blocks. */
struct solver_output {
    const struct solver_cloud *cloud; /* without particles of walls */
    double time;                      /* [s] */
    size_t step;
    const double *V;        /* [count] stencil volumes: the weights of every norm and sum */
    const double *u;        /* [count][dim] displacement [m] */
    const double *v;        /* [count][dim] velocity [m/s] */
    const double *p;        /* [count][dim] linear momentum per unit reference volume [kg/(m^2 s)] */
    const double *F;        /* [count][dim*dim] deformation gradient; NULL if the scheme has none, H and P as well */
    const double *H;        /* [count][dim*dim] cofactor (evolved, or that of F) */
    const double *J;        /* [count] Jacobian (evolved, or that of F); without F, rho0 / rho */
    const double *P;        /* [count][dim*dim] first Piola-Kirchhoff stress [Pa] */
    const double *P_normal; /* [count] its component out of the plane or line [Pa]; NULL in 3D too */
    const double *sigma;    /* [count][dim*dim] Cauchy stress [Pa] */
    const double *sigma_normal; /* [count] its component out of the plane or line [Pa]; NULL in 3D */
    const double *pressure;     /* [count] mean Cauchy stress tr(sigma)/3 [Pa], positive in tension as in the papers */
    const double *von_mises;    /* [count] von Mises equivalent of the Cauchy stress [Pa] */
    const double *plastic_strain; /* [count] equivalent plastic strain; NULL where nothing is plastic */
};

/* Conserved quantities at one time; momenta and energies per unit thickness in 2D, per unit area in 1D. */
struct solver_totals {
    double time;            /* [s] */
    double linear[3];       /* linear momentum [kg m/s] */
    double angular[3];      /* angular momentum about the origin [kg m^2/s] */
    double kinetic, strain; /* [J] */
    double plastic;         /* work that plastic flow has taken since the start [J]; 0 where nothing is plastic */
    double external;        /* work of tractions and body forces since the start [J] */
    double iterations;      /* of the pressure since the start; 0 where it is not solved for */
    double volume_change;   /* largest |J - 1| of a particle; 0 where the pressure is not solved for */
    double numerical; /* taken by the scheme's dissipation since the start [J]; 0 unless the scene's balance asks */
    double impact;    /* taken by impacts on the rigid wall since the start [J]; 0 unless the scene's balance asks */
    double wall[3];   /* impulse on the rigid wall since the start [N s]; 0 where there is none */
};

/* Time history: one row per recorded time. */
struct solver_history {
    size_t count;
    struct solver_totals *totals; /* [count] */
    bool flows;                   /* the material flows plastically: totals->plastic tells something */
    bool incompressible;          /* the pressure is solved for: iterations and volume_change tell something */
    bool walled;                  /* there is a rigid wall: totals->wall tells something */
    bool balanced;                /* totals->numerical and impact tell something */
    bool mirrored[3];             /* a plane of symmetry lies across that axis, and takes the momentum along it */
    size_t probe_count;
    char (*probe_name)[64]; /* [probe_count] */
    double (*probe_X)[3];   /* [probe_count] where the probed particle lies [m] */
    double *probe_u;        /* [count][probe_count][3] displacement [m] */
    double *probe_v;        /* [count][probe_count][3] velocity [m/s] */
    /* Of the last row alone: */
    size_t body_count;
    double body_velocity[SOLVER_BODIES][3]; /* [body_count] of the centre of mass [m/s] */
    double contact_begin, contact_end;      /* [s] when bodies first and last pressed each other; NaN: never */
};

/* What a run is made of, for reports. */
struct solver_facts {
    size_t particles, pairs, steps;
    double spacing;            /* [m]; of a graded lattice the mean */
    double finest;             /* [m] the smallest */
    double step;               /* [s] the longest that the CFL number allows now */
    double shorter;            /* how many times shorter it is than the spacing and the fastest wave have it, as
                                  materials meet or particles crowd; 1: not */
    double mass;               /* [kg]; per unit thickness in 2D, per unit area in 1D */
    double setup_seconds;      /* cloud and stencil */
    double seconds;            /* time loop alone */
    double bytes_per_particle; /* all arrays of state, stencil and integrator, over the particle count */
    double state_bytes;        /* fields of the scheme alone, per particle */
    double step_traffic;       /* bytes that one particle's step moves if every array streams once per sweep and
                                  neighbours are found in cache; sweeps of a wave (wave.h) find more there */
    double stencil_residual;   /* largest relative violation of closure and linear exactness; NAN: no stencil */
    int threads;
};

bool solver_run_create(const struct solver_scene *scene, struct solver_run **run, struct solver_error *error);
void solver_run_free(struct solver_run *run);

/* Called now and then with the fraction done; returning false stops the run early, without error. */
typedef bool solver_progress(void *context, double time, double t_end, size_t step);

/* Advances to t_end; SOLVER_BAD_INPUT if that is in the past. On a NaN or an inverted particle (J <= 0) fails with
 * SOLVER_BROKE_DOWN naming step, time, particle, place and field; the output is then the last good state, as it is
 * after a formula that failed. So it fails where there is more energy than can have been put in, with the fastest
 * particle; the output is then that state. */
bool solver_run_to(struct solver_run *run, double t_end, solver_progress *progress, void *context,
                   struct solver_error *error);
/* Exactly `steps` steps of the size the scene's CFL number gives, whatever t_end says. */
bool solver_run_steps(struct solver_run *run, size_t steps, struct solver_error *error);

bool solver_run_output(struct solver_run *run, struct solver_output *output, struct solver_error *error);
const struct solver_history *solver_run_history(const struct solver_run *run);
struct solver_facts solver_run_facts(const struct solver_run *run);
/* All that it has allocated and not released, and all that one of its steps computes. */
void solver_run_cost(const struct solver_run *run, struct solver_cost_arrays *arrays, struct solver_cost_terms *terms);

#endif
