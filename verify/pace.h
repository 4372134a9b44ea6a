/* How often: every so many steps, or every so much time. */
#ifndef VERIFY_PACE_H
#define VERIFY_PACE_H

#include <stdbool.h>
#include <stddef.h>

/* Both 0: never. */
struct verify_pace {
    size_t steps;
    double seconds;
};

/* "500": steps, a whole number above 0. "30s", "10min", "2h": a time above 0. False for anything else. */
bool verify_pace_read(const char *text, struct verify_pace *pace);

#endif
