// SPDX-License-Identifier: BSD-3-Clause
// Compiled for this level alone; see CMakeLists.txt.
#include "src/objective/block_kernels.inc"
