/* Files and folders: whole or absent. */
#ifndef VERIFY_FILES_H
#define VERIFY_FILES_H

#include "solver/error.h"

#include <stddef.h>

enum { VERIFY_PATH = 4096 };

/* Writes `size` bytes beside `path`, flushes them to the disk and renames. Refuses to replace what is not a plain
 * file (a folder, a device, a link). */
bool verify_file_write(const char *path, const void *bytes, size_t size, struct solver_error *error);
/* Whether that is to be expected to work, before anything is computed that would be lost: no such thing in the way, and
 * a folder that takes files. */
bool verify_file_check(const char *path, struct solver_error *error);
/* Reads a whole file; the caller frees. A NUL byte follows the last one. Refuses files of more than 1 GiB. */
bool verify_file_read(const char *path, char **bytes, size_t *size, struct solver_error *error);
/* Makes a folder and those above it, where they are missing. */
bool verify_folder_make(const char *path, struct solver_error *error);
/* Whether both are there and are one file, by whatever names. */
bool verify_file_same(const char *one, const char *other);
/* "FOLDER/NAME.ENDING" into a path of VERIFY_PATH bytes. */
bool verify_path_join(char *path, const char *folder, const char *name, const char *ending, struct solver_error *error);

#endif
