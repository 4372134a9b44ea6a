/* What the loops of upwind.h work on: struct SOLVER_WORK, whose fields are SOLVER_STORED, double or float. Only for
 * upwind.h, which includes it once for each. */

struct SOLVER_WORK {
    /* stencil (stencil.h) */
    const size_t *row;
    const uint32_t *neighbour;
    const double *pair, *transposed, *row_sum, *V;
    const uint32_t *shared; /* NULL: pair and narrow go by pairs */
    const uint8_t *along;   /* [count][LANES] pairs of each row along each axis, in order; NULL: not all lie so */
    const uint8_t *abreast; /* [count] how many particles from each on are abreast (stencil.h); NULL: unknown */
    size_t rank_count;
    const struct solver_rank *rank; /* [rank_count] particles in ranks (stencil_ranks.h); NULL: there are none */
    const float *narrow;            /* in place of pair where the precision is mixed; NULL: it is double */
    double unit;                    /* of narrow, and then of row_sum; else 1 */
    const double *least_squares;    /* NULL: reconstruct with the stencil's own gradient */

    /* What the scene asks for. */
    const struct solver_material *material;
    const struct solver_material_constants *constants; /* [1], or [count] in a composite body */
    size_t stride;                                     /* 0, or 1 in a composite body */
    bool evolves_J;                                    /* {p,F,J} and {p,F,H,J} */
    bool evolves_H;                                    /* {p,F,H,J} */
    bool frozen;      /* linear kinematics: H = I in the equation of J, normals n = N */
    bool whole_jump;  /* dissipation of J by the jump of the whole stress, as printed in eq. 27 */
    bool constrained; /* J stands for the pressure: the Jacobian is that of F */
    bool far;         /* what pairs read of neighbours is more than the processor's own cache holds */
    bool reconstruct; /* linear reconstruction (eq. 34); without it the dissipation is of first order */
    const struct solver_hardening *hardening; /* NULL: nothing is plastic */

    /* State; NULL where the scene does not ask for it. The linear momentum p = rho v is evolved as the velocity, which
     * is continuous where materials meet. */
    SOLVER_STORED *v, *x, *F, *H, *J;                 /* evolved */
    SOLVER_STORED *v_rate, *F_rate, *H_rate, *J_rate; /* that of x is v */
    SOLVER_STORED *X;                 /* reference positions [m]; NULL where only their pair vectors are needed */
    SOLVER_STORED *P;                 /* stress */
    SOLVER_STORED *cofactor;          /* H, or cof F where H is not evolved but the equation of J needs it */
    SOLVER_STORED *v_gradient;        /* tensor: least-squares gradient of v; NULL: F_rate serves */
    SOLVER_STORED *pressure;          /* [count] U'(J); for the dissipation of J by its jump */
    SOLVER_STORED *stiffness;         /* [count] U''(J) / kappa, not below 0; NULL: it is 1 */
    SOLVER_STORED *pressure_gradient; /* vector */
    SOLVER_STORED *P_gradient;        /* [count][DIM (derivative)] tensors; for the dissipation of J by the jump of P */
    double *lost;                 /* [count][2] what dissipation takes, as a power over the linear momentum [W], and the
                                     rate of J times V by it [m^dim/s]; NULL unless asked for */
    double *flown, *flown_before; /* [count][width] what a plastic material remembers (material.h), at the present F,
                                     and at the start of the step */
};
