/* The seal that a file of this program ends with: eight bytes, then the checksum of all before them. It tells a file
 * that is cut short, damaged or edited from a whole one before anything in it is believed. For records that matters
 * twice: HDF5's own checksums cover neither values nor all of the structure, and its library may crash on what is
 * damaged, so it is shown no file whose seal is broken. HDF5 readers pass over the seal. */
#ifndef SOLVER_SEAL_H
#define SOLVER_SEAL_H

#include <stddef.h>
#include <stdint.h>

_Static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "checksums are little-endian, as on disk");

#define SOLVER_SEAL "assaySUM"
enum { SOLVER_SEAL_SIZE = 16 };

/* Like FNV-1a, eight bytes at a time: each step is one-to-one, so a single changed word always changes the sum. Sums
 * chain where all parts but the last are whole words; a last part is taken as if zeros filled its word. */
uint64_t solver_seal_sum(uint64_t seed, const void *data, size_t bytes);
#define SOLVER_SEAL_SEED UINT64_C(0xcbf29ce484222325)

#endif
