/* From a record to its picture: record -> surface -> render. */
#ifndef VERIFY_PICTURE_H
#define VERIFY_PICTURE_H

#include "oracles/oracle.h"
#include "render/render.h"
#include "solver/record.h"

/* Draws a record as `view` says (NULL: the pressure, seen from a corner), completed as verify_picture_view does. The
 * frame is the reference body's bounding box, grown in steps until the deformed body fits, so that it hardly ever
 * moves. Errors name the field that the record lacks. */
bool verify_picture_draw(const struct solver_record *record, const struct solver_view *view, const char *title,
                         struct render_image **image, struct solver_error *error);
/* What a picture of the record is drawn by: `view`, with a colour range and bands where it leaves them open. So two
 * records can have one scale. */
bool verify_picture_view(const struct solver_record *record, const struct solver_view *view, struct solver_view *whole,
                         struct solver_error *error);
/* A range, where it is {0, 0}, and bands, where they are 0: round numbers, of a range that holds the values seen. */
void verify_picture_scale(const double seen[2], double range[2], int *bands);
/* Whether the records of a scene will have the field that its view names: what is wrong is said before a run, not
 * after it. */
bool verify_picture_check(const struct solver_scene *scene, struct solver_error *error);
/* Draws and writes a PNG. If that fails the error says where the record is kept, unless `kept` is NULL. */
bool verify_picture_write(const char *path, const struct solver_record *record, const struct solver_view *view,
                          const char *title, const char *kept, struct solver_error *error);

/* Replaces the fields of a record that an oracle knows by the exact ones at the record's time, and removes the
 * others. */
void verify_picture_exact(struct solver_record *record, const struct oracle_kind *kind, const struct oracle *oracle);

/* Faces of a mesh that belong to one cell alone: the surface of the body. Cells of 2, 4 or 8 vertices (VTK's line, quad
 * and hexahedron) in three, two or one dimension; in 2D the cells themselves, in 1D each as {a, b, b, b}. Gives
 * (*quad)[*count][4], freed by the caller; false if there is no memory. */
bool verify_surface(const uint32_t *cell, size_t cell_count, int cell_width, uint32_t (**quad)[4], size_t *count);

#endif
