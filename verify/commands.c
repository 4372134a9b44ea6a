#include "verify/commands.h"

const char *verify_version(void)
{
    return ASSAY_VERSION;
}

int verify_complain(const struct solver_error *error)
{
    struct solver_error plain = *error; /* words may have been added to its text */
    solver_plain(plain.text, true);
    (void)fflush(stdout);
    (void)fprintf(stderr, "assay: %s\n", plain.text);
    return (int)verify_exit_code(error);
}
