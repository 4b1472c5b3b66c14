// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_
#define ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_

#include <filesystem>

namespace icpscape {

/// Whether PCL's reader can be trusted with the file. PCL 1.13 reads beyond the end of malformed
/// files and reserves memory for any number of points in the header. So keywords, sizes and counts
/// are checked first, and the points of the header must fit the file.
bool PcdHeaderIsSound(const std::filesystem::path& path);
bool PlyHeaderIsSound(const std::filesystem::path& path);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_POINT_FILE_HEADER_H_
