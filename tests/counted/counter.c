/* Stands in front of the compiler's arithmetic of __float128 (the linker's --wrap) and counts. */
extern unsigned long counted;
unsigned long counted;

#define OPERATION(name)                                                                                                \
    __float128 __real_##name(__float128 a, __float128 b);                                                              \
    __float128 __wrap_##name(__float128 a, __float128 b);                                                              \
    __float128 __wrap_##name(__float128 a, __float128 b)                                                               \
    {                                                                                                                  \
        counted++;                                                                                                     \
        return __real_##name(a, b);                                                                                    \
    }

OPERATION(__addtf3)
OPERATION(__subtf3)
OPERATION(__multf3)
OPERATION(__divtf3)
