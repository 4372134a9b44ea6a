#include "render/layout.h"

#include <math.h>

struct render_layout render_layout(int width, int height)
{
    const float w = (float)width, h = (float)height, unit = fminf(w / 800, h / 400);
    const float top = 50 * unit, right = 134 * unit, bottom = 72 * unit, rim = 10 * unit;
    return (struct render_layout){
        .unit = unit,
        .body = {(int)rim, (int)top, (int)(w - right), (int)(h - bottom)},
        .title = {24 * unit, 34 * unit, w - 48 * unit},
        .bar = {w - 112 * unit, 118 * unit, w - 92 * unit, h - 84 * unit},
        .bar_room = 104 * unit,
        .axes = {44 * unit, h - 38 * unit},
    };
}
