// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/ply.h"

#include <algorithm>
#include <map>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/io/binary_records.h"
#include "icpscape/io/text_lines.h"
#include "icpscape/io/text_records.h"

namespace icpscape {
namespace {

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Field> fields;
};

struct Header {
  std::string format;
  std::vector<Element> elements;
};

[[noreturn]] void Refuse(const TextLines& lines, std::string_view word,
                         const std::string& expected) {
  throw InputError(lines.Place() + ": " + Quoted(word) + "; expected " + expected + ".");
}

NumberType TypeOf(std::string_view word, const TextLines& lines) {
  static const std::map<std::string_view, NumberType> kTypes = {
      {"char", NumberType::kInt8},     {"int8", NumberType::kInt8},
      {"uchar", NumberType::kUint8},   {"uint8", NumberType::kUint8},
      {"short", NumberType::kInt16},   {"int16", NumberType::kInt16},
      {"ushort", NumberType::kUint16}, {"uint16", NumberType::kUint16},
      {"int", NumberType::kInt32},     {"int32", NumberType::kInt32},
      {"uint", NumberType::kUint32},   {"uint32", NumberType::kUint32},
      {"int64", NumberType::kInt64},   {"uint64", NumberType::kUint64},
      {"float", NumberType::kFloat},   {"float32", NumberType::kFloat},
      {"double", NumberType::kDouble}, {"float64", NumberType::kDouble}};
  const auto found = kTypes.find(word);
  if (found == kTypes.end()) {
    Refuse(lines, word, "a type of PLY's, like float or double");
  }
  return found->second;
}

// "property TYPE NAME", or "property list TYPE TYPE NAME".
Field PropertyOf(const std::vector<std::string_view>& words, const TextLines& lines) {
  Field field;
  if (words.size() == 3) {
    field.type = TypeOf(words[1], lines);
  } else if (words.size() == 5 && words[1] == "list") {
    field.list_count = TypeOf(words[2], lines);
    field.type = TypeOf(words[3], lines);
    if (!IsWhole(*field.list_count) || BytesOf(*field.list_count) > 4) {
      Refuse(lines, words[2], "a list with a length of 8, 16 or 32 bits");
    }
  } else {
    Refuse(lines, words[0], "\"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
  }
  field.name = words.back();
  return field;
}

Element ElementOf(const std::vector<std::string_view>& words, const TextLines& lines) {
  Element element;
  if (words.size() != 3 || !ParseCount(words[2], &element.count)) {
    Refuse(lines, words.back(), "\"element NAME COUNT\"");
  }
  element.name = words[1];
  return element;
}

Header ReadHeader(TextLines* lines) {
  std::vector<std::string_view> words;
  if (!lines->NextWords(&words) || words[0] != "ply") {
    throw InputError(lines->file() + ": no PLY file; expected \"ply\" in its first line.");
  }
  Header header;
  while (lines->NextWords(&words)) {
    if (words[0] == "end_header") {
      return header;
    }
    if (words[0] == "format" && words.size() == 3 && header.format.empty()) {
      header.format = words[1];
    } else if (words[0] == "element") {
      header.elements.push_back(ElementOf(words, *lines));
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().fields.push_back(PropertyOf(words, *lines));
    } else if (words[0] != "comment" && words[0] != "obj_info") {
      Refuse(*lines, words[0], "a line of a PLY header");
    }
  }
  throw InputError(lines->file() + ": no line \"end_header\"; expected a whole PLY file.");
}

void CheckHeader(const Header& header, const std::string& place) {
  if (header.format != "ascii" && header.format != "binary_little_endian" &&
      header.format != "binary_big_endian") {
    throw InputError(place + ": format " + Quoted(header.format) +
                     "; expected ascii, binary_little_endian or binary_big_endian.");
  }
  const auto vertices = std::count_if(header.elements.begin(), header.elements.end(),
                                      [](const Element& e) { return e.name == "vertex"; });
  if (vertices != 1) {
    throw InputError(place + ": " + std::to_string(vertices) +
                     " elements \"vertex\"; expected one.");
  }
}

}  // namespace

PointTable ReadPly(const std::string& place, const std::string& bytes) {
  TextLines lines(place, bytes);
  const Header header = ReadHeader(&lines);
  CheckHeader(header, place);
  const bool is_text = header.format == "ascii";
  BinaryPart part = {bytes, lines.position(), header.format == "binary_big_endian"};
  PointTable points;
  for (const Element& element : header.elements) {
    PointTable table = is_text ? ReadTextRecords(element.fields, element.count, &lines)
                               : ReadBinaryRecords(place, element.fields, element.count, &part);
    if (element.name == "vertex") {
      points = std::move(table);
    }
  }
  if (is_text) {
    RequireEnd(&lines);
  } else if (part.position != bytes.size()) {
    throw InputError(place + ": " + std::to_string(bytes.size() - part.position) +
                     " bytes after the last record; expected a file as its header says.");
  }
  return points;
}

}  // namespace icpscape
