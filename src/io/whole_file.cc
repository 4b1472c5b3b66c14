// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/whole_file.h"

#include <cstdint>
#include <fstream>

#include "icpscape/common/error.h"

namespace icpscape {

std::string ReadWholeFile(const std::filesystem::path& path, const std::string& what) {
  std::error_code error;
  const bool is_file = std::filesystem::is_regular_file(path, error);
  std::ifstream in(path, std::ios::binary);
  if (!is_file || !in) {
    throw InputError(path.string() + ": cannot be read; expected " + what + ".");
  }
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  std::string text(error ? 0 : static_cast<std::size_t>(bytes), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (error || !in) {
    throw InputError(path.string() + ": reading stopped before byte " + std::to_string(bytes) +
                     "; expected the whole file.");
  }
  return text;
}

}  // namespace icpscape
