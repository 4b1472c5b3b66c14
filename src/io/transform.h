// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_TRANSFORM_H_
#define ICPSCAPE_SRC_IO_TRANSFORM_H_

#include <filesystem>
#include <string>

#include "icpscape/residuals/lie.h"

namespace icpscape {

/// A rigid transform from 12 numbers (3x4, row-major) or 16 (4x4). Text rounds: up to 1e-3 off a
/// rotation is accepted and projected back onto SO(3). Throws InputError naming `place`.
SE3d ParseTransform(const std::string& text, const std::string& place);

/// Reads a text file of a 3x4 or 4x4 matrix. Throws InputError.
SE3d ReadTransform(const std::filesystem::path& path);

/// Four rows of four numbers that read back exactly.
std::string FormatTransform(const SE3d& T);

/// The upper 3x4 as one row of twelve numbers that read back exactly: KITTI's way.
std::string FormatTransformRow(const SE3d& T);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_TRANSFORM_H_
