/* CIELAB, the colour space in which distances are near what the eye sees. */
#ifndef RENDER_LAB_H
#define RENDER_LAB_H

#include <stdbool.h>
#include <stdint.h>

/* sRGB bytes -> CIELAB: lab[0] = L* in 0..100, lab[1] = a*, lab[2] = b*; white point D65. IEC 61966-2-1, CIE 15. */
void render_lab_from_rgb(const uint8_t rgb[3], float lab[3]);
/* CIELAB -> sRGB in 0..1. False if the colour lies outside sRGB; rgb is then clamped. */
bool render_lab_to_rgb(const double lab[3], double rgb[3]);
/* Colour difference of CIE 1976: the distance in CIELAB; about 2.3 is just noticeable. */
float render_delta_e(const float one[3], const float other[3]);

#endif
