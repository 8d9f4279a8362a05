// 32 registers of 16 floats: 24 sums, 2 of weights. CMakeLists.txt allows the instructions.
#define CHOREO_KERNELS kAvx512Kernels
#define CHOREO_KERNELS_NAME "avx512"
#define CHOREO_VECTOR_BYTES 64
#define CHOREO_MOST_ROWS 12
#include "model/engine/packed_kernels_of_one_cpu.h"
