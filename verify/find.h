/* Scenes by name or path. */
#ifndef VERIFY_FIND_H
#define VERIFY_FIND_H

#include "solver/scene.h"
#include "verify/files.h"
#include "verify/options.h"

enum { VERIFY_SCENES = 256 };

/* Names of the scenes that come with the program, sorted. */
struct verify_scenes {
    char folder[VERIFY_PATH];
    size_t count;
    char name[VERIFY_SCENES][SOLVER_NAME];
};

/* Lists those of verify_folder_find. */
bool verify_scenes_list(struct verify_scenes *scenes, struct solver_error *error);
/* The file of a scene: WORD itself if it ends in .lua or holds a slash, else WORD.lua among the program's scenes. */
bool verify_scene_find(const char *word, char path[VERIFY_PATH], struct solver_error *error);
/* Finds and loads the first operand with the overrides of the command line; n > 0 overrides n as well. */
bool verify_scene_open(const struct verify_options *options, int n, struct solver_scene **scene,
                       struct solver_error *error);
/* The folder for the files written: --out, or out/SCENE; made if missing. */
bool verify_out_folder(const struct verify_options *options, const char *scene_name, char folder[VERIFY_PATH],
                       struct solver_error *error);

/* The folders that come with the program. */
enum verify_folder { VERIFY_FOLDER_SCENES, VERIFY_FOLDER_GOLDEN };
/* Where one of them is: beside the program if that is installed, wherever it was moved to; else in the source tree that
 * it was built from; else in the source tree that it is started in, which need not be there. */
void verify_folder_find(enum verify_folder which, char folder[VERIFY_PATH]);
/* The same beside a program of that absolute path. False if it lies in no folder of programs, or nothing is there. */
bool verify_folder_installed(enum verify_folder which, const char *program, char folder[VERIFY_PATH]);

#endif
