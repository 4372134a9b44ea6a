/* assay cost: what a scene switches on, and what each item costs. */
#include "verify/commands.h"
#include "verify/cost.h"
#include "verify/files.h"
#include "verify/report.h"
#include "verify/signals.h"

int verify_command_cost(const struct verify_options *options)
{
    static struct verify_cost cost; /* large */
    struct solver_error error = {.code = SOLVER_OK};
    bool done = (options->json == NULL || verify_file_check(options->json, &error)) && /* before it takes its time */
                verify_cost_measure(options, &cost, &error);
    if (done) {
        verify_cost_print(&cost);
        done = options->json == NULL || verify_report_write(options->json, verify_cost_json, &cost, &error);
    }
    if (done && cost.stopped != 0) {
        done = solver_fail(&error, SOLVER_STOPPED, "cost: stopped by %s; what is printed%s was measured before",
                           verify_signals_name(cost.stopped), options->json != NULL ? " and written" : "");
    }
    verify_cost_free(&cost);
    return done ? VERIFY_PASSED : verify_complain(&error);
}
