/* Manufactured solutions of a body that flows plastically.
 *
 * Where the deviator of the logarithmic strain keeps its direction in the material and never shrinks, von Mises
 * plasticity with linear hardening is Hencky's theory of total deformation: of the equivalent strain e = q_e/(3 mu),
 * q_e the equivalent stress were the body elastic, the part (3 mu e - Y)/(3 mu + H) has flown, and with r the part of e
 * that has not P = r (P_e - p H) + p H,   p H the volumetric part of the elastic P_e, which does not flow, is a
 * function of F as that of an elastic body. Its divergence takes the elastic tangent A, Div P = r A : grad F + (P_e - p
 * H) grad r + (1 - r) H grad p,   Div H = 0, grad e = (P_e - p H) : grad F / q_e. */
#include "verify/manufactured.h"

#include <math.h>

struct flow {
    double strain;      /* e */
    double part, slope; /* r, and dr/de */
    double pressure;    /* p [Pa] */
};

bool verify_manufactured_flows(const struct verify_manufactured_body *body)
{
    return body->yield > 0;
}

double verify_manufactured_plastic_strain(const struct verify_manufactured_body *body, double strain)
{
    double mu = body->constants.mu;
    return body->yield > 0 ? fmax(0, (3 * mu * strain - body->yield) / (3 * mu + body->hardening)) : 0;
}

/* Equivalent strain of what changes shape alone: of W_e without kappa/2 (ln J)^2. */
double verify_manufactured_strain(const struct verify_manufactured_body *body, const struct verify_measures *of)
{
    double volumetric = 0.5 * body->constants.kappa * log(of->J) * log(of->J);
    double W = body->material->energy(&body->constants, of->F, of->H, of->J);
    return sqrt(fmax(0, 6 * body->constants.mu * (W - volumetric))) / (3 * body->constants.mu);
}

static struct flow flow_at(const struct verify_manufactured_body *body, const struct verify_measures *of)
{
    double strain = verify_manufactured_strain(body, of);
    double flown = verify_manufactured_plastic_strain(body, strain), mu = body->constants.mu;
    double rate = flown > 0 ? 3 * mu / (3 * mu + body->hardening) : 0;
    bool any = flown > 0;
    return (struct flow){.strain = strain,
                         .part = any ? 1 - flown / strain : 1,
                         .slope = any ? (flown / strain - rate) / strain : 0,
                         .pressure = body->constants.kappa * log(of->J) / of->J};
}

double verify_manufactured_energy(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                  double *plastic)
{
    *plastic = 0;
    if (!verify_manufactured_flows(body)) {
        return body->material->energy(&body->constants, of->F, of->H, of->J);
    }
    double mu = body->constants.mu, strain = verify_manufactured_strain(body, of);
    double flown = verify_manufactured_plastic_strain(body, strain), q = 3 * mu * (strain - flown);
    *plastic = body->yield * flown + 0.5 * body->hardening * flown * flown;
    return 0.5 * body->constants.kappa * log(of->J) * log(of->J) + q * q / (6 * mu);
}

void verify_manufactured_stress(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                double *P, double *normal)
{
    int dim = body->of.dim;
    body->material->stress(&body->constants, of->F, of->H, of->J, P);
    *normal = dim < 3 ? body->material->stress_normal(&body->constants, of->F, of->J) : 0;
    if (!verify_manufactured_flows(body)) {
        return;
    }
    struct flow flow = flow_at(body, of);
    for (int i = 0; i < dim * dim; i++) {
        P[i] = flow.part * P[i] + (1 - flow.part) * flow.pressure * of->H[i];
    }
    *normal = flow.part * *normal + (1 - flow.part) * flow.pressure * of->J; /* cof F out of the plane is det F */
}

/* Component I of the gradients of r and p. */
static void gradients(const struct verify_manufactured_body *body, const struct verify_measures *of,
                      const struct flow *flow, const double *P, double dF[3][3][3], int I, double *of_part,
                      double *of_pressure)
{
    int dim = body->of.dim;
    double work = 0, dJ = 0, J = of->J;
    for (int j = 0; j < dim; j++) {
        for (int K = 0; K < dim; K++) {
            double H = of->H[j * dim + K];
            work += (P[j * dim + K] - flow->pressure * H) * dF[j][K][I];
            dJ += H * dF[j][K][I];
        }
    }
    *of_part = flow->part < 1 ? flow->slope * work / (3 * body->constants.mu * flow->strain) : 0;
    *of_pressure = body->constants.kappa * (1 - log(J)) / (J * J) * dJ;
}

void verify_manufactured_divergence(const struct verify_manufactured_body *body, const struct verify_measures *of,
                                    double dF[3][3][3], double divergence[3])
{
    int dim = body->of.dim;
    double A[81], P[9] = {0}, slope_of_part, slope_of_pressure;
    struct flow flow = {.part = 1};
    body->material->tangent(&body->constants, of->F, A);
    if (verify_manufactured_flows(body)) {
        flow = flow_at(body, of);
        body->material->stress(&body->constants, of->F, of->H, of->J, P);
    }
    for (int i = 0; i < dim; i++) {
        divergence[i] = 0;
        for (int I = 0; I < dim; I++) {
            for (int j = 0; j < dim; j++) {
                for (int J = 0; J < dim; J++) {
                    divergence[i] += flow.part * A[((i * dim + I) * dim + j) * dim + J] * dF[j][J][I];
                }
            }
        }
    }
    for (int I = 0; verify_manufactured_flows(body) && I < dim; I++) {
        gradients(body, of, &flow, P, dF, I, &slope_of_part, &slope_of_pressure);
        for (int i = 0; i < dim; i++) {
            double H = of->H[i * dim + I];
            divergence[i] +=
                (P[i * dim + I] - flow.pressure * H) * slope_of_part + (1 - flow.part) * H * slope_of_pressure;
        }
    }
}
