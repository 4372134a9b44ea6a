/* Errors are values: every call of the solver that can fail returns false and says why in a solver_error. */
#ifndef SOLVER_ERROR_H
#define SOLVER_ERROR_H

#include <stdbool.h>
#include <stddef.h>

enum solver_code {
    SOLVER_OK = 0,
    SOLVER_BAD_INPUT,  /* scene, command line or file is wrong: the user can mend it */
    SOLVER_NO_MEMORY,  /* an allocation failed; the text says how much was asked for */
    SOLVER_IO,         /* a file could not be read or written */
    SOLVER_BROKE_DOWN, /* the run itself failed: NaN, inverted particle, no convergence */
    SOLVER_STOPPED     /* nothing failed: whoever calls was asked to end */
};

struct solver_error {
    enum solver_code code;
    char text[1024]; /* what, where, what was expected; no trailing newline */
};

/* Fills *error and returns false, so that a caller can write `return solver_fail(...)`. The text is plain. */
bool solver_fail(struct solver_error *error, enum solver_code code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Makes text plain in place, since it may hold what stood in a file: control characters, with which a terminal can be
 * driven, become '?', as does what is no UTF-8, and tabs become blanks, as do ends of lines where `lines` does not let
 * them stay. */
void solver_plain(char *text, bool lines);
/* Bytes of the character of UTF-8 that begins at `text`, which ends with a zero; 0 if none does: cut short, longer
 * than need be, half of a surrogate pair or beyond U+10FFFF (RFC 3629, section 4). */
size_t solver_utf8(const char *text);

#endif
