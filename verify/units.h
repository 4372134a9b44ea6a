/* Units of numbers that come from elsewhere. */
#ifndef VERIFY_UNITS_H
#define VERIFY_UNITS_H

#include <stdbool.h>

/* The factor that turns numbers in `given` into numbers in `wanted` (an SI unit as this program spells it: "m",
 * "kg/(m^2 s)", "-"). The two must be the same but for the spelling ("N/m^2" for "Pa") and for a prefix from n to T
 * before the first symbol ("MPa", "mm/s"). False if they are not. */
bool verify_unit_factor(const char *given, const char *wanted, double *factor);

/* Splits "1.5 ms" or "u_x[mm]" in place, "u_x [mm]" too: the unit's text is cut off and returned; NULL if there is
 * none. */
char *verify_unit_split(char *text);

#endif
