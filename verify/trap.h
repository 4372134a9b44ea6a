/* Floating-point traps: where the environment's ASSAY_TRAP is set, an operation whose result is invalid, divided by
 * zero or too large stops the program, and the program says where. Of the programs of this tree alone; glibc only. */
#ifndef VERIFY_TRAP_H
#define VERIFY_TRAP_H

#include <stdbool.h>

/* Call first in main, before any thread is made: threads inherit what is trapped. */
void verify_trap_from_environment(void);
/* Around what others compute with infinities and NaN, or what does so itself and says why; in all threads, so that it
 * is to be called outside parallel loops. The first returns whether traps were set, for the second. */
bool verify_trap_suspend(void);
void verify_trap_resume(bool were_set);

#endif
