/* Lettering in the stroke font of glyphs.h. `^` before a sign or digits raises them: "10^-3", "m^2". */
#ifndef RENDER_TEXT_H
#define RENDER_TEXT_H

#include "render/paint.h"

/* Width of a line of UTF-8 text with capitals `size` pixels high. */
float render_text_width(const char *text, float size);
/* Draws a line of text from x on, its baseline at y. Characters that the font does not have, and bytes that are not
 * UTF-8, show as hollow boxes. */
void render_text(struct render_paint *paint, float x, float y, float size, struct render_ink ink, const char *text);
/* The same, made smaller where it is wider than `room`, and ended by "..." where even that does not do. */
void render_text_fit(struct render_paint *paint, float x, float y, float size, float room, struct render_ink ink,
                     const char *text);

#endif
