// What every machine of the build's architecture has: registers of 4 floats, 16 of them (x86-64)
// or more.
#define CHOREO_KERNELS kAnyKernels
#define CHOREO_KERNELS_NAME "portable"
#define CHOREO_VECTOR_BYTES 16
#define CHOREO_MOST_ROWS 5
#include "model/engine/packed_kernels_of_one_cpu.h"
