/* What a study found, for people (terminal, HTML) and for programs (JSON). */
#ifndef VERIFY_REPORT_H
#define VERIFY_REPORT_H

#include "verify/study.h"

#include <stdio.h>

/* Terminal: what is about to be done, then one row per level as it finishes, then orders, energies, gates and files.
 * `shown` lists the errors that get columns (verify_shown). */
void verify_terminal_begin(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count);
void verify_terminal_level(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count);
void verify_terminal_end(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count);
/* What stands in the oracle's place where a scene answers to none. */
extern const char verify_no_oracle[];
/* ", stencil residual 1.2e-15 [-]", or nothing where there is no stencil. */
enum { VERIFY_RESIDUAL = 48 };
const char *verify_residual(char text[VERIFY_RESIDUAL], const struct solver_facts *facts);
/* Conserved quantities at the start and the end of a run of this scene. */
void verify_terminal_totals(FILE *file, const struct solver_scene *scene, const struct solver_totals *first,
                            const struct solver_totals *last);

/* What they and the particles say of the run, indicator by indicator. */
void verify_terminal_indicators(FILE *file, const double value[VERIFY_INDICATORS]);

/* Orders of the last two pairs of levels and figures extrapolated (grid_convergence.h), where there are three levels;
 * in JSON as the member "convergence", empty with fewer. */
void verify_terminal_convergence(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count);
void verify_terminal_extrapolation(FILE *file, const struct verify_study *study);
void verify_html_convergence(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count);
void verify_html_extrapolation(FILE *file, const struct verify_study *study);
void verify_json_convergence(FILE *file, const struct verify_study *study);

/* JSON, in the one shape that --json always has; numbers that are not finite are null. Where no gate holds for the
 * configuration "pass" is null: nothing was judged. */
void verify_json(FILE *file, const struct verify_study *study);

/* Builds a report in memory by `write` and writes it whole. */
typedef bool verify_writer(FILE *file, const void *context, struct solver_error *error);
bool verify_report_write(const char *path, verify_writer *write, const void *context, struct solver_error *error);

/* A self-contained HTML page: tables, convergence plot, pictures. */
bool verify_html(FILE *file, const struct verify_study *study, const size_t *shown, size_t shown_count,
                 struct solver_error *error);
/* The convergence plot of one error as an SVG element: measured and published values over the spacing, both axes
 * logarithmic, with lines of whole orders for comparison. */
void verify_plot(FILE *file, const struct verify_study *study, size_t error);
/* The same of any errors: `count` of them over their spacings, and published ones where there are some. */
struct verify_errors {
    const char *name, *unit;
    size_t count, published_count;
    double h[SOLVER_LEVELS], e[SOLVER_LEVELS];
    double published_h[SOLVER_ROWS], published_e[SOLVER_ROWS];
};
void verify_plot_errors(FILE *file, const struct verify_errors *errors);
/* The displacement of a probe over time as an SVG element, computed over exact. */
void verify_plot_trace(FILE *file, const struct verify_study *study, const struct verify_trace *trace);
/* One component of a probe's displacement over time, at the finest level and in the configuration beside. */
void verify_plot_beside(FILE *file, const struct verify_study *study, size_t probe, size_t axis);
/* Kinetic, strain and total energy over time at the finest level, computed over exact. */
bool verify_plot_energy(FILE *file, const struct verify_study *study, struct solver_error *error);
/* The stress along a one-dimensional body at the snapshots, with its heading; nothing where there is none. */
bool verify_plot_profiles(FILE *file, const struct verify_study *study, struct solver_error *error);

#endif
