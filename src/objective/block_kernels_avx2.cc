// SPDX-License-Identifier: BSD-3-Clause
// Compiled only for this level; see CMakeLists.txt.
#define ICPSCAPE_SIMD_LEVEL avx2
#define ICPSCAPE_SIMD_WIDTH 8
#include "icpscape/objective/block_kernels.inc"
