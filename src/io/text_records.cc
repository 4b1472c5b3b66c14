// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/text_records.h"

#include <charconv>
#include <cstdint>
#include <utility>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

// What a used number is stored as: nothing is lost.
NumberType StoredAs(NumberType type) {
  if (!IsWhole(type)) {
    return NumberType::kDouble;
  }
  return type == NumberType::kUint64 ? type : NumberType::kInt64;
}

template <class T>
void AppendBytes(const T& value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(T));
}

template <class T>
bool AppendWhole(std::string_view word, std::string* bytes) {
  T value = 0;
  const char* const end = word.data() + word.size();
  const auto [ptr, error] = std::from_chars(word.data(), end, value);
  AppendBytes(value, bytes);
  return error == std::errc() && ptr == end;
}

// The words of one line.
class Record {
 public:
  Record(const std::vector<std::string_view>& words, const TextLines& lines)
      : words_(words), lines_(lines) {}

  // Takes the next word, which must be a number; stores it where there are `bytes`.
  void Take(NumberType type, std::string* bytes) {
    const std::string_view word = Next();
    bool good = true;
    if (bytes == nullptr || !IsWhole(type)) {
      double value = 0;
      good = ParseWord(word, &value);
      if (bytes != nullptr) {
        AppendBytes(value, bytes);
      }
    } else if (type == NumberType::kUint64) {
      good = AppendWhole<std::uint64_t>(word, bytes);
    } else {
      good = AppendWhole<std::int64_t>(word, bytes);
    }
    if (!good) {
      throw InputError(lines_.Place() + ": " + Quoted(word) + "; expected " +
                       (bytes != nullptr && IsWhole(type) ? "a whole number." : "a number."));
    }
  }

  void SkipList() {
    std::size_t count = 0;
    if (!ParseCount(Next(), &count)) {
      throw InputError(lines_.Place() + ": " + Quoted(words_[next_ - 1]) +
                       "; expected the length of a list.");
    }
    for (std::size_t i = 0; i < count; ++i) {
      Take(NumberType::kDouble, nullptr);
    }
  }

  void RequireEnd() const {
    if (next_ != words_.size()) {
      throw InputError(lines_.Place() + ": " + std::to_string(words_.size()) +
                       " numbers; expected " + std::to_string(next_) + ".");
    }
  }

 private:
  std::string_view Next() {
    if (next_ == words_.size()) {
      throw InputError(lines_.Place() + ": a line of " + std::to_string(words_.size()) +
                       " numbers; expected more.");
    }
    return words_[next_++];
  }

  const std::vector<std::string_view>& words_;
  const TextLines& lines_;
  std::size_t next_ = 0;
};

// Numbers of used fields go into `bytes`.
void ReadRecord(const std::vector<Field>& fields, const std::vector<char>& used, Record* record,
                std::string* bytes) {
  for (std::size_t f = 0; f < fields.size(); ++f) {
    if (fields[f].list_count) {
      record->SkipList();
      continue;
    }
    record->Take(fields[f].type, used[f] != 0 ? bytes : nullptr);
    for (std::size_t i = 1; i < fields[f].count; ++i) {
      record->Take(fields[f].type, nullptr);
    }
  }
  record->RequireEnd();
}

}  // namespace

PointTable ReadTextRecords(const std::vector<Field>& fields, std::size_t count, TextLines* lines) {
  PointTable table;
  table.place = lines->file();
  table.size = count;
  std::vector<char> used;
  std::size_t stride = 0;
  for (const Field& field : fields) {
    used.push_back(!field.list_count && IsUsed(field.name) ? 1 : 0);
    if (used.back() != 0) {
      const NumberType type = StoredAs(field.type);
      table.columns.push_back({field.name, type, stride, 0});
      stride += BytesOf(type);
    }
  }
  for (Column& column : table.columns) {
    column.stride = stride;
  }
  // A digit and the end of the line, though no end after the last.
  if (count > (lines->left() + 1) / 2 && !fields.empty()) {
    throw InputError(lines->file() + ": " + std::to_string(count) +
                     " records do not fit into the " + std::to_string(lines->left()) +
                     " bytes that follow the header; expected a whole file.");
  }
  table.bytes.reserve(count * stride);
  std::vector<std::string_view> line;
  for (std::size_t i = 0; i < count; ++i) {
    if (!lines->NextWords(&line)) {
      throw InputError(lines->file() + ": ends after " + std::to_string(i) + " of " +
                       std::to_string(count) + " records; expected a whole file.");
    }
    Record record(line, *lines);
    ReadRecord(fields, used, &record, &table.bytes);
  }
  return table;
}

void RequireEnd(TextLines* lines) {
  std::vector<std::string_view> words;
  if (lines->NextWords(&words)) {
    throw InputError(lines->Place() + ": " + Quoted(words[0]) +
                     " after the last record; expected the end of the file.");
  }
}

}  // namespace icpscape
