/* What the tests of paths (solver/path.h) share: a short run on one of them, and how far two are apart by the bounds of
 * golden records. */
#ifndef TESTS_PATHS_H
#define TESTS_PATHS_H

#include "golden/golden.h"
#include "solver/path.h"
#include "solver/record.h"
#include "tests/unit/runs.h"

/* The record after twelve steps of a lattice, or more of a cloud, whose velocities are `size`; strains are of its
 * order. */
static inline struct solver_record *run_on(int path, double size, const char *settings)
{
    static const char scene[] = "faces = { X0 = 'symmetric' }\n"
                                "initial = { velocity = function(X, Y, Z)\n"
                                "    local v = %g\n"
                                "    return first(2 * v * sin(2 * X + Y), v * cos(3 * Y - X + Z), v * sin(2 * Z + X)) "
                                "end }\n";
    char sized[sizeof scene + 32];
    (void)snprintf(sized, sizeof sized, scene, size);
    solver_path_use(path);
    struct sample sample = start(sized, "%s", settings);
    struct solver_record *record = NULL;
    advance_to(&sample, 12.0 * sample.scene->cfl * solver_run_facts(sample.run).spacing / wave_speed(&sample));
    struct solver_output output = output_of(&sample);
    CU_ASSERT_FATAL(
        solver_record_make(sample.scene, &output, solver_run_history(sample.run), "", "", &record, &sample.error));
    finish(&sample);
    return record;
}

/* The largest difference over its bound: above 1 if a line fails. */
static inline double share_of_bounds(const struct solver_record *stored, struct solver_record *fresh)
{
    struct golden_report report;
    struct solver_error error;
    double worst = 0.0;
    memcpy(fresh->scene_name, stored->scene_name, strlen(fresh->scene_name)); /* that of a temporary file */
    CU_ASSERT_FATAL(golden_compare(stored, fresh, &report, &error));
    for (size_t i = 0; i < report.count; i++) {
        const struct golden_line *line = &report.line[i];
        worst = fmax(worst, line->difference > 0.0 ? line->difference / line->bound : 0.0);
    }
    CU_ASSERT_EQUAL(report.pass, worst <= 1.0);
    golden_report_free(&report);
    return worst;
}

#endif
