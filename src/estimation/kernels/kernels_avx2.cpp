// Compiled with -mavx2 (see CMakeLists.txt); run only where the processor has it.
#if defined(__AVX2__)
#define STDC_KERNELS for_avx2
#include "estimation/kernels/kernels.inl"
#endif
