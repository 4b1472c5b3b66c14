// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/point_file_header.h"

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace icpscape {
namespace {

// No header is longer than this.
constexpr std::streamoff kLongestHeader = 1 << 16;

// The next line without its end; false at the end of the file or of what may be a header.
bool NextLine(std::ifstream* in, std::string* line) {
  if (in->tellg() > kLongestHeader || !std::getline(*in, *line)) {
    return false;
  }
  if (!line->empty() && line->back() == '\r') {
    line->pop_back();
  }
  return true;
}

std::vector<std::string> Words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) {
    words.push_back(word);
  }
  return words;
}

// A count between 1 and 1e10, or 0 where the word is not one.
std::uintmax_t Count(const std::string& word) {
  std::uintmax_t count = 0;
  for (const char c : word) {
    if (c < '0' || c > '9' || count > 1000000000) {
      return 0;
    }
    count = 10 * count + static_cast<std::uintmax_t>(c - '0');
  }
  return count;
}

}  // namespace

bool PcdHeaderIsSound(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::map<std::string, std::vector<std::string>> header;
  std::string line;
  while (header.count("DATA") == 0) {
    if (!NextLine(&in, &line)) {
      return false;
    }
    std::vector<std::string> words = Words(line);
    if (words.empty() || words[0][0] == '#') {
      continue;
    }
    static const std::array<const char*, 11> kKeywords = {
        "VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
        "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
    bool known = false;
    for (const char* keyword : kKeywords) {
      known |= words[0] == keyword;
    }
    const std::string keyword = words[0] == "COLUMNS" ? "FIELDS" : words[0];
    words.erase(words.begin());
    if (!known || !header.emplace(keyword, words).second) {
      return false;
    }
  }
  const std::size_t fields = header["FIELDS"].size();
  if (fields == 0 || header["SIZE"].size() != fields || header["TYPE"].size() != fields ||
      (header.count("COUNT") != 0 && header["COUNT"].size() != fields)) {
    return false;
  }
  std::uintmax_t point_bytes = 0;
  for (std::size_t i = 0; i < fields; ++i) {
    const std::uintmax_t size = Count(header["SIZE"][i]);
    const std::uintmax_t count = header.count("COUNT") != 0 ? Count(header["COUNT"][i]) : 1;
    const std::string& type = header["TYPE"][i];
    if ((size != 1 && size != 2 && size != 4 && size != 8) || count < 1 || count > 1000000 ||
        (type != "F" && type != "I" && type != "U")) {
      return false;
    }
    point_bytes += size * count;
  }
  for (const char* one : {"WIDTH", "HEIGHT", "POINTS", "DATA"}) {
    if (header[one].size() != 1) {
      return false;
    }
  }
  const std::uintmax_t points = Count(header["POINTS"][0]);
  if (points == 0 || Count(header["WIDTH"][0]) * Count(header["HEIGHT"][0]) != points) {
    return false;
  }
  const auto begin = static_cast<std::uintmax_t>(in.tellg());
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  const std::uintmax_t data_bytes = bytes > begin ? bytes - begin : 0;
  const std::string& encoding = header["DATA"][0];
  if (encoding == "binary") {
    return points * point_bytes <= data_bytes;
  }
  if (encoding == "ascii") {
    return 2 * points * fields <= data_bytes + 1;  // A digit and a blank a number.
  }
  // LZF gets 264 bytes out of 3 at the very best.
  return encoding == "binary_compressed" && points * point_bytes <= 100 * data_bytes;
}

bool PlyHeaderIsSound(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::uintmax_t bytes = std::filesystem::file_size(path);
  std::string line;
  if (!NextLine(&in, &line) || line != "ply") {
    return false;
  }
  bool has_format = false;
  bool has_vertices = false;
  while (NextLine(&in, &line)) {
    const std::vector<std::string> words = Words(line);
    if (words.empty()) {
      return false;
    }
    if (words[0] == "end_header") {
      return has_format && has_vertices;
    }
    if (words[0] == "format") {
      has_format = true;
    } else if (words[0] == "element") {
      // No element takes less than a byte.
      if (words.size() != 3 || Count(words[2]) > bytes) {
        return false;
      }
      has_vertices |= words[1] == "vertex" && Count(words[2]) > 0;
    } else if (words[0] != "property" && words[0] != "comment" && words[0] != "obj_info") {
      return false;
    }
  }
  return false;
}

}  // namespace icpscape
