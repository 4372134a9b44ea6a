/* Where the program finds what comes with it. */
#include "tests/unit/scratch.h"
#include "tests/unit/unit.h"
#include "verify/find.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* An installed tree, which is then moved. */
static char root[SCRATCH];

static const char *in_root(const char *name)
{
    static char path[4][VERIFY_PATH];
    static int turn;
    turn = (turn + 1) % 4;
    (void)snprintf(path[turn], VERIFY_PATH, "%s/%s", root, name);
    return path[turn];
}

static void beside_the_program(void)
{
    char folder[VERIFY_PATH];
    CU_ASSERT_TRUE_FATAL(verify_folder_installed(VERIFY_FOLDER_SCENES, in_root("a/bin/assay"), folder));
    CU_ASSERT_STRING_EQUAL(folder, in_root("a/share/assay/scenes"));
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_GOLDEN, in_root("a/bin/assay"), folder)); /* not there */
}

static void wherever_it_is_moved_to(void)
{
    char folder[VERIFY_PATH];
    CU_ASSERT_EQUAL_FATAL(rename(in_root("a"), in_root("b")), 0);
    CU_ASSERT_TRUE(verify_folder_installed(VERIFY_FOLDER_SCENES, in_root("b/bin/assay"), folder));
    CU_ASSERT_STRING_EQUAL(folder, in_root("b/share/assay/scenes"));
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_SCENES, in_root("a/bin/assay"), folder));
    CU_ASSERT_EQUAL_FATAL(rename(in_root("b"), in_root("a")), 0);
}

/* From there ../share is reached as well, but it is no folder of programs. */
static void not_from_a_build_tree(void)
{
    char folder[VERIFY_PATH];
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_SCENES, in_root("a/build/assay"), folder));
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_SCENES, in_root("a/cabin/assay"), folder));
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_SCENES, "assay", folder));
    CU_ASSERT_FALSE(verify_folder_installed(VERIFY_FOLDER_SCENES, "", folder));
}

static void in_the_source_tree(void)
{
    char folder[VERIFY_PATH];
    verify_folder_find(VERIFY_FOLDER_SCENES, folder);
    CU_ASSERT_STRING_EQUAL(folder, TEST_SOURCE_DIR "/verify/scenes");
    verify_folder_find(VERIFY_FOLDER_GOLDEN, folder);
    CU_ASSERT_STRING_EQUAL(folder, TEST_SOURCE_DIR "/golden");
}

/* A result cannot be written where a folder stands: that is said before a run, not after it. */
static void nothing_in_the_way(void)
{
    char folder[VERIFY_PATH], out[VERIFY_PATH];
    struct solver_error error = {.text = ""};
    (void)snprintf(out, sizeof out, "%s", in_root("a/results"));
    const struct verify_options options = {.out = out};
    CU_ASSERT_TRUE(verify_out_folder(&options, "cube", folder, &error));
    CU_ASSERT_STRING_EQUAL(folder, out);
    CU_ASSERT_EQUAL(mkdir(in_root("a/results/cube.png"), 0777), 0);
    CU_ASSERT_FALSE(verify_out_folder(&options, "cube", folder, &error));
    CU_ASSERT_PTR_NOT_NULL(strstr(error.text, "results/cube.png: is a folder"));
    CU_ASSERT_TRUE(verify_out_folder(&options, "ball", folder, &error));
}

int main(void)
{
    static const struct unit_test tests[] = {
        {"beside the program", beside_the_program},
        {"wherever it is moved to", wherever_it_is_moved_to},
        {"not from a build tree", not_from_a_build_tree},
        {"in the source tree", in_the_source_tree},
        {"nothing in the way of results", nothing_in_the_way},
    };
    scratch_folder(root);
    static const char *const folders[] = {
        "a", "a/bin", "a/cabin", "a/build", "a/share", "a/share/assay", "a/share/assay/scenes"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        if (mkdir(in_root(folders[i]), 0777) != 0) {
            return 1;
        }
    }
    const int result = unit_main("find", tests, sizeof tests / sizeof *tests);
    scratch_folder_remove(root);
    return result;
}
