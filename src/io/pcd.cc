// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/pcd.h"

#include <lzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/io/text_lines.h"
#include "icpscape/io/text_records.h"

namespace icpscape {
namespace {

// The words behind each keyword.
using Header = std::map<std::string, std::vector<std::string>, std::less<>>;

[[noreturn]] void Refuse(const std::string& place, const std::string& what,
                         const std::string& expected) {
  throw InputError(place + ": " + what + "; expected " + expected + ".");
}

bool IsKeyword(std::string_view word) {
  static const std::array<std::string_view, 10> kKeywords = {
      "VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
      "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  for (const std::string_view keyword : kKeywords) {
    if (word == keyword) {
      return true;
    }
  }
  return false;
}

Header ReadHeader(TextLines* lines) {
  Header header;
  std::vector<std::string_view> words;
  while (header.count("DATA") == 0) {
    if (!lines->NextWords(&words)) {
      Refuse(lines->file(), "no line DATA", "a whole PCD file");
    }
    if (words[0][0] == '#') {
      continue;
    }
    const std::string_view keyword = words[0] == "COLUMNS" ? "FIELDS" : words[0];
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    if (!IsKeyword(keyword) || !header.emplace(keyword, rest).second) {
      Refuse(lines->Place(), Quoted(words[0]), "a line of a PCD header");
    }
  }
  return header;
}

const std::vector<std::string>& WordsOf(const Header& header, const char* keyword,
                                        std::size_t count, const std::string& place) {
  const auto found = header.find(keyword);
  if (found == header.end() || found->second.size() != count) {
    Refuse(place,
           found == header.end()
               ? std::string("no line ") + keyword
               : std::string(keyword) + " has " + std::to_string(found->second.size()) + " words",
           std::string(keyword) + " with " + std::to_string(count));
  }
  return found->second;
}

std::size_t CountOf(const std::string& word, const char* keyword, const std::string& place) {
  std::size_t count = 0;
  if (!ParseCount(word, &count) || count == 0) {
    Refuse(place, std::string(keyword) + " " + Quoted(word), "a count above 0");
  }
  return count;
}

NumberType TypeOf(const std::string& type, const std::string& size, const std::string& place) {
  static const std::map<std::string, NumberType> kTypes = {
      {"I1", NumberType::kInt8},   {"I2", NumberType::kInt16},  {"I4", NumberType::kInt32},
      {"I8", NumberType::kInt64},  {"U1", NumberType::kUint8},  {"U2", NumberType::kUint16},
      {"U4", NumberType::kUint32}, {"U8", NumberType::kUint64}, {"F4", NumberType::kFloat},
      {"F8", NumberType::kDouble}};
  const auto found = kTypes.find(type + size);
  if (found == kTypes.end()) {
    Refuse(place, "TYPE " + Quoted(type) + " of SIZE " + Quoted(size),
           "I or U of 1, 2, 4 or 8 bytes, or F of 4 or 8");
  }
  return found->second;
}

std::vector<Field> FieldsOf(const Header& header, const std::string& place) {
  const auto names = header.find("FIELDS");
  if (names == header.end() || names->second.empty()) {
    Refuse(place, "no line FIELDS", "a whole PCD file");
  }
  const std::size_t size = names->second.size();
  const auto& sizes = WordsOf(header, "SIZE", size, place);
  const auto& types = WordsOf(header, "TYPE", size, place);
  const std::vector<std::string> ones(size, "1");
  const auto& counts = header.count("COUNT") != 0 ? WordsOf(header, "COUNT", size, place) : ones;
  std::vector<Field> fields;
  for (std::size_t i = 0; i < size; ++i) {
    fields.push_back({names->second[i], TypeOf(types[i], sizes[i], place),
                      CountOf(counts[i], "COUNT", place), std::nullopt});
  }
  return fields;
}

std::size_t PointsOf(const Header& header, const std::string& place) {
  const auto count = [&](const char* keyword) {
    return CountOf(WordsOf(header, keyword, 1, place)[0], keyword, place);
  };
  const std::size_t points = count("POINTS"), width = count("WIDTH"), height = count("HEIGHT");
  if (points % width != 0 || points / width != height) {
    Refuse(place,
           std::to_string(points) + " points of WIDTH " + std::to_string(width) + " and HEIGHT " +
               std::to_string(height),
           "POINTS to be their product");
  }
  return points;
}

std::optional<Vec3> SensorOf(const Header& header, const std::string& place) {
  if (header.count("VIEWPOINT") == 0) {
    return std::nullopt;
  }
  std::array<double, 7> values;
  const auto& words = WordsOf(header, "VIEWPOINT", values.size(), place);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!ParseWord(words[i], &values[i]) || !std::isfinite(values[i])) {
      Refuse(place, "VIEWPOINT has " + Quoted(words[i]), "seven numbers");
    }
  }
  return Vec3(values[0], values[1], values[2]);
}

std::uint32_t Uint32At(const std::string& bytes, std::size_t position) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + position, sizeof(value));
  return value;
}

// The block behind the header: its length, its length when whole, and itself.
std::string Decompressed(const std::string& place, const std::string& bytes, std::size_t position,
                         std::size_t expected) {
  constexpr std::size_t kHead = 2 * sizeof(std::uint32_t);
  constexpr std::size_t kMostGain = 88;  // LZF makes 264 bytes of 3 at the very best.
  const std::size_t left = bytes.size() - position;
  const std::size_t compressed = left < kHead ? 0 : Uint32At(bytes, position);
  const std::size_t whole = left < kHead ? 0 : Uint32At(bytes, position + sizeof(std::uint32_t));
  if (left < kHead || compressed > left - kHead || whole != expected ||
      expected > kMostGain * compressed) {
    Refuse(place,
           "a compressed block of " + std::to_string(compressed) + " bytes for " +
               std::to_string(whole) + ", in " + std::to_string(left) + " bytes",
           "a whole one for " + std::to_string(expected));
  }
  std::string out(expected, '\0');
  if (lzf_decompress(bytes.data() + position + kHead, static_cast<unsigned>(compressed), out.data(),
                     static_cast<unsigned>(expected)) != expected) {
    Refuse(place, "the compressed block is damaged",
           "LZF of " + std::to_string(expected) + " bytes");
  }
  return out;
}

PointTable BinaryTable(const std::string& place, const std::vector<Field>& fields,
                       std::size_t points, std::size_t begin, bool is_compressed,
                       std::string bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 40;
  std::size_t record = 0;
  for (const Field& field : fields) {
    record += std::min(field.count * BytesOf(field.type), kMost);
    record = std::min(record, kMost);  // No sum of theirs wraps around.
  }
  const std::size_t left = bytes.size() - begin;
  if (record == 0 || record == kMost ||
      (is_compressed ? points > kMost / record : left % record != 0 || left / record != points)) {
    Refuse(place, std::to_string(left) + " bytes follow the header",
           std::to_string(points) + " points of " + std::to_string(record) + " bytes");
  }
  PointTable table;
  table.place = place;
  table.size = points;
  // Compressed files hold field after field, others point after point.
  std::size_t offset = 0;
  for (const Field& field : fields) {
    const std::size_t bytes_of_field = field.count * BytesOf(field.type);
    table.columns.push_back({field.name, field.type,
                             is_compressed ? offset * points : begin + offset,
                             is_compressed ? bytes_of_field : record});
    offset += bytes_of_field;
  }
  table.bytes =
      is_compressed ? Decompressed(place, bytes, begin, points * record) : std::move(bytes);
  return table;
}

}  // namespace

PointTable ReadPcd(const std::string& place, std::string bytes) {
  TextLines lines(place, bytes);
  const Header header = ReadHeader(&lines);
  const std::vector<Field> fields = FieldsOf(header, place);
  const std::size_t points = PointsOf(header, place);
  const std::optional<Vec3> sensor = SensorOf(header, place);
  const std::string data = WordsOf(header, "DATA", 1, place)[0];
  PointTable table;
  if (data == "ascii") {
    table = ReadTextRecords(fields, points, &lines);
    RequireEnd(&lines);
  } else if (data == "binary" || data == "binary_compressed") {
    table =
        BinaryTable(place, fields, points, lines.position(), data != "binary", std::move(bytes));
  } else {
    Refuse(place, "DATA " + Quoted(data), "ascii, binary or binary_compressed");
  }
  table.sensor = sensor;
  return table;
}

}  // namespace icpscape
