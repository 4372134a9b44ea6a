#include "solver/error.h"

#include <stdarg.h>
#include <stdio.h>

bool solver_fail(struct solver_error *error, enum solver_code code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error->code = code;
    (void)vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}
