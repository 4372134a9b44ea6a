/* Records: what is written is what is read; the same record gives the same bytes; files are whole or absent. */
#include "tests/unit/body.h"
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <dirent.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[SCRATCH];
static char path[SCRATCH_BELOW], twin[SCRATCH_BELOW];

static bool same_text(const char *a, const char *b)
{
    return strcmp(a, b) == 0;
}

/* Bit by bit. */
static bool same_record(const struct solver_record *a, const struct solver_record *b)
{
    const size_t n = a->count;
    bool same = a->dim == b->dim && n == b->count && a->step == b->step && a->time == b->time &&
                a->cell_count == b->cell_count && a->cell_width == b->cell_width && a->field_count == b->field_count &&
                a->history_count == b->history_count && a->history_columns == b->history_columns &&
                same_text(a->scene_name, b->scene_name) && same_text(a->scene_text, b->scene_text) &&
                same_text(a->overrides, b->overrides) && same_text(a->command, b->command) &&
                same_text(a->version, b->version);
    same = same && memcmp(a->X, b->X, 3 * n * sizeof *a->X) == 0 &&
           memcmp(a->cell, b->cell, a->cell_count * (size_t)a->cell_width * sizeof *a->cell) == 0 &&
           memcmp(a->history, b->history, a->history_count * a->history_columns * sizeof *a->history) == 0;
    for (size_t i = 0; same && i < a->field_count; i++) {
        const struct solver_record_field *f = &a->field[i], *g = &b->field[i];
        same = same_text(f->name, g->name) && same_text(f->unit, g->unit) && f->width == g->width &&
               memcmp(f->value, g->value, n * (size_t)f->width * sizeof *f->value) == 0;
    }
    for (size_t c = 0; same && c < a->history_columns; c++) {
        same = same_text(a->history_name[c], b->history_name[c]) && same_text(a->history_unit[c], b->history_unit[c]);
    }
    return same;
}

static char *read_bytes(const char *from, size_t *size)
{
    FILE *file = fopen(from, "rb");
    if (file == NULL) {
        return NULL;
    }
    (void)fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*size + 1);
    if (bytes != NULL && fread(bytes, 1, *size, file) != *size) {
        free(bytes);
        bytes = NULL;
    }
    (void)fclose(file);
    return bytes;
}

static void write_bytes(const char *to, const char *bytes, size_t size)
{
    FILE *file = fopen(to, "wb");
    CU_ASSERT_FATAL(file != NULL);
    CU_ASSERT(fwrite(bytes, 1, size, file) == size);
    CU_ASSERT(fclose(file) == 0);
}

static bool same_files(const char *a, const char *b)
{
    size_t size_a = 0, size_b = 0;
    char *bytes_a = read_bytes(a, &size_a), *bytes_b = read_bytes(b, &size_b);
    bool same =
        bytes_a != NULL && bytes_b != NULL && size_a > 0 && size_a == size_b && memcmp(bytes_a, bytes_b, size_a) == 0;
    free(bytes_a);
    free(bytes_b);
    return same;
}

static struct solver_record *made(int dim)
{
    struct solver_record *record;
    struct solver_error error;
    struct body *body = body_make(dim);
    bool ok = body_record(body, &record, &error);
    free(body);
    CU_ASSERT_FATAL(ok);
    return record;
}

static void round_trip(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_record *written = made(dim), *read = NULL;
        struct solver_error error = {.text = ""};
        CU_ASSERT_TRUE_FATAL(solver_record_save(path, written, &error));
        bool ok = solver_record_read(path, &read, &error);
        if (!ok) {
            (void)printf("%s\n", error.text);
        }
        CU_ASSERT_FATAL(ok);
        CU_ASSERT(same_record(written, read));
        CU_ASSERT(solver_record_save(twin, read, &error));
        CU_ASSERT(same_files(path, twin));
        solver_record_free(written);
        solver_record_free(read);
    }
}

/* The file's bytes depend on the record alone: not on when it is written nor on what was in memory before. */
static void same_bytes(void)
{
    struct solver_record *record = made(3);
    struct solver_error error;
    CU_ASSERT(solver_record_save(path, record, &error));
    (void)sleep(1);
    CU_ASSERT(solver_record_save(twin, record, &error));
    CU_ASSERT(same_files(path, twin));
    solver_record_free(record);
}

static void padding(void)
{
    struct solver_record *record = made(2);
    const double *F = solver_record_find(record, "F")->value, *P = solver_record_find(record, "P")->value;
    const double *H = solver_record_find(record, "H")->value, *u = solver_record_find(record, "displacement")->value;
    const double *J = solver_record_find(record, "J")->value, *sigma = solver_record_find(record, "sigma")->value;
    for (size_t a = 0; a < record->count; a++) {
        CU_ASSERT(F[9 * a + 8] == 1.0 && H[9 * a + 8] == J[a] && P[9 * a + 8] == 3e5 + (double)a);
        CU_ASSERT(sigma[9 * a + 8] == 4e5 + (double)a && sigma[9 * a + 5] == 0.0);
        CU_ASSERT(F[9 * a + 2] == 0.0 && F[9 * a + 5] == 0.0 && F[9 * a + 6] == 0.0 && F[9 * a + 7] == 0.0);
        CU_ASSERT(u[3 * a + 2] == 0.0 && record->X[3 * a + 2] == 0.0);
        CU_ASSERT(fabs(F[9 * a + 1] - 3e-3 * (1.0 + 0.1 * record->X[3 * a])) < 1e-16);
        CU_ASSERT(fabs(F[9 * a + 3] - 2e-3 * (1.0 + 0.1 * record->X[3 * a])) < 1e-16);
    }
    CU_ASSERT(strcmp(solver_record_find(record, "volume")->unit, "m^2") == 0);
    CU_ASSERT(solver_record_find(record, "nothing") == NULL);
    solver_record_free(record);
}

static void cofactor_only_where_evolved(void)
{
    struct body *body = body_make(3);
    struct solver_record *record;
    struct solver_error error;
    body->scene.evolved = SOLVER_PFJ;
    CU_ASSERT_FATAL(body_record(body, &record, &error));
    CU_ASSERT(solver_record_find(record, "H") == NULL && solver_record_find(record, "J") != NULL);
    solver_record_free(record);
    free(body);
}

/* A scheme without a deformation gradient: its fields are absent, and such a record is whole. */
static void without_deformation(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct body *body = body_make(dim);
        struct solver_record *record, *read = NULL;
        struct solver_error error = {.text = ""};
        body->output.F = body->output.H = body->output.P = body->output.P_normal = NULL;
        CU_ASSERT_FATAL(body_record(body, &record, &error));
        CU_ASSERT(solver_record_find(record, "F") == NULL && solver_record_find(record, "P") == NULL);
        CU_ASSERT(solver_record_find(record, "H") == NULL && solver_record_find(record, "sigma") != NULL);
        CU_ASSERT(solver_record_save(path, record, &error));
        CU_ASSERT_FATAL(solver_record_read(path, &read, &error));
        CU_ASSERT(same_record(record, read));
        solver_record_free(record);
        solver_record_free(read);
        free(body);
    }
}

static size_t find_column(const struct solver_record *record, const char *name)
{
    size_t c = 0;
    while (c < record->history_columns && strcmp(record->history_name[c], name) != 0) {
        c++;
    }
    return c;
}

static void history_columns(void)
{
    static const size_t expected[] = {0, 6 + 4, 8 + 8, 11 + 12};
    for (int dim = 1; dim <= 3; dim++) {
        struct solver_record *record = made(dim);
        const size_t width = record->history_columns;
        CU_ASSERT_EQUAL(width, expected[dim]);
        CU_ASSERT_EQUAL(find_column(record, "angular_momentum_z") < width, dim > 1);
        CU_ASSERT_EQUAL(find_column(record, "linear_momentum_z") < width, dim == 3);
        for (size_t r = 0; r < record->history_count; r++) {
            const double *row = record->history + r * width, t = 0.05 * (double)r;
            CU_ASSERT(row[0] == t && row[find_column(record, "linear_momentum_x")] == 1.0 + t);
            CU_ASSERT(row[find_column(record, "total_energy")] == (5.0 + t) + (4.0 - t));
            CU_ASSERT(row[find_column(record, "external_work")] == 0.5 * t);
            CU_ASSERT(row[find_column(record, "probe_middle_u_x")] == 1e-3 * (t + 3.0));
            CU_ASSERT(row[find_column(record, "probe_corner_v_x")] == t);
            CU_ASSERT(dim < 2 || row[find_column(record, "angular_momentum_z")] == -3.0 - t);
        }
        solver_record_free(record);
    }
}

/* Each total has its own column, where the history says that it tells something. */
static void every_total(void)
{
    for (int dim = 1; dim <= 3; dim++) {
        struct body *body = body_make(dim);
        const struct solver_totals one = {.time = 1,
                                          .linear = {2, 3, 4},
                                          .angular = {5, 6, 7},
                                          .kinetic = 8,
                                          .strain = 9,
                                          .plastic = 10,
                                          .external = 11,
                                          .iterations = 12,
                                          .volume_change = 13,
                                          .numerical = 14,
                                          .impact = 15,
                                          .wall = {16, 17, 18}};
        const struct {
            const char *name;
            double value;
            int least; /* dimension that has it */
        } expected[] = {{"time", 1, 1},
                        {"linear_momentum_x", 2, 1},
                        {"linear_momentum_y", 3, 2},
                        {"linear_momentum_z", 4, 3},
                        {"angular_momentum_x", 5, 3},
                        {"angular_momentum_y", 6, 3},
                        {"angular_momentum_z", 7, 2},
                        {"kinetic_energy", 8, 1},
                        {"strain_energy", 9, 1},
                        {"total_energy", 17, 1},
                        {"external_work", 11, 1},
                        {"plastic_work", 10, 1},
                        {"iterations", 12, 1},
                        {"volume_change", 13, 1},
                        {"numerical_dissipation", 14, 1},
                        {"impact_loss", 15, 1},
                        {"wall_impulse_x", 16, 1},
                        {"wall_impulse_y", 17, 2},
                        {"wall_impulse_z", 18, 3}};
        struct solver_record *record = NULL;
        struct solver_error error;
        size_t found = 0;
        body->totals[BODY_ROWS - 1] = one;
        body->history.flows = body->history.incompressible = body->history.balanced = body->history.walled = true;
        body->history.probe_count = 0;
        CU_ASSERT_TRUE_FATAL(body_record(body, &record, &error));
        const double *row = record->history + (BODY_ROWS - 1) * record->history_columns;
        for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
            size_t c = find_column(record, expected[i].name);
            CU_ASSERT_EQUAL(c < record->history_columns, dim >= expected[i].least);
            CU_ASSERT(c == record->history_columns || row[c] == expected[i].value);
            found += c < record->history_columns ? 1 : 0;
        }
        CU_ASSERT_EQUAL(found, record->history_columns);
        solver_record_free(record);
        free(body);
    }
}

/* Without a history there are columns and no rows. */
static void no_history(void)
{
    struct body *body = body_make(2);
    struct solver_record *read = NULL;
    struct solver_error error;
    CU_ASSERT(solver_record_write(path, &body->scene, &body->output, NULL, NULL, NULL, &error));
    CU_ASSERT_FATAL(solver_record_read(path, &read, &error));
    CU_ASSERT(read->history_count == 0 && read->history_columns == 8 && read->command[0] == '\0');
    solver_record_free(read);
    free(body);
}

/* More than the 64 KiB that a plain HDF5 attribute may hold. */
static void long_scene(void)
{
    enum { LONG = 300000 };
    struct body *body = body_make(1);
    struct solver_record *read = NULL;
    struct solver_error error;
    body->scene.text = malloc(LONG + 1);
    CU_ASSERT_FATAL(body->scene.text != NULL);
    for (size_t i = 0; i < LONG; i++) {
        body->scene.text[i] = (char)('a' + i % 23);
    }
    body->scene.text[LONG] = '\0';
    CU_ASSERT(solver_record_write(path, &body->scene, &body->output, NULL, "", "", &error));
    CU_ASSERT_FATAL(solver_record_read(path, &read, &error));
    CU_ASSERT(strcmp(read->scene_text, body->scene.text) == 0);
    solver_record_free(read);
    free(body->scene.text);
    free(body);
}

static void names_refused(void)
{
    struct solver_record *record = made(1);
    struct solver_error error;
    static const char *const bad[] = {"", ".h5", "/no/.vtkhdf", "body", "body.png", "/no/such/folder/body.h5"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        error.text[0] = '\0';
        CU_ASSERT_FALSE(solver_record_save(bad[i], record, &error));
        CU_ASSERT(strstr(error.text, "cannot write") != NULL);
    }
    solver_record_free(record);
    struct body *body = body_make(1);
    memset(body->probe_name[1], 'x', 60);
    CU_ASSERT_FALSE(body_record(body, &record, &error));
    CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, "at most 53 characters") != NULL);
    free(body);
}

static size_t files_in(const char *where)
{
    size_t count = 0;
    DIR *open = opendir(where);
    CU_ASSERT_FATAL(open != NULL);
    for (struct dirent *entry = readdir(open); entry != NULL; entry = readdir(open)) {
        count += entry->d_name[0] != '.';
    }
    (void)closedir(open);
    return count;
}

/* A disk that is full after `limit` bytes, for a child process. True if saving failed there with a clear error. */
static bool save_on_small_disk(const struct solver_record *record, rlim_t limit)
{
    pid_t child = fork();
    if (child == 0) {
        struct solver_error error = {.text = ""};
        struct rlimit most = {limit, limit};
        (void)signal(SIGXFSZ, SIG_IGN);
        bool refused = setrlimit(RLIMIT_FSIZE, &most) == 0 && !solver_record_save(path, record, &error);
        _exit(refused && error.code == SOLVER_IO && strstr(error.text, path) != NULL ? 0 : 1);
    }
    int status = -1;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static void full_disk(void)
{
    char here[SCRATCH], old_xdmf[SCRATCH_BELOW], xdmf[SCRATCH_BELOW], keep[SCRATCH_BELOW];
    scratch_folder(here);
    memcpy(keep, path, sizeof keep);
    (void)snprintf(path, sizeof path, "%s/body.h5", here);
    (void)snprintf(xdmf, sizeof xdmf, "%s/body.xdmf", here);
    (void)snprintf(old_xdmf, sizeof old_xdmf, "%s.xdmf", folder);
    struct solver_record *old = made(1), *new = made(3), *read = NULL;
    struct solver_error error;
    CU_ASSERT(solver_record_save(path, old, &error));
    CU_ASSERT(rename(xdmf, old_xdmf) == 0 && solver_record_save(path, old, &error));
    size_t size = 0, xdmf_size = 0;
    free(read_bytes(path, &size));
    static const rlim_t limits[] = {0, 1, 512, 3000, 20000};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        CU_ASSERT(save_on_small_disk(new, limits[i]));
        CU_ASSERT_FATAL(solver_record_read(path, &read, &error));
        CU_ASSERT(same_record(old, read));
        solver_record_free(read);
        CU_ASSERT(same_files(xdmf, old_xdmf));
        CU_ASSERT_EQUAL(files_in(here), 2); /* nothing half-written beside them */
    }
    free(read_bytes(xdmf, &xdmf_size));
    CU_ASSERT(size > 20000 / 4 && xdmf_size > 500); /* so that the limits above cut inside the files */
    (void)remove(path);
    CU_ASSERT(mkdir(path, 0777) == 0);
    CU_ASSERT_FALSE(solver_record_save(path, new, &error)); /* a folder of that name */
    CU_ASSERT_EQUAL(files_in(here), 2);
    (void)rmdir(path);
    (void)remove(xdmf);
    (void)rmdir(here);
    (void)remove(old_xdmf);
    memcpy(path, keep, sizeof keep);
    solver_record_free(old);
    solver_record_free(new);
}

static void truncated(void)
{
    struct solver_record *record = made(2);
    struct solver_error error;
    CU_ASSERT(solver_record_save(path, record, &error));
    solver_record_free(record);
    size_t size = 0;
    char *bytes = read_bytes(path, &size);
    CU_ASSERT_FATAL(bytes != NULL && size > 1000);
    for (size_t i = 0; i < 300; i++) {
        const size_t length = i < 100 ? i : i < 200 ? size - 1 - (i - 100) : (size - 1) * (i - 200) / 100;
        write_bytes(twin, bytes, length);
        error = (struct solver_error){.text = ""};
        CU_ASSERT_FALSE(solver_record_read(twin, &record, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, twin) != NULL && record == NULL);
    }
    free(bytes);
}

/* A changed byte anywhere is seen, in the structure as in the values. */
static void flipped(void)
{
    struct solver_record *record = made(1);
    struct solver_error error;
    CU_ASSERT(solver_record_save(path, record, &error));
    solver_record_free(record);
    size_t size = 0;
    char *bytes = read_bytes(path, &size);
    CU_ASSERT_FATAL(bytes != NULL && size > 1000);
    for (size_t i = 0; i < size; i += i + 100 < size ? 3 : 1) {
        const char was = bytes[i];
        bytes[i] = (char)(was ^ (i % 2 == 0 ? 0x01 : 0x80));
        write_bytes(twin, bytes, size);
        bytes[i] = was;
        error = (struct solver_error){.text = ""};
        CU_ASSERT_FALSE(solver_record_read(twin, &record, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && strstr(error.text, twin) != NULL && record == NULL);
    }
    free(bytes);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"round trip in 1, 2 and 3 dimensions", round_trip},
        {"the same record gives the same bytes", same_bytes},
        {"padding below three dimensions", padding},
        {"the cofactor only where it is evolved", cofactor_only_where_evolved},
        {"without a deformation gradient", without_deformation},
        {"columns of the history", history_columns},
        {"a column for every total", every_total},
        {"a record without history", no_history},
        {"a scene longer than an attribute", long_scene},
        {"names refused", names_refused},
        {"a full disk leaves the old files", full_disk},
        {"every truncation is refused", truncated},
        {"every flipped byte is refused", flipped},
    };
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/body.vtkhdf", folder);
    (void)snprintf(twin, sizeof twin, "%s/twin.h5", folder);
    int result = unit_main("record", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    return result;
}
