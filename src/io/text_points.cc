// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/text_points.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "icpscape/common/error.h"
#include "icpscape/io/text_lines.h"
#include "icpscape/io/text_records.h"

namespace icpscape {
namespace {

using Words = std::vector<std::string_view>;

char SeparatorOf(std::string_view line) {
  for (const char separator : {';', ','}) {
    if (line.find(separator) != std::string_view::npos) {
      return separator;
    }
  }
  return ' ';
}

// Takes away what marks a comment; says whether it was there.
bool RemoveMark(std::string_view* line) {
  for (const std::string_view mark : {"#", "//"}) {
    if (line->substr(0, mark.size()) == mark) {
      line->remove_prefix(mark.size());
      return true;
    }
  }
  return false;
}

std::string_view WithoutQuotes(std::string_view word) {
  const bool quoted = word.size() > 1 && word.front() == '"' && word.back() == '"';
  return quoted ? word.substr(1, word.size() - 2) : word;
}

bool Names(const Words& words, std::string_view name) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    word = WithoutQuotes(word);
    return word.size() == 1 && (word[0] == name[0] || word[0] == name[0] - 'a' + 'A');
  });
}

bool NamesPoints(const Words& words) {
  return Names(words, "x") && Names(words, "y") && Names(words, "z");
}

std::size_t CountRecords(TextLines lines) {
  Words words;
  std::size_t count = 0;
  while (lines.NextWords(&words)) {
    ++count;
  }
  return count;
}

}  // namespace

PointTable ReadTextPoints(const std::string& place, const std::string& bytes, bool xyz_first) {
  TextLines lines(place, bytes);
  TextLines before = lines;  // The line that came last.
  std::vector<Field> fields;
  std::string_view line;
  while (fields.empty()) {
    before = lines;
    if (!lines.Next(&line)) {
      throw InputError(place + ": no points; expected a line of names, and lines of numbers.");
    }
    const bool is_comment = RemoveMark(&line);
    const char separator = SeparatorOf(line);
    Words words;
    SplitLine(line, separator, &words);
    double number = 0;
    if (NamesPoints(words)) {
      for (const std::string_view word : words) {
        fields.push_back({std::string(WithoutQuotes(word)), NumberType::kDouble, 1, std::nullopt});
      }
    } else if (is_comment || words.empty()) {
      continue;
    } else if (xyz_first && words.size() >= 3 && ParseWord(words[0], &number)) {
      for (std::size_t i = 0; i < words.size(); ++i) {
        fields.push_back({i < 3 ? std::string(1, static_cast<char>('x' + i)) : "",
                          NumberType::kDouble, 1, std::nullopt});
      }
      lines = before;
    } else {
      throw InputError(lines.Place() + ": " + Quoted(words[0]) +
                       "; expected a line of names, x, y and z among them.");
    }
    lines.SeparateAt(separator);
  }
  return ReadTextRecords(fields, CountRecords(lines), &lines);
}

}  // namespace icpscape
