#include "verify/pace.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool read_steps(const char *text, struct verify_pace *pace)
{
    enum { MOST_DIGITS = 15 };
    if (strlen(text) > MOST_DIGITS) {
        return false;
    }
    pace->steps = (size_t)strtoull(text, NULL, 10);
    return pace->steps > 0;
}

bool verify_pace_read(const char *text, struct verify_pace *pace)
{
    static const struct {
        const char *unit;
        double seconds;
    } units[] = {{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}};
    char *end = NULL;
    *pace = (struct verify_pace){.steps = 0};
    if (!isdigit((unsigned char)text[0])) {
        return false;
    }
    if (text[strspn(text, "0123456789")] == '\0') {
        return read_steps(text, pace);
    }
    double number = strtod(text, &end);
    bool decimal = strspn(text, "0123456789.eE+-") >= (size_t)(end - text);
    for (size_t i = 0; decimal && i < sizeof units / sizeof *units; i++) {
        if (strcmp(end, units[i].unit) == 0) {
            pace->seconds = number * units[i].seconds;
        }
    }
    return pace->seconds > 0.0 && isfinite(pace->seconds);
}
