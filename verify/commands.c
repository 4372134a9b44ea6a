#include "verify/commands.h"

const char *verify_version(void)
{
    return ASSAY_VERSION;
}

int verify_complain(const struct solver_error *error)
{
    (void)fflush(stdout);
    (void)fprintf(stderr, "assay: %s\n", error->text);
    return (int)verify_exit_code(error);
}
