#include "solver/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

bool solver_fail(struct solver_error *error, enum solver_code code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error->code = code;
    (void)vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    solver_plain(error->text, true); /* lists stand in lines of their own */
    return false;
}

size_t solver_utf8(const char *text)
{
    const unsigned char *c = (const unsigned char *)text;
    if (c[0] < 0x80) {
        return 1;
    }
    size_t length = c[0] >= 0xF0 ? 4 : c[0] >= 0xE0 ? 3 : 2;
    if (c[0] < 0xC2 || c[0] > 0xF4) {
        return 0;
    }
    for (size_t i = 1; i < length; i++) {
        if ((c[i] & 0xC0) != 0x80) { /* as the end of the text is not */
            return 0;
        }
    }
    bool wrong = (c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xED && c[1] > 0x9F) || (c[0] == 0xF0 && c[1] < 0x90) ||
                 (c[0] == 0xF4 && c[1] > 0x8F);
    return wrong ? 0 : length;
}

/* C0, DEL and C1. */
static bool is_control(const unsigned char *c)
{
    return c[0] < ' ' || c[0] == 0x7F || (c[0] == 0xC2 && c[1] < 0xA0);
}

void solver_plain(char *text, bool lines)
{
    for (unsigned char *c = (unsigned char *)text; *c != '\0';) {
        size_t length = is_control(c) ? 0 : solver_utf8((const char *)c);
        if (length == 0 && !(lines && *c == '\n')) {
            *c = strchr("\t\n", *c) != NULL ? ' ' : '?';
        }
        c += length > 0 ? length : 1;
    }
}
