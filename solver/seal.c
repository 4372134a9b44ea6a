#include "solver/seal.h"

#include <string.h>

uint64_t solver_seal_sum(uint64_t seed, const void *data, size_t bytes)
{
    const uint64_t prime = UINT64_C(0x100000001b3);
    const unsigned char *at = data;
    uint64_t sum = seed;
    while (bytes > 0) {
        size_t taken = bytes < 8 ? bytes : 8;
        uint64_t word = 0;
        memcpy(&word, at, taken);
        sum = (sum ^ word) * prime;
        sum ^= sum >> 32; /* the product carries upwards only: without this the flips of two signs would cancel */
        at += taken;
        bytes -= taken;
    }
    return sum;
}
