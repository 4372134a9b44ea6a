/* XDMF: a small XML text that tells readers without VTKHDF where in the HDF5 file everything lies. */
#include "solver/record_format.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_escaped(FILE *out, const char *text)
{
    for (; *text != '\0'; text++) {
        switch (*text) {
        case '&':
            (void)fputs("&amp;", out);
            break;
        case '<':
            (void)fputs("&lt;", out);
            break;
        case '>':
            (void)fputs("&gt;", out);
            break;
        case '"':
            (void)fputs("&quot;", out);
            break;
        default: /* XML 1.0 knows no other control characters than these, escaped or not */
            (void)fputc((unsigned char)*text < ' ' && *text != '\t' && *text != '\n' ? '?' : *text, out);
        }
    }
}

static void put_item(FILE *out, const char *number, size_t rows, size_t columns, const char *hdf5_name,
                     const char *group, const char *name)
{
    (void)fprintf(out, "        <DataItem Format=\"HDF\" %s Dimensions=\"%zu", number, rows);
    if (columns > 1) {
        (void)fprintf(out, " %zu", columns);
    }
    (void)fputs("\">", out);
    put_escaped(out, hdf5_name);
    (void)fprintf(out, ":%s/", group);
    put_escaped(out, name);
    (void)fputs("</DataItem>\n", out);
}

static const char real[] = "NumberType=\"Float\" Precision=\"8\"";

static void put_field(FILE *out, const struct solver_record_field *field, size_t count, const char *hdf5_name)
{
    const char *shape = field->width == 1 ? "Scalar" : field->width == 3 ? "Vector" : "Tensor";
    (void)fputs("      <Attribute Name=\"", out);
    put_escaped(out, field->name);
    (void)fprintf(out, "\" AttributeType=\"%s\" Center=\"Node\">\n", shape);
    const char *number = strcmp(field->name, "tags") == 0 ? "NumberType=\"UInt\" Precision=\"4\"" : real;
    put_item(out, number, count, (size_t)field->width, hdf5_name, "/VTKHDF/PointData", field->name);
    (void)fputs("      </Attribute>\n", out);
}

static void put_record(FILE *out, const struct solver_record *record, const char *hdf5_name)
{
    const char *topology = record->cell_width == 2   ? "Polyline\" NodesPerElement=\"2"
                           : record->cell_width == 4 ? "Quadrilateral"
                                                     : "Hexahedron";
    (void)fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"2.0\">\n  <Domain>\n    <Grid Name=\"",
                out);
    put_escaped(out, record->scene_name);
    (void)fprintf(out, "\" GridType=\"Uniform\">\n      <Time Value=\"%.17g\"/>\n", record->time);
    (void)fprintf(out, "      <Topology TopologyType=\"%s\" NumberOfElements=\"%zu\">\n", topology, record->cell_count);
    put_item(out, "NumberType=\"Int\" Precision=\"8\"", record->cell_count * (size_t)record->cell_width, 1, hdf5_name,
             "/VTKHDF", "Connectivity");
    (void)fputs("      </Topology>\n      <Geometry GeometryType=\"XYZ\">\n", out);
    put_item(out, real, record->count, 3, hdf5_name, "/VTKHDF", "Points");
    (void)fputs("      </Geometry>\n", out);
    for (size_t i = 0; i < record->field_count; i++) {
        put_field(out, &record->field[i], record->count, hdf5_name);
    }
    (void)fputs("    </Grid>\n  </Domain>\n</Xdmf>\n", out);
}

bool record_to_xdmf(const struct solver_record *record, const char *hdf5_name, char **text, size_t *size,
                    struct solver_error *error)
{
    *text = NULL;
    FILE *out = open_memstream(text, size);
    bool ok = out != NULL;
    if (ok) {
        put_record(out, record, hdf5_name);
        ok = ferror(out) == 0;
        ok = fclose(out) == 0 && ok;
    }
    if (!ok) {
        free(*text);
        *text = NULL;
        return solver_fail(error, SOLVER_NO_MEMORY, "record's XDMF text: no memory");
    }
    return true;
}
