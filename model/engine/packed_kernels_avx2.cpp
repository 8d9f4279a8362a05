// 16 registers of 8 floats: 12 sums, 2 of weights. CMakeLists.txt allows the instructions.
#define CHOREO_KERNELS kAvx2Kernels
#define CHOREO_KERNELS_NAME "avx2"
#define CHOREO_VECTOR_BYTES 32
#define CHOREO_MOST_ROWS 6
#include "model/engine/packed_kernels_of_one_cpu.h"
