// SPDX-License-Identifier: BSD-3-Clause
// Compiled only for this level; see CMakeLists.txt.
#define ICPSCAPE_SIMD_LEVEL avx512
#define ICPSCAPE_SIMD_WIDTH 16
#include "icpscape/objective/block_kernels.inc"
