#define NADE_TREE_KERNELS tree_kernels_baseline
#include "triangle_tree_kernels.h"
