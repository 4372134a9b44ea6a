#define DIM 2
#include "tests/unit/spectrum.h"

int main(void)
{
    return spectrum_main("principal values and directions, 2D");
}
