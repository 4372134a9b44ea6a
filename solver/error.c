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

/* Bytes of the character that begins here, none of them a control character; 0 if it is no such character. */
static size_t printable(const unsigned char *c)
{
    size_t length = c[0] < 0x80 ? 1 : c[0] >= 0xC2 && c[0] < 0xE0 ? 2 : c[0] >= 0xE0 && c[0] < 0xF0 ? 3 : 4;
    bool control = c[0] < ' ' || c[0] == 0x7F || (c[0] == 0xC2 && c[1] < 0xA0); /* C0, DEL, C1 */
    bool begins = c[0] < 0x80 || (c[0] >= 0xC2 && c[0] < 0xF5);
    for (size_t i = 1; begins && i < length; i++) {
        begins = (c[i] & 0xC0) == 0x80; /* the end of the text does not */
    }
    return begins && !control ? length : 0;
}

void solver_plain(char *text, bool lines)
{
    for (unsigned char *c = (unsigned char *)text; *c != '\0';) {
        size_t length = printable(c);
        if (length == 0 && !(lines && *c == '\n')) {
            *c = strchr("\t\n", *c) != NULL ? ' ' : '?';
        }
        c += length > 0 ? length : 1;
    }
}
