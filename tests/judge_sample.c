/* Stands in for somebody's solver: writes results for the swinging cube at 2, 4 and 8 spacings into a folder, each as
 * HDF5, VTKHDF, VTU and table. Of three kinds: "right", whose errors are of second order; "offset", with a stress that
 * is 1 % too large besides; "lost", whose errors are of first order and so small that only the order tells. */
#include "oracles/oracle.h"
#include "verify/sample_write.h"

#include <hdf5.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIELDS = 3 };
static const double TIME = 2e-3;

static const struct {
    const char *name, *unit;
    int width;
    enum verify_columns columns;
} fields[FIELDS] = {
    {"u", "m", 3, VERIFY_BY_AXIS}, {"p", "kg/(m^2 s)", 3, VERIFY_BY_AXIS}, {"P", "Pa", 9, VERIFY_BY_PAIR}};

static _Noreturn void give_up(const char *why)
{
    (void)fprintf(stderr, "judge_sample: %s\n", why);
    exit(1);
}

static struct oracle *typical(const struct oracle_kind *kind)
{
    double value[ORACLE_PARAMETERS];
    char why[ORACLE_WHY] = "";
    struct oracle *oracle = NULL;
    for (size_t i = 0; kind->parameter[i].name != NULL; i++) {
        value[i] = kind->parameter[i].typical;
    }
    if (!oracle_create(kind, value, &oracle, why)) {
        give_up(why);
    }
    return oracle;
}

/* Points of the lattice with the weights of the trapezium rule. */
static void place(struct verify_sample *sample, int n)
{
    for (size_t a = 0; a < sample->count; a++) {
        size_t at = a;
        sample->weight[a] = 1;
        for (size_t i = 0; i < 3; i++) {
            size_t k = at % ((size_t)n + 1);
            at /= (size_t)n + 1;
            sample->X[3 * a + i] = (double)k / n;
            sample->weight[a] *= (k == 0 || k == (size_t)n ? 0.5 : 1.0) / n;
        }
    }
}

/* Exact values with the errors of the kind. */
static void fill(struct verify_sample *sample, const char *kind, int n)
{
    const struct oracle_kind *cube = oracle_find("swinging-cube");
    struct oracle *oracle = typical(cube);
    double h = 1.0 / n, error = strcmp(kind, "lost") == 0 ? 0.02 * h : 0.3 * h * h;
    double stress = strcmp(kind, "offset") == 0 ? 1.01 : 1;
    for (size_t a = 0; a < sample->count; a++) {
        struct oracle_state state;
        double factor = 1 + error * cos(3 * sample->X[3 * a]);
        cube->state(oracle, sample->X + 3 * a, TIME, &state);
        for (size_t i = 0; i < 9; i++) {
            if (i < 3) {
                sample->field[0].value[3 * a + i] = state.u[i] * factor;
                sample->field[1].value[3 * a + i] = state.p[i] * factor;
            }
            sample->field[2].value[9 * a + i] = state.P[i] * factor * stress;
        }
    }
    cube->destroy(oracle);
}

static void make(struct verify_samples *samples, const char *kind, int n)
{
    struct solver_error error = {.text = ""};
    struct verify_sample *sample = verify_samples_add(samples, kind, &error);
    size_t side = (size_t)n + 1;
    if (sample == NULL || !verify_sample_points(sample, side * side * side, 3, &error) ||
        !verify_sample_weights(sample, &error)) {
        give_up(error.text);
    }
    for (size_t i = 0; i < FIELDS; i++) {
        struct verify_sample_field *field = verify_sample_add(sample, fields[i].name, fields[i].width, &error);
        if (field == NULL) {
            give_up(error.text);
        }
        (void)snprintf(field->unit, sizeof field->unit, "%s", fields[i].unit);
    }
    sample->time.value = TIME;
    sample->h.value = 1.0 / n;
    place(sample, n);
    fill(sample, kind, n);
}

static void put_data(hid_t where, const char *name, const double *value, size_t rows, size_t width)
{
    hsize_t dims[2] = {rows, width};
    hid_t space = H5Screate_simple(width > 1 ? 2 : 1, dims, NULL);
    hid_t data = H5Dcreate2(where, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (data < 0 || H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0) {
        give_up("cannot write VTKHDF");
    }
    (void)H5Dclose(data);
    (void)H5Sclose(space);
}

/* As others write it: no units, and no more than what has to be there. */
static void write_vtkhdf(const char *path, const struct verify_sample *sample)
{
    static const char type[] = "UnstructuredGrid";
    hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    hid_t grid = H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    hid_t text = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    (void)H5Tset_size(text, sizeof type - 1);
    hid_t attribute = H5Acreate2(grid, "Type", text, space, H5P_DEFAULT, H5P_DEFAULT);
    (void)H5Awrite(attribute, text, type);
    put_data(grid, "Points", sample->X, sample->count, 3);
    hid_t part = H5Gcreate2(grid, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    for (size_t i = 0; i < FIELDS; i++) {
        put_data(part, fields[i].name, sample->field[i].value, sample->count, (size_t)fields[i].width);
    }
    put_data(part, "weights", sample->weight, sample->count, 1);
    (void)H5Gclose(part);
    part = H5Gcreate2(grid, "FieldData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put_data(part, "TimeValue", &sample->time.value, 1, 1);
    put_data(part, "h", &sample->h.value, 1, 1);
    (void)H5Gclose(part);
    (void)H5Aclose(attribute);
    (void)H5Sclose(space);
    (void)H5Tclose(text);
    (void)H5Gclose(grid);
    if (H5Fclose(file) < 0) {
        give_up("cannot write VTKHDF");
    }
}

static void put_array(FILE *file, const char *name, const char *more, const double *value, size_t rows, size_t width)
{
    (void)fprintf(file, "<DataArray type=\"Float64\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"ascii\"%s>\n",
                  name, width, more);
    for (size_t i = 0; i < rows * width; i++) {
        (void)fprintf(file, "%.17g%c", value[i], (i + 1) % width == 0 ? '\n' : ' ');
    }
    (void)fprintf(file, "</DataArray>\n");
}

static void write_vtu(FILE *file, const struct verify_sample *sample)
{
    (void)fprintf(file, "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                        "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<FieldData>\n");
    put_array(file, "TimeValue", " NumberOfTuples=\"1\"", &sample->time.value, 1, 1);
    put_array(file, "h", " NumberOfTuples=\"1\"", &sample->h.value, 1, 1);
    (void)fprintf(file, "</FieldData>\n<Piece NumberOfPoints=\"%zu\" NumberOfCells=\"0\">\n<Points>\n", sample->count);
    put_array(file, "Points", "", sample->X, sample->count, 3);
    (void)fprintf(file, "</Points>\n<PointData>\n");
    for (size_t i = 0; i < FIELDS; i++) {
        put_array(file, fields[i].name, "", sample->field[i].value, sample->count, (size_t)fields[i].width);
    }
    put_array(file, "weights", "", sample->weight, sample->count, 1);
    (void)fprintf(file, "</PointData>\n<Cells/>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

static void write_text(const char *path, const struct verify_sample *sample, bool table)
{
    static const enum verify_columns columns[VERIFY_SAMPLE_FIELDS] = {VERIFY_BY_AXIS, VERIFY_BY_AXIS, VERIFY_BY_PAIR};
    FILE *file = fopen(path, "w");
    if (file == NULL) {
        give_up(path);
    }
    if (table) {
        verify_sample_write_csv(file, sample, columns);
    } else {
        write_vtu(file, sample);
    }
    if (fclose(file) != 0) {
        give_up(path);
    }
}

static void write_all(const char *folder, const char *kind, int n)
{
    static const char *const ending[] = {"h5", "vtkhdf", "vtu", "csv"};
    struct verify_samples samples = {.count = 0};
    make(&samples, kind, n);
    for (size_t i = 0; i < 4; i++) {
        char path[4096];
        struct solver_error error;
        (void)snprintf(path, sizeof path, "%s/%s-%d.%s", folder, kind, n, ending[i]);
        if (i == 0 && !verify_sample_write_hdf5(path, &samples, &error)) {
            give_up(error.text);
        } else if (i == 1) {
            write_vtkhdf(path, samples.sample[0]);
        } else if (i > 1) {
            write_text(path, samples.sample[0], i == 3);
        }
    }
    verify_samples_free(&samples);
}

int main(int count, char **argument)
{
    static const char *const kinds[] = {"right", "offset", "lost"};
    if (count != 2) {
        (void)fprintf(stderr, "usage: judge_sample FOLDER\n");
        return 2;
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct verify_samples both = {.count = 0};
        struct solver_error error;
        char path[4096];
        for (int n = 2; n <= 8; n *= 2) {
            write_all(argument[1], kinds[i], n);
            make(&both, kinds[i], n);
        }
        (void)snprintf(path, sizeof path, "%s/%s.h5", argument[1], kinds[i]);
        if (!verify_sample_write_hdf5(path, &both, &error)) {
            give_up(error.text);
        }
        verify_samples_free(&both);
    }
    return 0;
}
