#define DIM 3
#include "tests/unit/spectrum.h"

int main(void)
{
    return spectrum_main("principal values and directions, 3D");
}
