/* Checkpoints that are cut short, damaged, foreign, of another kind, or made up, with a valid seal: all are refused,
 * and say why; nothing in them is believed before the seal holds, and nothing out of bounds after. */
#include "solver/build.h"
#include "solver/checkpoint.h"
#include "solver/path.h"
#include "solver/seal.h"
#include "tests/unit/runs.h"
#include "tests/unit/scratch.h"

#include <sys/stat.h>

static char folder[SCRATCH];
static char path[SCRATCH_BELOW];

#define SETTINGS "dim=2 n=2 scheme=ulsph support=2.4 material.model=linear-elastic"
static const char moving[] = "probes = { { name = 'middle', X = each(0.5) } }\n"
                             "initial = { velocity = function(X, Y) return first(0.1 * X, 0.1 * Y, 0) end }\n";

static const struct solver_checkpoint_about about = {
    "scene.lua", "/there/scene.lua", "title = 'x'", "n=4\n", "assay run scene", "1.0", NULL, NULL, 30.0, 0.0, 7, 0};

/* A good one, whose bytes tests spoil. */
static unsigned char *good;
static size_t good_size;

static void read_good(void)
{
    struct stat status;
    FILE *file = fopen(path, "rb");
    CU_ASSERT_FATAL(file != NULL && stat(path, &status) == 0);
    good_size = (size_t)status.st_size;
    good = malloc(good_size + 256);
    CU_ASSERT_FATAL(good != NULL && fread(good, 1, good_size, file) == good_size);
    (void)fclose(file);
}

static void make_good(void)
{
    struct sample sample = start(moving, SETTINGS);
    struct solver_error error;
    CU_ASSERT_FATAL(solver_run_to(sample.run, 0.2, NULL, NULL, &error));
    CU_ASSERT_FATAL(solver_checkpoint_write(path, sample.run, &about, &error));
    read_good();
    finish(&sample);
}

static void write_bytes(const unsigned char *bytes, size_t size)
{
    (void)unlink(
        path); /* ext4 sends a file that is cut off and written anew to the disk at once, which takes its time */
    FILE *file = fopen(path, "wb");
    CU_ASSERT_FATAL(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
}

/* Ends bytes, which have room for it, with the checksum of what is before, as a forger would. */
static void seal(unsigned char *bytes, size_t size)
{
    uint64_t sum = solver_seal_sum(SOLVER_SEAL_SEED, bytes, size - SOLVER_SEAL_SIZE);
    memcpy(bytes + size - SOLVER_SEAL_SIZE, SOLVER_SEAL, 8);
    memcpy(bytes + size - 8, &sum, sizeof sum);
}

/* Reads what is at `path` into a run, as a restart does. */
static bool take_up(struct solver_run *run, struct solver_error *error)
{
    struct solver_checkpoint *checkpoint = NULL;
    bool done = solver_checkpoint_read(path, &checkpoint, error) && solver_checkpoint_restore(checkpoint, run, error);
    solver_checkpoint_free(checkpoint);
    return done;
}

static void expect(const char *word, const struct solver_error *error)
{
    bool said = strstr(error->text, word) != NULL && strstr(error->text, path) != NULL;
    if (!said) {
        printf("\n    expected \"%s\" in: %s", word, error->text);
    }
    CU_ASSERT(said);
    CU_ASSERT_EQUAL(error->code, SOLVER_BAD_INPUT);
}

static void refused_as(const unsigned char *bytes, size_t size, const char *word)
{
    struct sample sample = start(moving, SETTINGS);
    struct solver_error error = {.text = ""};
    write_bytes(bytes, size);
    CU_ASSERT_FALSE(take_up(sample.run, &error));
    expect(word, &error);
    finish(&sample);
}

static void every_length(void)
{
    struct solver_checkpoint *checkpoint;
    for (size_t size = 0; size < good_size; size += size < 64 || size + 64 > good_size ? 1 : 13) {
        struct solver_error error = {.text = ""};
        write_bytes(good, size);
        CU_ASSERT_FALSE(solver_checkpoint_read(path, &checkpoint, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && checkpoint == NULL);
    }
    refused_as(good, good_size - 8, "cut short, damaged");
    refused_as(good, 0, "no checkpoint that assay wrote");
}

static void every_byte(void)
{
    struct solver_checkpoint *checkpoint;
    for (size_t at = 0; at < good_size; at += 7) {
        struct solver_error error = {.text = ""};
        good[at] ^= 0x10;
        write_bytes(good, good_size);
        CU_ASSERT_FALSE(solver_checkpoint_read(path, &checkpoint, &error));
        CU_ASSERT(error.code == SOLVER_BAD_INPUT && checkpoint == NULL);
        good[at] ^= 0x10;
    }
}

static void foreign(void)
{
    struct solver_checkpoint *checkpoint;
    struct solver_error error = {.text = ""};
    refused_as((const unsigned char *)"\x89HDF\r\n\x1a\n a record, perhaps", 24, "no checkpoint that assay wrote");
    CU_ASSERT_EQUAL(unlink(path), 0);
    CU_ASSERT_FALSE(solver_checkpoint_read(path, &checkpoint, &error));
    CU_ASSERT_EQUAL(error.code, SOLVER_IO);
    CU_ASSERT_EQUAL(mkfifo(path, 0600), 0);
    CU_ASSERT_FALSE(solver_checkpoint_read(path, &checkpoint, &error));
    expect("not a plain file", &error);
    CU_ASSERT_EQUAL(unlink(path), 0);
    CU_ASSERT_EQUAL(mkdir(path, 0700), 0);
    CU_ASSERT_FALSE(solver_checkpoint_read(path, &checkpoint, &error));
    expect("a folder", &error);
    CU_ASSERT_EQUAL(rmdir(path), 0);
}

/* Within a block: its name is at 0. */
enum { WIDTH = 48, COUNT = 56, DATA = 64 };

/* Where a block begins: its head. */
static size_t find_block(const char *name)
{
    for (size_t at = 32; at + 64 < good_size; at += 8) {
        if (strcmp((const char *)good + at, name) == 0) {
            return at;
        }
    }
    CU_FAIL_FATAL("no such block");
    return 0;
}

/* A copy with `size` bytes of a block changed from `offset` on, sealed. */
static void forged(const char *name, size_t offset, const void *bytes, size_t size, const char *word)
{
    unsigned char *copy = malloc(good_size);
    CU_ASSERT_FATAL(copy != NULL);
    memcpy(copy, good, good_size);
    memcpy(copy + find_block(name) + offset, bytes, size);
    seal(copy, good_size);
    refused_as(copy, good_size, word);
    free(copy);
}

static void another_kind(void)
{
    unsigned char *copy = malloc(good_size);
    CU_ASSERT_FATAL(copy != NULL);
    memcpy(copy, good, good_size);
    copy[sizeof "assay checkpoint " - 1] = '0';
    seal(copy, good_size);
    refused_as(copy, good_size, "another kind; this program reads \"assay checkpoint 2\"");
    free(copy);
}

static void made_up(void)
{
    unit_untrapped();
    const uint64_t huge = UINT64_MAX - 3, many = 1u << 30, few = 8;
    const double nan = NAN, infinite = INFINITY, late = 7.0, negative = -1.0;
    forged("version", 0, "vision", 6, "\"vision");
    forged("version", COUNT, &huge, 8, "claims 18446744073709551612 entries of 1 bytes");
    forged("version", WIDTH, &huge, 8, "entries of 18446744073709551612 bytes");
    forged("version", DATA, "no end here", 4, "is no text");
    forged("scene", DATA, "a\0b", 3, "is no text");
    forged("numbers", DATA, &infinite, 8, "not finite");
    forged("time", DATA, &nan, 8, "not on the way");
    forged("time", DATA, &late, 8, "not on the way");
    forged("time", DATA, &negative, 8, "not on the way");
    forged("step", DATA, &many, 8, "not on the way");
    forged("field v", 0, "field w", 7, "\"field w\" where \"field v\"");
    forged("field v", COUNT, &few, 8, "has 8 entries of 16 bytes");
    forged("field rho", DATA, &negative, 8, "its state is broken");
    forged("field v", DATA, &nan, 8, "its state is broken");
    forged("field sigma L", DATA, &nan, 8, "its field sigma L is not finite");
    forged("work of loads", DATA, &nan, 8, "are no numbers");
    forged("numerical dissipation", DATA, &infinite, 8, "are no numbers");
    forged("seconds", DATA, &negative, 8, "are no numbers");
    forged("neighbours", DATA, &nan, 8, "not finite");
    forged("rows of history", DATA, &many, 8, "more than it can hold");
    forged("rows of history", DATA, &huge, 8, "more than it can hold");
    forged("rows of history", DATA, &few, 8, "\"history\" has");
}

/* As many bytes as there should be, of another kind. */
static void other_layout(void)
{
    const struct {
        uint64_t width, count;
    } halves = {8, 18};
    CU_ASSERT_EQUAL_FATAL(good[find_block("field v") + WIDTH], 16);
    CU_ASSERT_EQUAL_FATAL(good[find_block("field v") + COUNT], 9);
    forged("field v", WIDTH, &halves, sizeof halves,
           "has 18 entries of 8 bytes, and the scene as this program runs it 9 of 16");
    forged("members of a row", DATA + 16, "\x40", 1, "not as this program has them"); /* "time" lies elsewhere */
    forged("members of a row", DATA, "tide", 4, "not as this program has them");
}

/* By another compiler, or by loops that round otherwise. */
static void other_arithmetic(void)
{
    CU_ASSERT(strlen(solver_build()) > 8);
    forged("build", DATA, "cc", 2, "whose results may differ in their last digits");
    forged("loops", DATA, "bused", 5, "go on without ASSAY_ISA=baseline");
}

/* Written by the loops for one instruction set and read by those for another: refused only where these give other bits,
 * with what to do. */
static void by_another_path(void)
{
    int widest = solver_path();
    for (int other = 0; other < widest; other++) {
        char loops[16];
        struct solver_error error = {.text = ""};
        solver_path_use(widest);
        write_bytes(good, good_size);
        (void)snprintf(loops, sizeof loops, "%s", solver_build_loops());
        solver_path_use(other);
        bool same = strcmp(loops, solver_build_loops()) == 0;
        struct sample sample = start(moving, SETTINGS);
        CU_ASSERT_EQUAL(same, strcmp(solver_path_name(other), "avx2") == 0);
        CU_ASSERT_EQUAL(take_up(sample.run, &error), same);
        if (!same) {
            expect("its loops had fused multiplications and additions, and those for baseline have separate ones",
                   &error);
            CU_ASSERT(solver_checkpoint_write(path, sample.run, &about, &error));
            solver_path_use(widest);
            CU_ASSERT_FALSE(take_up(sample.run, &error));
            expect("go on with ASSAY_ISA=baseline in the environment", &error);
        }
        finish(&sample);
    }
    solver_path_use(widest);
}

static void too_much(void)
{
    unsigned char *copy = calloc(good_size + 64, 1);
    CU_ASSERT_FATAL(copy != NULL);
    memcpy(copy, good, good_size - SOLVER_SEAL_SIZE);
    seal(copy, good_size + 64);
    refused_as(copy, good_size + 64, "bytes more than the run has");
    free(copy);
}

/* Of another scene, or the same at another spacing. */
static void of_another_run(void)
{
    struct sample finer = start(moving, "dim=2 n=3 scheme=ulsph support=2.4 material.model=linear-elastic");
    struct sample other = start(moving, "dim=2 n=2 evolved=pFHJ");
    struct solver_error error = {.text = ""};
    write_bytes(good, good_size);
    CU_ASSERT_FALSE(take_up(finer.run, &error));
    expect("\"field v\" has", &error);
    CU_ASSERT_FALSE(take_up(other.run, &error));
    expect("\"field F\" was expected", &error);
    finish(&finer);
    finish(&other);
}

/* Any bytes, sealed: refused or taken, and nothing is read or written out of bounds, for checkers to see. */
static void any_bytes(void)
{
    unit_untrapped();
    unsigned char *copy = malloc(good_size);
    uint32_t random = 1;
    CU_ASSERT_FATAL(copy != NULL);
    for (int i = 0; i < 400; i++) {
        struct sample sample = start(moving, SETTINGS);
        struct solver_error error = {.text = ""};
        memcpy(copy, good, good_size);
        for (int k = 0; k <= i % 3; k++) {
            random = random * 1664525u + 1013904223u;
            copy[32 + random % (good_size - 48)] ^= (unsigned char)(1u << (random >> 29));
        }
        seal(copy, good_size);
        write_bytes(copy, good_size);
        CU_ASSERT(take_up(sample.run, &error) || error.code == SOLVER_BAD_INPUT);
        finish(&sample);
    }
    free(copy);
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"a good one", make_good},
        {"cut short at every length", every_length},
        {"changed in every byte", every_byte},
        {"foreign files", foreign},
        {"another kind of checkpoint", another_kind},
        {"sealed and made up", made_up},
        {"laid out otherwise", other_layout},
        {"by other arithmetic", other_arithmetic},
        {"by the loops for another instruction set", by_another_path},
        {"more than the run has", too_much},
        {"of another run", of_another_run},
        {"any bytes, sealed", any_bytes},
    };
    scratch_folder(folder);
    (void)snprintf(path, sizeof path, "%s/run.checkpoint", folder);
    int result = unit_main("hostile checkpoints", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(folder);
    free(good);
    return result;
}
