#include "solver/upwind_flops.h"

struct term {
    const char *name;
    bool asked;
    double per_pair, per_particle;
};

double solver_upwind_flops(const struct solver_upwind *work, int dim, size_t count, size_t pairs)
{
    double d = dim;
    double dot = 2.0 * d - 1.0;
    double tensor = d * d;
    double cross = dim == 3 ? 3.0 * (2.0 * 9.0 + 3.0) : 0.0; /* tensor_cross, cofactor twice that of one cross */
    bool slopes = work->reconstruct;
    const struct term terms[] = {
        /* gradients */
        {"gradient of v", true, d + 2.0 * tensor, 1.0 + tensor},
        {"gradient of v, least squares", work->v_gradient != NULL, d + 2.0 * tensor, 0.0},
        {"gradient of U'(J)", work->pressure_gradient != NULL, 1.0 + 2.0 * d, d},
        /* rates */
        {"force", true, 2.0 * tensor, 2.0 * tensor + d + 4.0},
        {"distance and jump of v", true, work->frozen ? 2.0 * d : 3.0 * d, 0.0},
        {"reconstruction of v", slopes, 3.0 * tensor + d, 0.0},
        {"flux of p", true, 2.0 * dot + 2.0 + 6.0 * d, d},
        {"impedances where materials meet", work->stride != 0, 8.0, 0.0},
        {"area", work->evolves_J && !work->frozen, d + 3.0 * tensor, 0.0},
        {"flux of J", work->evolves_J, 3.0 * dot + 7.0, 3.0},
        {"reconstruction of U'(J)", work->evolves_J && slopes, d + dot + 2.0, 0.0},
        {"rate of J", work->evolves_J, 0.0, work->frozen ? d : 2.0 * tensor},
        {"rate of H", work->evolves_H, 0.0, work->frozen ? tensor : cross},
        /* stresses */
        {"cofactor", work->cofactor != NULL && !work->evolves_H, 0.0, cross / 2.0},
        {"pressure", work->pressure != NULL, 0.0, 2.0},
        {"stress", true, 0.0, work->frozen ? 3.0 * d + tensor : 5.0 * tensor + cross / 2.0 + 40.0},
    };
    double sum = 0.0;
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) {
        sum += terms[i].asked ? terms[i].per_pair * (double)pairs + terms[i].per_particle * (double)count : 0.0;
    }
    bool counted = work->flown == NULL && work->P_gradient == NULL; /* else return maps, a third-order slope */
    return counted ? sum : 0.0;
}
