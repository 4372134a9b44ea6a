#include "verify/measures.h"

#include <string.h>

static const struct verify_measure measures[] = {
    {.name = "stress ratio",
     .help = "peak stress in the window `of` over that in the window `over`",
     .option = {{"of", VERIFY_WINDOW}, {"over", VERIFY_WINDOW}},
     .in_1d_only = true,
     .lacks = "the largest stress of a window lies at its end, so that no peak is within; move the window, or take a "
              "larger n",
     .measure = verify_stress_ratio},
    {.name = "stress ahead",
     .help = "largest stress, over the exact peak and in all snapshots, farther ahead of the fronts than `beyond`",
     .option = {{"beyond", VERIFY_LENGTH}},
     .in_1d_only = true,
     .none_is_exact = true,
     .needs_fronts = true,
     .lacks = "in no snapshot is a particle so far ahead of the fronts; take other snapshots, a smaller `beyond` or a "
              "larger n",
     .measure = verify_stress_ahead},
    {.name = "period",
     .help = "of a probe's displacement, by a fit of a damped oscillation that crosses its middle three times or more",
     .option = {{"probe", VERIFY_PROBE}},
     .lacks = "the probe does not vibrate",
     .measure = verify_period},
    {.name = "fundamental period",
     .help =
         "of a probe's displacement, by the same fit, beside the `expected` one, of a theory that is no oracle here",
     .option = {{"expected", VERIFY_NUMBER}, {"probe", VERIFY_PROBE}},
     .expected = true,
     .unit = "s",
     .lacks = "the probe does not vibrate",
     .measure = verify_fundamental_period},
    {.name = "drift",
     .help = "largest distance of a probe, over time, from the line along the axis `across` on which it lay",
     .option = {{"probe", VERIFY_PROBE}, {"across", VERIFY_AXIS}},
     .none_is_exact = true,
     .unit = "m",
     .lacks = "the probe's motion is no number",
     .measure = verify_drift},
    {.name = "distance",
     .help = "between two probes at t_end, beside the one that is `expected`",
     .option = {{"expected", VERIFY_LENGTH}, {"from", VERIFY_PROBE}, {"to", VERIFY_PROBE}},
     .expected = true,
     .unit = "m",
     .lacks = "the probe's motion is no number",
     .measure = verify_distance},
    {.name = "energy lost",
     .help = "what of the energy there was, and of the work of loads, neither is there at t_end nor flowed, over the "
             "former",
     .none_is_exact = true,
     .lacks = "there was no energy at the start",
     .measure = verify_energy_lost},
    {.name = "energy rise",
     .help = "largest rise of the energy, less the work of loads, above what it was before, over the most there was",
     .none_is_exact = true,
     .lacks = "there was no energy",
     .measure = verify_energy_rise},
    {.name = "volume change",
     .help = "largest |J - 1| of a particle, over time, where the pressure is solved for",
     .none_is_exact = true,
     .lacks = "the pressure is not solved for; set incompressible.solver",
     .measure = verify_volume_change},
    {.name = "iterations",
     .help = "of the pressure per step, where it is solved for",
     .none_is_exact = true,
     .lacks = "the pressure is not solved for; set incompressible.solver",
     .measure = verify_iterations},
    {.name = "plastic strain",
     .help = "at t_end, mean over ten places from the place `from` to the place `to`, beside the `expected` one",
     .option = {{"expected", VERIFY_NUMBER}, {"from", VERIFY_PLACE}, {"to", VERIFY_PLACE}},
     .expected = true,
     .flow = true,
     .unit = "-",
     .lacks = "no particle is near one of the ten places; where has the body gone?",
     .measure = verify_plastic_section},
    {.name = "largest plastic strain",
     .help = "of all particles at t_end, beside the `expected` one",
     .option = {{"expected", VERIFY_NUMBER}},
     .expected = true,
     .flow = true,
     .unit = "-",
     .lacks = "a plastic strain is no number",
     .measure = verify_plastic_most},
    {.name = "plastic work",
     .help = "at t_end, beside the `expected` one",
     .option = {{"expected", VERIFY_NUMBER}},
     .expected = true,
     .flow = true,
     .unit = "J",
     .lacks = "the plastic work is no number",
     .measure = verify_plastic_work},
    {.name = "ram loss",
     .help = "work of a ram that moves at `speed` along the axis `along` that went nowhere, over the plastic work",
     .option = {{"along", VERIFY_AXIS}, {"speed", VERIFY_NUMBER}},
     .none_is_exact = true,
     .flow = true,
     .lacks = "nothing has flowed",
     .measure = verify_ram_loss},
    {.name = "energy balance",
     .help = "largest gap of kinetic, strain and plastic energy, numerical dissipation and what impacts take, less the "
             "work "
             "of loads, over the energy there was; needs balance = true",
     .none_is_exact = true,
     .lacks = "there was no energy",
     .measure = verify_energy_balance},
    {.name = "numerical dissipation",
     .help = "share of the energy there was that the scheme's dissipation takes; needs balance = true",
     .none_is_exact = true,
     .lacks = "there was no energy",
     .measure = verify_numerical_dissipation},
    {.name = "impact loss",
     .help = "share of the energy there was that impacts on the rigid wall take; needs balance = true",
     .none_is_exact = true,
     .lacks = "there was no energy",
     .measure = verify_impact_loss},
    {.name = "contact time",
     .help = "from the first moment at which bodies press each other to the last",
     .lacks = "no bodies pressed each other; set t_end higher",
     .measure = verify_contact_time},
    {.name = "body velocity",
     .help = "of a body's centre of mass at t_end, along x",
     .option = {{"body", VERIFY_BODY}},
     .lacks = "the velocity is no number",
     .measure = verify_body_velocity},
    {.name = NULL},
};

const struct verify_measure *verify_measures(void)
{
    return measures;
}

const struct verify_measure *verify_measure_find(const char *name)
{
    for (const struct verify_measure *measure = measures; measure->name != NULL; measure++) {
        if (strcmp(measure->name, name) == 0) {
            return measure;
        }
    }
    return NULL;
}

const char *verify_option_spelling(enum verify_option kind)
{
    return kind == VERIFY_WINDOW   ? "{ t [s], X0 [m], X1 [m] }, t being one of the snapshots"
           : kind == VERIFY_BODY   ? "{ k }, the k-th of the bodies"
           : kind == VERIFY_LENGTH ? "{ d }, a length [m]"
           : kind == VERIFY_AXIS   ? "{ k }, the k-th of the axes"
           : kind == VERIFY_NUMBER ? "{ value }, a number"
           : kind == VERIFY_PLACE  ? "{ x, y }, as many numbers as dimensions [m]"
                                   : "the name of a probe";
}
