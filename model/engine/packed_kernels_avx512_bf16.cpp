// As packed_kernels_avx512.cpp, but for products of pairs of bfloat16, summed in float32.
#define CHOREO_KERNELS kAvx512Bf16Kernels
#define CHOREO_KERNELS_NAME "avx512_bf16"
#define CHOREO_VECTOR_BYTES 64
#define CHOREO_MOST_ROWS 12
#define CHOREO_BF16 1
#include "model/engine/packed_kernels_of_one_cpu.h"
