// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/binary_records.h"

#include <algorithm>
#include <cstdint>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

// The length of a list: a whole number of 1 to 4 bytes.
std::size_t LengthAt(const BinaryPart& part, std::size_t bytes) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    const std::size_t from = part.big_endian ? i : bytes - 1 - i;
    length = 256 * length + static_cast<std::uint8_t>(part.bytes[part.position + from]);
  }
  return length;
}

[[noreturn]] void RefuseShort(const std::string& place, std::size_t record, std::size_t count) {
  throw InputError(place + ": ends within record " + std::to_string(record) + " of " +
                   std::to_string(count) + "; expected a whole file.");
}

// The least bytes of a record: no list has a number.
std::size_t LeastBytes(const std::vector<Field>& fields) {
  std::size_t bytes = 0;
  for (const Field& field : fields) {
    bytes += field.list_count ? BytesOf(*field.list_count) : field.count * BytesOf(field.type);
  }
  return bytes;
}

// Moves to the end of the record, and appends the bytes of its used numbers.
bool ReadRecord(const std::vector<Field>& fields, const std::vector<char>& used, BinaryPart* part,
                std::string* bytes) {
  const auto has = [&](std::size_t more) { return more <= part->bytes.size() - part->position; };
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::size_t size = BytesOf(fields[f].type);
    std::size_t numbers = fields[f].count;
    if (fields[f].list_count) {
      const std::size_t head = BytesOf(*fields[f].list_count);
      if (!has(head)) {
        return false;
      }
      numbers = LengthAt(*part, head);
      part->position += head;
    }
    if (!has(numbers * size)) {
      return false;
    }
    if (used[f] != 0) {
      bytes->append(part->bytes, part->position, size);
    }
    part->position += numbers * size;
  }
  return true;
}

}  // namespace

PointTable ReadBinaryRecords(const std::string& place, const std::vector<Field>& fields,
                             std::size_t count, BinaryPart* part) {
  const std::size_t left = part->bytes.size() - part->position;
  const std::size_t least = LeastBytes(fields);
  if (least > 0 && count > left / least) {
    RefuseShort(place, left / least, count);
  }
  PointTable table;
  table.place = place;
  table.size = count;
  table.big_endian = part->big_endian;
  std::vector<char> used;
  std::size_t stride = 0;
  for (const Field& field : fields) {
    used.push_back(!field.list_count && IsUsed(field.name) ? 1 : 0);
    if (used.back() != 0) {
      table.columns.push_back({field.name, field.type, stride, 0});
      stride += BytesOf(field.type);
    }
  }
  for (Column& column : table.columns) {
    column.stride = stride;
  }
  table.bytes.reserve(count * stride);
  const bool is_fixed = std::none_of(fields.begin(), fields.end(), [](const Field& field) {
    return field.list_count.has_value();
  });
  if (is_fixed && stride == 0) {
    part->position += count * least;
    return table;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!ReadRecord(fields, used, part, &table.bytes)) {
      RefuseShort(place, i, count);
    }
  }
  return table;
}

}  // namespace icpscape
