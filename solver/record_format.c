#include "solver/record_format.h"

#include <stdio.h>
#include <string.h>

const struct record_known record_known[] = {
    {"F", 9, false},
    {"H", 9, false},
    {"J", 1, true},
    {"P", 9, false},
    {"sigma", 9, false},
    {"displacement", 3, true},
    {"momentum", 3, true},
    {"pressure", 1, true},
    {"tags", 1, true},
    {"velocity", 3, true},
    {"volume", 1, true},
    {"von_mises", 1, true},
    {"plastic_strain", 1, false},
    {NULL, 0, false},
};

uint8_t record_vtk_type(int cell_width)
{
    enum { VTK_LINE = 3, VTK_QUAD = 9, VTK_HEXAHEDRON = 12 };
    return cell_width == 2 ? VTK_LINE : cell_width == 4 ? VTK_QUAD : VTK_HEXAHEDRON;
}

struct record_quiet record_quiet_begin(void)
{
    struct record_quiet before = {0};
    (void)H5Eget_auto2(H5E_DEFAULT, &before.print, &before.context);
    (void)H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    return before;
}

void record_quiet_end(struct record_quiet before)
{
    (void)H5Eset_auto2(H5E_DEFAULT, before.print, before.context);
}

struct reason {
    char *text;
    size_t size;
};

static herr_t take_innermost(unsigned n, const H5E_error2_t *step, void *context)
{
    struct reason *reason = context;
    if (n == 0 && step->desc != NULL) {
        (void)snprintf(reason->text, reason->size, "%s", step->desc);
    }
    return 0;
}

void record_hdf5_reason(char *text, size_t size)
{
    struct reason reason = {text, size};
    (void)snprintf(text, size, "no reason given");
    (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &reason);
}
