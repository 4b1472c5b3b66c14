// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_SHA256_H_
#define ICPSCAPE_SRC_IO_SHA256_H_

#include <filesystem>
#include <string>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// SHA-256 of a file's bytes, in hexadecimal. Throws InputError where it cannot be read.
std::string Sha256(const std::filesystem::path& path);
/// The same of a text.
std::string Sha256OfText(const std::string& text);
/// Of a scan: its file's bytes, or the coordinates and times of a cloud that was not read from a
/// file.
std::string Sha256OfScan(const std::filesystem::path& file, const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_SHA256_H_
