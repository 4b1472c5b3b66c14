// SPDX-License-Identifier: BSD-3-Clause
// Compiled for this level alone; see CMakeLists.txt.
#include "src/neighbors/search_kernels.inc"
