// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_
#define ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_

#include <filesystem>

namespace icpscape {

/// Whether the header is one that PCL's reader can be trusted with. As of 1.13 it runs off the end
/// of files that are not what they claim, and reserves memory for any number of points that they
/// promise: so keywords, sizes and counts are looked at first, and the promised points must fit the
/// file.
bool PcdHeaderIsSound(const std::filesystem::path& path);
bool PlyHeaderIsSound(const std::filesystem::path& path);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_
