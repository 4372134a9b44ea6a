/* Folders and files that a test has for itself: below the environment's TMPDIR, or where the system keeps such. A
 * program that cannot have one ends and says why. */
#ifndef TESTS_SCRATCH_H
#define TESTS_SCRATCH_H

/* Bytes of a path that is made here, and of one below it. */
enum { SCRATCH = 256, SCRATCH_BELOW = SCRATCH + 32 };

/* Makes an empty folder and writes its path. */
void scratch_folder(char path[SCRATCH]);
/* Removes it and all that is in it. */
void scratch_folder_remove(const char *path);

/* Makes an empty file and writes its path. */
void scratch_file(char path[SCRATCH]);
/* The same of a file that holds the text. */
void scratch_text(char path[SCRATCH], const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
