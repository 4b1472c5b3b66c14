// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_WHOLE_FILE_H_
#define ICPSCAPE_SRC_IO_WHOLE_FILE_H_

#include <filesystem>
#include <string>

namespace icpscape {

/// All bytes of a file. Throws InputError for what is no regular file or cannot be read; `what`
/// says what was expected there ("a KITTI velodyne scan").
std::string ReadWholeFile(const std::filesystem::path& path, const std::string& what);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_WHOLE_FILE_H_
