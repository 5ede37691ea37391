// Compiled for AVX2 and FMA; only called on processors that have them.
#define NADE_TREE_KERNELS tree_kernels_avx2
#include "triangle_tree_kernels.h"
