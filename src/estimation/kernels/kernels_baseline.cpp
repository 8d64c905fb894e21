#define STDC_KERNELS for_baseline
#include "estimation/kernels/kernels.inl"
