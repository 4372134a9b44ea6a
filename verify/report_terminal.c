#include "verify/report.h"
#include "verify/terminal.h"

#include <math.h>
#include <string.h>

static const char *const evolved_name[] = {
    [SOLVER_PF] = "{p,F}", [SOLVER_PFJ] = "{p,F,J}", [SOLVER_PFHJ] = "{p,F,H,J}"};

static void print_published_head(FILE *file, const struct solver_scene *scene)
{
    if (scene->published_count == 0) {
        return;
    }
    (void)fprintf(file, "published: %s\n", scene->published_source);
    (void)fprintf(file, "  The source does not define its error norm; ours are defined in verify/norms.h. Its figures\n"
                        "  stand beside ours for orientation and decide no gate.\n");
}

/* Where there is no exact solution the indicators are what levels have to show. */
static size_t indicator_columns(const struct verify_study *study)
{
    return study->truth->none ? VERIFY_INDICATORS : 0;
}

/* What the columns of errors hold, and what they are of. */
static void print_columns_meant(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    if (study->beside->scene != NULL) {
        (void)fprintf(file,
                      "\nbeside     %s: run once, the same scene in another configuration, and no exact solution\n",
                      study->beside->label);
    }
    if (shown_count > 0) {
        (void)fprintf(file, "\n%s at t = %.6g s:\n", !study->truth->none ? "errors" : "differences",
                      study->scene->t_end);
    }
    for (size_t i = 0; i < shown_count; i++) {
        (void)fprintf(file, "  %-10s %s [%s]\n", verify_error_name(shown[i]), verify_error_meaning(shown[i]),
                      verify_error_unit(shown[i]));
    }
    if (!study->truth->none) {
        print_published_head(file, study->scene);
    }
}

static void print_head(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    (void)fprintf(file, "\n%5s %10s %9s %6s %8s %10s", "n", "h", "particles", "steps", "time", "ns per");
    for (size_t i = 0; i < shown_count; i++) {
        const char *name = verify_error_name(shown[i]);
        (void)fprintf(file, " | %-*s", verify_width_of(name), name);
        if (verify_error_has_order(shown[i])) {
            (void)fprintf(file, " %5s %10s", "order", "published");
        }
    }
    for (size_t i = 0; i < indicator_columns(study); i++) {
        const char *name = verify_indicator_name(i);
        (void)fprintf(file, " | %-*s", verify_width_of(name), name);
    }
    (void)fprintf(file, "\n%5s %10s %9s %6s %8s %10s", "", "[m]", "", "", "[s]", "part.-step");
    for (size_t i = 0; i < shown_count; i++) {
        const char *unit = verify_error_unit(shown[i]);
        int width = verify_width_of(verify_error_name(shown[i])) + (verify_error_has_order(shown[i]) ? 17 : 0);
        (void)fprintf(file, " | [%s]%*s", unit, width - 2 - (int)strlen(unit), "");
    }
    for (size_t i = 0; i < indicator_columns(study); i++) {
        (void)fprintf(file, " | %-*s", verify_width_of(verify_indicator_name(i)), "[-]");
    }
    (void)fprintf(file, "\n");
    (void)fflush(file);
}

void verify_terminal_begin(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    const struct solver_scene *scene = study->scene;
    (void)fprintf(file, "%s (%s)\n", scene->title, scene->path);
    (void)fprintf(file, "scheme     %s", scene->scheme);
    if (verify_has_stencil(scene)) {
        (void)fprintf(file, " %s, stencil %s", evolved_name[scene->evolved], scene->stencil);
    }
    (void)fprintf(file, ", support %.4g spacings, %s, CFL %.4g, material %s, t_end %.6g s\n", scene->support,
                  scene->integrator, scene->cfl, scene->material_model, scene->t_end);
    verify_print_truth(file, study->truth);
    if (!study->truth->proven) {
        return;
    }
    print_columns_meant(file, study, shown, shown_count);
    print_head(file, study, shown, shown_count);
}

void verify_terminal_level(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    const struct verify_level *level = &study->level[study->level_count - 1];
    char text[32];
    (void)fprintf(file, "%5d %10.4g %9zu %6zu %8.3f %10.1f", level->n, level->facts.spacing, level->facts.particles,
                  level->facts.steps, level->facts.seconds, level->ns_per_particle_step);
    for (size_t i = 0; i < shown_count; i++) {
        const char *name = verify_error_name(shown[i]);
        (void)fprintf(file, " | %-*s", verify_width_of(name), verify_scientific(text, level->error[shown[i]]));
        if (verify_error_has_order(shown[i])) {
            (void)fprintf(file, " %5s", verify_order_text(text, level->rate[shown[i]]));
            (void)fprintf(file, " %10s", verify_scientific(text, verify_published(study->scene, level->n, name)));
        }
    }
    for (size_t i = 0; i < indicator_columns(study); i++) {
        (void)fprintf(file, " | %-*s", verify_width_of(verify_indicator_name(i)),
                      verify_scientific(text, level->indicator[i]));
    }
    (void)fprintf(file, "\n");
    (void)fflush(file);
}

static void print_orders(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    if (study->truth->none) {
        return;
    }
    if (study->level_count < 2) {
        (void)fprintf(file, "\none level only: no order was observed\n");
        return;
    }
    const struct verify_level *fine = &study->level[study->level_count - 1], *coarse = fine - 1;
    (void)fprintf(file, "\nobserved order log(e1/e2)/log(h1/h2) from n = %d to %d:", coarse->n, fine->n);
    for (size_t i = 0; i < shown_count; i++) {
        char text[32];
        const char *name = verify_error_name(shown[i]);
        if (!verify_error_has_order(shown[i])) {
            continue;
        }
        (void)fprintf(file, "%s %s %s", i == 0 ? "" : ",", name, verify_order_text(text, fine->rate[shown[i]]));
        double published = verify_order(verify_published(study->scene, coarse->n, name), 1.0 / coarse->n,
                                        verify_published(study->scene, fine->n, name), 1.0 / fine->n);
        if (!isnan(published)) {
            (void)fprintf(file, " (published %.2f)", published);
        }
    }
    (void)fprintf(file, "\n");
}

/* The errors that have a column of their largest over the snapshots, snapshot by snapshot. */
static void print_snapshots(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    const struct verify_level *level = &study->level[study->level_count - 1];
    size_t of_state[VERIFY_STATE_ERRORS], count = verify_shown_snapshots(shown, shown_count, of_state);
    if (count == 0) {
        return;
    }
    (void)fprintf(file, "\nsnapshots at the finest level:\n  %12s", "t [s]");
    for (size_t i = 0; i < count; i++) {
        (void)fprintf(file, " %12s", verify_error_name(of_state[i]));
    }
    for (size_t i = 0; i < level->snapshot_count; i++) {
        (void)fprintf(file, "\n  %12.6g", level->snapshot[i].time);
        for (size_t j = 0; j < count; j++) {
            char text[32];
            (void)fprintf(file, " %12s", verify_scientific(text, level->snapshot[i].error[of_state[j]]));
        }
    }
    (void)fprintf(file, "\n");
}

const char *verify_residual(char text[VERIFY_RESIDUAL], const struct solver_facts *facts)
{
    text[0] = '\0';
    if (!isnan(facts->stencil_residual)) {
        (void)snprintf(text, VERIFY_RESIDUAL, ", stencil residual %.2e [-]", facts->stencil_residual);
    }
    return text;
}

static void print_figures(FILE *file, const struct verify_study *study)
{
    const struct verify_level *finest = &study->level[study->level_count - 1];
    for (size_t i = 0; i < study->scene->figure_count; i++) {
        const struct verify_figure *figure = &finest->figure[i];
        char error[32], rate[32];
        if (i == 0) {
            (void)fprintf(file, "\n  %-24s %16s %16s %-8s %10s %6s\n", "figure, finest level", "measured", "expected",
                          "unit", "error", "order");
        }
        (void)fprintf(file, "  %-24s %16.9g %16.9g %-8s %10s %6s\n", study->scene->figure[i].name, figure->measured,
                      figure->exact, figure->unit, verify_scientific(error, figure->error),
                      verify_order_text(rate, figure->rate));
        if (figure->why[0] != '\0') {
            (void)fprintf(file, "    %s: not measured: %s\n", study->scene->figure[i].name, figure->why);
        }
    }
    if (study->scene->figure_count > 0) {
        (void)fprintf(file, "  error: |measured / expected - 1|, or |measured|, in its unit, where 0 is expected\n");
    }
}

static void print_facts(FILE *file, const struct verify_study *study)
{
    const struct solver_facts *facts = &study->level[study->level_count - 1].facts;
    char residual[VERIFY_RESIDUAL];
    (void)fprintf(file,
                  "\nfinest level: %zu pairs (%.1f per particle), %.0f bytes per particle (%.0f of them fields of the "
                  "scheme),\n  set up in %.2f s, %d thread%s%s\n",
                  facts->pairs, (double)facts->pairs / (double)facts->particles, facts->bytes_per_particle,
                  facts->state_bytes, facts->setup_seconds, facts->threads, facts->threads == 1 ? "" : "s",
                  verify_residual(residual, facts));
    double kinetic = NAN, strain = NAN;
    verify_truth_energy(study->truth, study->scene, study->last.time, &kinetic, &strain);
    if (isnan(kinetic) && isnan(strain)) {
        (void)fprintf(file, "  energy at the end: kinetic %.6g J, strain %.6g J\n", study->last.kinetic,
                      study->last.strain);
        return;
    }
    (void)fprintf(file, "  energy at the end: kinetic %.6g J (exact %.6g J), strain %.6g J (exact %.6g J)\n",
                  study->last.kinetic, kinetic, study->last.strain, strain);
}

static void print_gates(FILE *file, const struct verify_study *study)
{
    if (study->gates.count == 0) {
        (void)fprintf(file, "\nNOT JUDGED: no gate of the scene holds for this configuration, so nothing above was "
                            "tested against a bound.\n");
        return;
    }
    const struct solver_scene *scene = study->scene;
    int n = study->level[study->level_count - 1].n;
    if (scene->level_count > 0 && n != scene->levels[scene->level_count - 1]) {
        (void)fprintf(file, "\nThe scene's bounds are meant for n = %d; the finest level here is n = %d.\n",
                      scene->levels[scene->level_count - 1], n);
    }
    verify_print_gates(file, &study->gates);
    (void)fprintf(file, "%s\n", verify_verdict(study));
}

void verify_terminal_end(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count)
{
    print_orders(file, study, shown, shown_count);
    verify_terminal_convergence(file, study, shown, shown_count);
    print_snapshots(file, study, shown, shown_count);
    print_figures(file, study);
    verify_terminal_extrapolation(file, study);
    print_facts(file, study);
    verify_terminal_indicators(file, study->level[study->level_count - 1].indicator);
    print_gates(file, study);
}

static void print_vector(FILE *file, const char *name, const double first[3], const double last[3], const char *unit)
{
    (void)fprintf(file, "  %-18s (%.6e, %.6e, %.6e) -> (%.6e, %.6e, %.6e) %s\n", name, first[0], first[1], first[2],
                  last[0], last[1], last[2], unit);
}

void verify_terminal_totals(FILE *file, const struct solver_scene *scene, const struct solver_totals *first,
                            const struct solver_totals *last)
{
    (void)fprintf(file, "conserved quantities, t = %.6g s -> t = %.6g s\n", first->time, last->time);
    print_vector(file, "linear momentum", first->linear, last->linear, "kg m/s");
    print_vector(file, "angular momentum", first->angular, last->angular, "kg m^2/s");
    (void)fprintf(file, "  %-18s %.9e -> %.9e J\n", "kinetic energy", first->kinetic, last->kinetic);
    (void)fprintf(file, "  %-18s %.9e -> %.9e J\n", "strain energy", first->strain, last->strain);
    (void)fprintf(file, "  %-18s %.9e J\n", "external work", last->external - first->external);
    if (!verify_supply_is_known(scene)) {
        (void)fprintf(file, "  %-18s not known: what moved faces put in is not measured\n", "energy gained");
        return;
    }
    double work = last->external - first->external, before = first->kinetic + first->strain;
    double gained = last->kinetic + last->strain - before - work;
    double scale = fmax(before, fabs(work));
    (void)fprintf(file, "  %-18s %.3e J (%.3e of the energy put in; dissipation where negative)\n", "energy gained",
                  gained, scale > 0 ? gained / scale : NAN);
    if (!(gained <= 0.01 * scale)) {
        (void)fprintf(file, "  WARNING: the energy grew out of nothing by more than 1 %%: the run is not stable\n");
    }
}

void verify_terminal_indicators(FILE *file, const double value[VERIFY_INDICATORS])
{
    (void)fprintf(file, "indicators\n");
    for (size_t i = 0; i < VERIFY_INDICATORS; i++) {
        char text[32];
        (void)fprintf(file, "  %-18s %10s  %s\n", verify_indicator_name(i), verify_scientific(text, value[i]),
                      verify_indicator_meaning(i));
    }
}
