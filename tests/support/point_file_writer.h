// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_POINT_FILE_WRITER_H_
#define ICPSCAPE_TESTS_SUPPORT_POINT_FILE_WRITER_H_

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "icpscape/common/text.h"

namespace icpscape::testing_support {

/// A field of a file: PCD's TYPE (I, U, F), SIZE and COUNT; a list where it is PLY's.
struct TestField {
  std::string name;
  char type = 'F';
  int size = 4;
  int count = 1;
  bool is_list = false;
};

/// Number k of a field at point i.
using TestValues = std::function<double(const TestField&, int i, int k)>;

template <class T>
void AppendAs(double value, bool big_endian, std::string* out) {
  const T number = static_cast<T>(value);
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), &number, sizeof(T));
  if (big_endian) {
    std::reverse(bytes.begin(), bytes.end());
  }
  out->append(bytes.data(), bytes.size());
}

inline void AppendNumber(const TestField& field, double value, bool big_endian, std::string* out) {
  switch (field.type + 10 * field.size) {
    case 'I' + 10:
      return AppendAs<std::int8_t>(value, big_endian, out);
    case 'I' + 20:
      return AppendAs<std::int16_t>(value, big_endian, out);
    case 'I' + 40:
      return AppendAs<std::int32_t>(value, big_endian, out);
    case 'I' + 80:
      return AppendAs<std::int64_t>(value, big_endian, out);
    case 'U' + 10:
      return AppendAs<std::uint8_t>(value, big_endian, out);
    case 'U' + 20:
      return AppendAs<std::uint16_t>(value, big_endian, out);
    case 'U' + 40:
      return AppendAs<std::uint32_t>(value, big_endian, out);
    case 'U' + 80:
      return AppendAs<std::uint64_t>(value, big_endian, out);
    case 'F' + 40:
      return AppendAs<float>(value, big_endian, out);
    default:
      return AppendAs<double>(value, big_endian, out);
  }
}

/// LZF without any reference back: runs of up to 32 bytes as they are.
inline std::string StoredAsLzf(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 32) {
    const std::string run = bytes.substr(i, 32);
    out += static_cast<char>(run.size() - 1);
    out += run;
  }
  return out;
}

inline std::string PcdHeader(const std::vector<TestField>& fields, int points,
                             const std::string& data) {
  std::string names, sizes, types, counts;
  for (const TestField& field : fields) {
    names += " " + field.name;
    sizes += " " + std::to_string(field.size);
    types += std::string(" ") + field.type;
    counts += " " + std::to_string(field.count);
  }
  const std::string n = std::to_string(points);
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS" + names + "\nSIZE" + sizes + "\nTYPE" + types +
         "\nCOUNT" + counts + "\nWIDTH " + n + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n +
         "\nDATA " + data + "\n";
}

inline std::string TextRows(const std::vector<TestField>& fields, int points,
                            const TestValues& values) {
  std::string text;
  for (int i = 0; i < points; ++i) {
    for (const TestField& field : fields) {
      text += field.is_list ? std::to_string(field.count) + " " : "";
      for (int k = 0; k < field.count; ++k) {
        text += Number(values(field, i, k)) + " ";
      }
    }
    text += "\n";
  }
  return text;
}

/// `data`: ascii, binary or binary_compressed.
inline std::string PcdFile(const std::vector<TestField>& fields, int points,
                           const TestValues& values, const std::string& data) {
  if (data == "ascii") {
    return PcdHeader(fields, points, data) + TextRows(fields, points, values);
  }
  std::string bytes;
  const auto append = [&](const TestField& field, int i) {
    for (int k = 0; k < field.count; ++k) {
      AppendNumber(field, values(field, i, k), false, &bytes);
    }
  };
  if (data == "binary") {
    for (int i = 0; i < points; ++i) {
      for (const TestField& field : fields) {
        append(field, i);
      }
    }
    return PcdHeader(fields, points, data) + bytes;
  }
  for (const TestField& field : fields) {
    for (int i = 0; i < points; ++i) {
      append(field, i);
    }
  }
  const std::string block = StoredAsLzf(bytes);
  std::string sizes;
  AppendAs<std::uint32_t>(static_cast<double>(block.size()), false, &sizes);
  AppendAs<std::uint32_t>(static_cast<double>(bytes.size()), false, &sizes);
  return PcdHeader(fields, points, data) + sizes + block;
}

inline std::string PlyType(const TestField& field) {
  if (field.type == 'F') {
    return field.size == 4 ? "float" : "double";
  }
  return std::string(field.type == 'U' ? "u" : "") + "int" + std::to_string(8 * field.size);
}

/// `format`: ascii, binary_little_endian or binary_big_endian. Lists have `count` numbers.
inline std::string PlyFile(const std::vector<TestField>& fields, int points,
                           const TestValues& values, const std::string& format) {
  std::string text = "ply\nformat " + format + " 1.0\ncomment a test\nelement vertex " +
                     std::to_string(points) + "\n";
  for (const TestField& field : fields) {
    text += std::string("property ") + (field.is_list ? "list uint8 " : "") + PlyType(field) + " " +
            field.name + "\n";
  }
  text += "end_header\n";
  if (format == "ascii") {
    return text + TextRows(fields, points, values);
  }
  const bool big = format == "binary_big_endian";
  for (int i = 0; i < points; ++i) {
    for (const TestField& field : fields) {
      if (field.is_list) {
        text += static_cast<char>(field.count);
      }
      for (int k = 0; k < field.count; ++k) {
        AppendNumber(field, values(field, i, k), big, &text);
      }
    }
  }
  return text;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_POINT_FILE_WRITER_H_
