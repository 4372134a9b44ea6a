/* `assay verify --mutations`: what is told wrongly on purpose, and which gate noticed. */
#include "verify/commands.h"
#include "verify/find.h"
#include "verify/manufactured.h"
#include "verify/mutations.h"

#include <math.h>
#include <stdio.h>

static void print_row(void *context, const struct verify_mutation *mutation)
{
    (void)context;
    const char *caught = mutation->caught[0] != '\0' ? mutation->caught
                         : mutation->control         ? "nothing, as it should"
                                                     : "NOTHING";
    (void)printf("%-5s %-48.48s %-42.42s %-60.60s", verify_mutation_missed(mutation) ? "FAIL" : "ok", mutation->what,
                 mutation->where, caught);
    if (!isnan(mutation->bound)) {
        (void)printf(" %9.2e, bound %.2e [-]", mutation->value, mutation->bound);
    }
    (void)printf("\n");
    (void)fflush(stdout);
}

int verify_command_mutations(const struct verify_options *options)
{
    (void)options;
    struct solver_error error = {.code = SOLVER_OK};
    char path[VERIFY_PATH];
    size_t count = 0, missed = 0;
    (void)printf("%-5s %-48s %-42s %s\n", "", "what is wrong", "with what", "noticed by");
    (void)verify_manufactured_find("", "", 0); /* sets up the table, which is not for several threads at a time */
    if (!verify_scene_find("manufactured", path, &error) ||
        !verify_mutations(path, print_row, NULL, &count, &missed, &error)) {
        return verify_complain(&error);
    }
    (void)printf("\n%zu mutations, %zu failures\n", count, missed);
    (void)printf(missed == 0 ? "PASS: every mutation is noticed, and nothing else is\n"
                             : "FAIL: a mutation is not noticed, or what is right is\n");
    return missed == 0 ? VERIFY_PASSED : VERIFY_FAILED;
}
