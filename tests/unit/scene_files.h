/* What the tests of scenes share: a plain scene, changed in one place and written to a file. */
#ifndef TESTS_SCENE_FILES_H
#define TESTS_SCENE_FILES_H

#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A plain scene; each bad one below differs from it in one place. */
static const char plain[] = "title = 'plain'\n"
                            "dim = 2\n"
                            "domain = { lower = {0, 0}, upper = {2, 1} }\n"
                            "n = 4\n"
                            "material = { model = 'neo-hookean', E = 10, nu = 0.3, rho = 2 }\n"
                            "t_end = 1\n"
                            "initial = { velocity = function(X, Y, Z, t) return X, Y end }\n";

static char folder[SCRATCH];
static char path[SCRATCH_BELOW];

static inline void write_scene(const char *text, size_t length)
{
    unlink(path); /* ext4 sends a file that is cut off and written anew to the disk at once, which takes its time */
    FILE *file = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL_FATAL(fwrite(text, 1, length, file), length);
    CU_ASSERT_EQUAL_FATAL(fclose(file), 0);
}

/* Writes the plain scene with `old` (once in it) replaced by `new`; without `old`, `new` is appended. */
static inline void write_changed(const char *old, const char *new)
{
    static char text[1 << 16];
    const char *place = old ? strstr(plain, old) : plain + strlen(plain);
    CU_ASSERT_PTR_NOT_NULL_FATAL(place);
    int length =
        snprintf(text, sizeof text, "%.*s%s%s\n", (int)(place - plain), plain, new, place + (old ? strlen(old) : 0));
    CU_ASSERT_FATAL(length > 0 && (size_t)length < sizeof text);
    write_scene(text, (size_t)length);
}

/* Runs the suite with a temporary folder of its own. */
static inline int scene_files_main(const char *suite, const struct unit_test *tests, size_t count)
{
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/scene.lua", folder);
    int result = unit_main(suite, tests, count);
    scratch_folder_remove(folder);
    return result;
}

#endif
