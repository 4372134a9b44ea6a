/* The file that a study of costs is kept in: read as written, and refused where anything is wrong with it. */
#include "tests/unit/scratch.h"
#include "tests/unit/trades.h"

#include <inttypes.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

static char file[SCRATCH];

static void put(const char *bytes, size_t size)
{
    unlink(file);
    FILE *out = fopen(file, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(out);
    CU_ASSERT_EQUAL_FATAL(fwrite(bytes, 1, size, out), size);
    CU_ASSERT_EQUAL_FATAL(fclose(out), 0);
}

static char *take(size_t *size)
{
    static char bytes[1 << 14];
    FILE *in = fopen(file, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(in);
    *size = fread(bytes, 1, sizeof bytes - 1, in);
    bytes[*size] = '\0';
    CU_ASSERT_EQUAL_FATAL(fclose(in), 0);
    return bytes;
}

static bool is_read(void)
{
    struct verify_trade read;
    error = (struct solver_error){.code = SOLVER_OK};
    bool done = verify_trade_read(file, &read, &error);
    CU_ASSERT_EQUAL(done, error.code == SOLVER_OK);
    verify_trade_free(&read);
    return done;
}

static void round_trip(void)
{
    struct verify_trade read;
    begin();
    add("scheme=upwind", 8, 1, 1, 1, 1)->end = VERIFY_BROKE; /* is not kept */
    snprintf(trade.run[1].variant, SOLVER_NAME, "a b");
    trade.run[2].noise = NAN;
    trade.run[2].error[0] = 1.0 / 3.0; /* every digit is kept */
    trade.run[2].cost[VERIFY_SECONDS] = 2.0 / 3.0;
    trade.chosen = 1;
    snprintf(trade.stopped, sizeof trade.stopped, "SIGINT");
    CU_ASSERT_TRUE_FATAL(verify_trade_write(&trade, file, &error));
    CU_ASSERT_TRUE_FATAL(verify_trade_read(file, &read, &error));
    CU_ASSERT_STRING_EQUAL(read.scene, "plain");
    CU_ASSERT_STRING_EQUAL(read.overrides, "A=1 B=2");
    CU_ASSERT_EQUAL(read.hash, trade.hash);
    CU_ASSERT_EQUAL(read.chosen, 1);
    CU_ASSERT_STRING_EQUAL(read.stopped, "SIGINT");
    CU_ASSERT_EQUAL(read.error_count, 2);
    CU_ASSERT_STRING_EQUAL(read.error_name[1], "figure period");
    CU_ASSERT_EQUAL_FATAL(read.run_count, 5);
    for (size_t i = 0; i < 5; i++) {
        const struct verify_trade_run *a = &trade.run[i], *b = &read.run[i];
        CU_ASSERT(strcmp(a->words, b->words) == 0 && strcmp(a->variant, b->variant) == 0 && a->n == b->n);
        CU_ASSERT(a->own == b->own && a->threads == b->threads && a->repeats == b->repeats);
        for (int cost = 0; cost < VERIFY_COSTS; cost++) {
            CU_ASSERT(a->cost[cost] == b->cost[cost]);
        }
        CU_ASSERT(a->error[0] == b->error[0]);
        CU_ASSERT(isnan(a->error[1]) ? isnan(b->error[1]) : a->error[1] == b->error[1]);
        CU_ASSERT(isnan(a->noise) ? isnan(b->noise) : a->noise == b->noise);
    }
    verify_trade_free(&read);
}

/* Cut short anywhere, or one byte another: no such file is read. */
static void damage(void)
{
    static char good[1 << 14], bad[1 << 14];
    size_t size = 0;
    begin();
    trade.run_count = 1;
    CU_ASSERT_TRUE_FATAL(verify_trade_write(&trade, file, &error));
    memcpy(good, take(&size), sizeof good);
    CU_ASSERT_TRUE(is_read());
    for (size_t length = 0; length < size; length++) {
        put(good, length);
        CU_ASSERT_FALSE(is_read());
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
    }
    for (size_t i = 0; i < size; i++) {
        memcpy(bad, good, size);
        bad[i] ^= 1;
        put(bad, size);
        CU_ASSERT_FALSE(is_read());
        bad[i] = '\0';
        put(bad, size);
        CU_ASSERT_FALSE(is_read());
    }
    memcpy(bad, good, size);
    bad[size] = '\n';
    put(bad, size + 1);
    CU_ASSERT_FALSE(is_read());
    unlink(file);
    CU_ASSERT_FALSE(is_read());
    CU_ASSERT_EQUAL(error.code, SOLVER_IO);
}

/* The text with `old` replaced, under a sum that is right: made on purpose. */
static void forge(const char *text, const char *old, const char *new)
{
    static char bytes[1 << 14];
    const char *place = strstr(text, old), *sum = strstr(text, "sum\t");
    CU_ASSERT_TRUE_FATAL(place != NULL && sum != NULL && place < sum);
    int used = snprintf(bytes, sizeof bytes, "%.*s%s%.*s", (int)(place - text), text, new,
                        (int)(sum - place - (long)strlen(old)), place + strlen(old));
    used += snprintf(bytes + used, sizeof bytes - (size_t)used, "sum\t%016" PRIx64 "\n",
                     verify_trade_hash_bytes(verify_trade_hash_start, bytes, (size_t)used));
    put(bytes, (size_t)used);
}

static void hostile(void)
{
    unit_untrapped();
    static const struct {
        const char *old, *new, *says;
    } bad[] = {
        {"assay trade 2", "assay trade 1", "a study of another version of this program"},
        {"assay trade 2", "assay trades", "no study of assay trade"},
        {"scene\t", "scent\t", "line 2: expected scene"},
        {"hash\t", "hash\tx", "line 7"}, /* the reader has seen the names of columns by then */
        {"stopped\tSIGINT", "stopped\tby something that is no signal", "line 5: expected stopped"},
        {"stopped\tSIGINT", "stopped\t\x1b[31mSIGINT", "control characters"},
        {"error\tp", "error\tq", "an error that has a column"},
        {"variant\tn", "n\tvariant", "line 7: expected the names of columns"},
        {"\tfigure period", "\t\tfigure period", "line 7: expected up to 32 names of errors"},
        {"scheme=upwind", "material.E=1", "line 8: expected a configuration of keys that a study varies"},
        {"scheme=upwind", "scheme=", "line 8: expected a configuration"},
        {"scheme=upwind", "scheme=upwind cfl=1", "line 8: expected a configuration"},
        {"scheme=upwind", " scheme=upwind", "line 8: expected a configuration"},
        {"\t8\t1\t12", "\t0\t1\t12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8.5\t1\t12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t2\t12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t1\tnan", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t1\t1e999", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t1\t-12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t1\t12\t12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t12", "line 8: expected as many numbers"},
        {"\t8\t1\t12", "\t8\t1\t12 x", "line 8: expected as many numbers"},
    };
    static char good[1 << 14];
    size_t size = 0;
    begin();
    trade.run_count = 1;
    snprintf(trade.stopped, sizeof trade.stopped, "SIGINT");
    CU_ASSERT_TRUE_FATAL(verify_trade_write(&trade, file, &error));
    memcpy(good, take(&size), sizeof good);
    forge(good, "scheme", "scheme");
    CU_ASSERT_TRUE(is_read());
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        forge(good, bad[i].old, bad[i].new);
        CU_ASSERT_FALSE(is_read());
        CU_ASSERT_EQUAL(error.code, SOLVER_BAD_INPUT);
        CU_ASSERT_PTR_NOT_NULL(strstr(error.text, bad[i].says));
        if (strstr(error.text, bad[i].says) == NULL) {
            printf("%s: %s\n", bad[i].new, error.text);
        }
    }
}

/* Nobody writes to the pipe: a reader that waits for one waits for ever. */
static void no_plain_file(void)
{
    unlink(file);
    CU_ASSERT_EQUAL_FATAL(mkfifo(file, 0600), 0);
    (void)alarm(10);
    CU_ASSERT_FALSE(is_read());
    (void)alarm(0);
    CU_ASSERT_EQUAL(error.code, SOLVER_IO);
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "is not a plain file"));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"written and read", round_trip},
        {"damage", damage},
        {"hostile files", hostile},
        {"a pipe", no_plain_file},
    };
    scratch_file(file);
    int result = unit_main("trade file", tests, sizeof tests / sizeof *tests);
    unlink(file);
    verify_trade_free(&trade);
    return result;
}
