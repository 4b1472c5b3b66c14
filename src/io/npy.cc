// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/npy.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/io/text_lines.h"

namespace icpscape {
namespace {

struct NpyField {
  std::string name;
  char order = '|';  // '<', '>' or '|'.
  std::string type;  // "f4".
  std::size_t count = 1;
};

struct Header {
  std::vector<NpyField> fields;  // One without a name: an array of numbers.
  bool fortran_order = false;
  std::vector<std::size_t> shape;
};

// Reads the text of a header, which is a Python dictionary.
class Parser {
 public:
  Parser(std::string place, std::string_view text) : place_(std::move(place)), text_(text) {}

  Header Read() {
    Header header;
    Expect('{');
    while (!Takes('}')) {
      const std::string key = String();
      Expect(':');
      if (key == "descr") {
        header.fields = Fields();
      } else if (key == "fortran_order") {
        header.fortran_order = Peek() == 'T';
        Word();
      } else if (key == "shape") {
        header.shape = Shape();
      } else {
        Refuse();
      }
      Takes(',');
    }
    return header;
  }

 private:
  [[noreturn]] void Refuse() const {
    throw InputError(place_ + ": the header has " + Quoted(text_) +
                     "; expected NumPy's descr, fortran_order and shape.");
  }

  char Peek() {
    const std::size_t begin = text_.find_first_not_of(" \n\t");
    text_.remove_prefix(std::min(begin, text_.size()));
    return text_.empty() ? '\0' : text_.front();
  }
  bool Takes(char c) {
    if (Peek() != c) {
      return false;
    }
    text_.remove_prefix(1);
    return true;
  }
  void Expect(char c) {
    if (!Takes(c)) {
      Refuse();
    }
  }

  std::string String() {
    const char quote = Peek();
    if (quote != '\'' && quote != '"') {
      Refuse();
    }
    text_.remove_prefix(1);
    const std::size_t end = text_.find(quote);
    if (end == std::string_view::npos) {
      Refuse();
    }
    std::string string(text_.substr(0, end));
    text_.remove_prefix(end + 1);
    return string;
  }

  std::string_view Word() {
    Peek();
    const std::size_t end = std::min(text_.find_first_of(",:)}] "), text_.size());
    const std::string_view word = text_.substr(0, end);
    text_.remove_prefix(end);
    return word;
  }

  std::vector<std::size_t> Shape() {
    std::vector<std::size_t> shape;
    Expect('(');
    while (!Takes(')')) {
      std::size_t count = 0;
      if (!ParseCount(Word(), &count)) {
        Refuse();
      }
      shape.push_back(count);
      Takes(',');
    }
    return shape;
  }

  NpyField Type(std::string name) {
    NpyField field;
    field.name = std::move(name);
    field.type = String();
    if (field.type.empty()) {
      Refuse();
    }
    field.order = field.type[0];
    field.type.erase(0, 1);
    return field;
  }

  std::vector<NpyField> Fields() {
    if (Peek() != '[') {
      return {Type("")};
    }
    Expect('[');
    std::vector<NpyField> fields;
    while (!Takes(']')) {
      Expect('(');
      std::string name = String();
      Expect(',');
      fields.push_back(Type(std::move(name)));
      Takes(',');
      if (Peek() == '(') {
        for (const std::size_t count : Shape()) {
          constexpr std::size_t kMost = 1000000;
          fields.back().count = std::min(kMost, fields.back().count * std::min(kMost, count));
        }
      }
      Expect(')');
      Takes(',');
    }
    return fields;
  }

  std::string place_;
  std::string_view text_;
};

// A type of numbers, or padding: as so many bytes.
Field FieldOf(const NpyField& npy, const std::string& place) {
  static const std::map<std::string, NumberType> kTypes = {
      {"i1", NumberType::kInt8},   {"i2", NumberType::kInt16},  {"i4", NumberType::kInt32},
      {"i8", NumberType::kInt64},  {"u1", NumberType::kUint8},  {"u2", NumberType::kUint16},
      {"u4", NumberType::kUint32}, {"u8", NumberType::kUint64}, {"f4", NumberType::kFloat},
      {"f8", NumberType::kDouble}};
  const auto found = kTypes.find(npy.type);
  if (found != kTypes.end()) {
    return {npy.name, found->second, npy.count, std::nullopt};
  }
  std::size_t bytes = 0;
  if (npy.type.substr(0, 1) != "V" || !ParseCount(npy.type.substr(1), &bytes) || bytes > 1000000) {
    throw InputError(place + ": numbers of type " + Quoted(npy.type) +
                     "; expected integers of 1 to 8 bytes, or floats of 4 or 8.");
  }
  return {"", NumberType::kUint8, bytes * npy.count, std::nullopt};
}

Header ReadHeader(const std::string& place, const std::string& bytes, std::size_t* begin) {
  const auto byte = [&](std::size_t i) -> std::size_t {
    return i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : 0;
  };
  const bool is_long = byte(6) >= 2;  // The length of the header has 2 bytes, or 4.
  const std::size_t head = is_long ? 12 : 10;
  const std::size_t length =
      byte(8) + 256 * byte(9) + (is_long ? 65536 * (byte(10) + 256 * byte(11)) : 0);
  if (bytes.substr(0, 6) != "\x93NUMPY" || bytes.size() < head || bytes.size() - head < length) {
    throw InputError(place + ": no .npy file; expected a whole one of NumPy's.");
  }
  *begin = head + length;
  return Parser(place, std::string_view(bytes).substr(head, length)).Read();
}

// The fields of one point.
std::vector<Field> FieldsOf(const Header& header, const std::string& place) {
  std::vector<Field> fields;
  const bool is_array = header.fields.size() == 1 && header.fields[0].name.empty();
  const std::size_t columns = header.shape.size() == 2 ? header.shape[1] : 0;
  if (is_array ? columns < 3 || columns > 1000 : header.shape.size() != 1) {
    throw InputError(place + ": an array of " + std::to_string(header.shape.size()) +
                     " dimensions with " + std::to_string(columns) +
                     " columns; expected N x 3 or more numbers, or N records with names.");
  }
  if (!is_array) {
    for (const NpyField& field : header.fields) {
      fields.push_back(FieldOf(field, place));
    }
    return fields;
  }
  static const std::array<const char*, 4> kNames = {"x", "y", "z", "intensity"};
  const Field number = FieldOf(header.fields[0], place);
  for (std::size_t i = 0; i < columns; ++i) {
    fields.push_back(number);
    fields.back().name = i < 3 || columns == 4 ? kNames[i] : "";
  }
  return fields;
}

bool IsBigEndian(const Header& header, const std::string& place) {
  bool big = false, little = false;
  for (const NpyField& field : header.fields) {
    big = big || field.order == '>';
    little = little || field.order == '<' || field.order == '=';
  }
  if (big && little) {
    throw InputError(place + ": fields of both byte orders; expected one.");
  }
  return big;
}

}  // namespace

PointTable ReadNpy(const std::string& place, std::string bytes) {
  std::size_t begin = 0;
  const Header header = ReadHeader(place, bytes, &begin);
  const std::vector<Field> fields = FieldsOf(header, place);
  std::size_t record = 0;
  for (const Field& field : fields) {
    record += field.count * BytesOf(field.type);
  }
  const std::size_t left = bytes.size() - begin;
  PointTable table;
  table.place = place;
  table.size = header.shape[0];
  table.big_endian = IsBigEndian(header, place);
  if (record == 0 || left % record != 0 || left / record != table.size) {
    throw InputError(place + ": " + std::to_string(left) + " bytes follow the header; expected " +
                     std::to_string(table.size) + " points of " + std::to_string(record) +
                     " bytes.");
  }
  // Fortran's order is column after column.
  const bool by_column = header.fortran_order && header.shape.size() == 2;
  std::size_t offset = 0;
  for (const Field& field : fields) {
    const std::size_t size = field.count * BytesOf(field.type);
    table.columns.push_back({field.name, field.type,
                             begin + (by_column ? offset * table.size : offset),
                             by_column ? size : record});
    offset += size;
  }
  table.bytes = std::move(bytes);
  return table;
}

}  // namespace icpscape
