/* What the tests of samples share: files written for a moment, read, and what is said of them. */
#ifndef TESTS_UNIT_SAMPLE_FILES_H
#define TESTS_UNIT_SAMPLE_FILES_H

#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"
#include "verify/sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct verify_samples samples;
static struct solver_error sample_error;
static char sample_path[SCRATCH];

static inline bool sample_file_write(const void *bytes, size_t size)
{
    if (sample_path[0] == '\0') {
        scratch_file(sample_path);
    }
    FILE *file = fopen(sample_path, "wb");
    bool written = file != NULL && fwrite(bytes, 1, size, file) == size;
    return file != NULL && fclose(file) == 0 && written;
}

/* Reads the file as it is now; what was read before is given back. */
static inline bool sample_file_read(void)
{
    verify_samples_free(&samples);
    sample_error = (struct solver_error){.code = SOLVER_OK};
    return verify_sample_read(sample_path, &samples, &sample_error);
}

static inline const struct verify_sample *sample_of(const void *bytes, size_t size)
{
    CU_ASSERT_TRUE_FATAL(sample_file_write(bytes, size));
    bool read = sample_file_read();
    if (!read) {
        printf("%s\n", sample_error.text);
    }
    CU_ASSERT_TRUE_FATAL(read);
    CU_ASSERT_TRUE_FATAL(samples.count >= 1);
    return samples.sample[0];
}

static inline const struct verify_sample *sample_of_text(const char *text)
{
    return sample_of(text, strlen(text));
}

/* The file is refused, with these words. */
static inline void sample_refused(const void *bytes, size_t size, const char *words)
{
    CU_ASSERT_TRUE_FATAL(sample_file_write(bytes, size));
    bool read = sample_file_read();
    bool said = !read && strstr(sample_error.text, words) != NULL && strstr(sample_error.text, sample_path) != NULL;
    if (!said) {
        printf("expected \"%s\", got \"%s\"\n", words, read ? "no error" : sample_error.text);
    }
    CU_ASSERT_TRUE(said);
    CU_ASSERT_EQUAL(sample_error.code, SOLVER_BAD_INPUT);
}

static inline void sample_refused_text(const char *text, const char *words)
{
    sample_refused(text, strlen(text), words);
}

static inline bool same_numbers(const double *a, const double *b, size_t count)
{
    size_t i = 0;
    while (i < count && a[i] == b[i]) {
        i++;
    }
    return i == count;
}

static inline const struct verify_sample_field *sample_field(const struct verify_sample *sample, const char *name)
{
    for (size_t i = 0; i < sample->field_count; i++) {
        if (strcmp(sample->field[i].name, name) == 0) {
            return &sample->field[i];
        }
    }
    CU_FAIL_FATAL("no such field");
    return NULL;
}

/* Call from main after unit_main. */
static inline int sample_files_end(int code)
{
    verify_samples_free(&samples);
    (void)unlink(sample_path);
    return code;
}

#endif
