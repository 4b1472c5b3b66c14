// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>

namespace icpscape {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t\v\f\r";

void SplitAtBlanks(std::string_view line, std::vector<std::string_view>* words) {
  words->clear();
  for (std::size_t end = 0;;) {
    const std::size_t begin = line.find_first_not_of(kBlanks, end);
    if (begin == std::string_view::npos) {
      return;
    }
    end = std::min(line.find_first_of(kBlanks, begin), line.size());
    words->push_back(line.substr(begin, end - begin));
  }
}

std::string_view WithoutBlanks(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of(kBlanks), word.size()));
  return word.substr(0, word.find_last_not_of(kBlanks) + 1);
}

}  // namespace

void SplitLine(std::string_view line, char separator, std::vector<std::string_view>* words) {
  SplitAtBlanks(line, words);
  if (separator == ' ' || words->empty()) {
    return;
  }
  words->clear();
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    words->push_back(WithoutBlanks(line.substr(begin, end - begin)));
    begin = end + 1;
  }
}

TextLines::TextLines(std::string file, std::string_view text)
    : file_(std::move(file)), text_(text) {
  if (text_.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    position_ = kByteOrderMark.size();
  }
}

bool TextLines::Next(std::string_view* line) {
  if (left() == 0) {
    return false;
  }
  const std::size_t end = std::min(text_.find('\n', position_), text_.size());
  *line = text_.substr(position_, end - position_);
  if (!line->empty() && line->back() == '\r') {
    line->remove_suffix(1);
  }
  position_ = std::min(end + 1, text_.size());
  ++number_;
  return true;
}

bool TextLines::NextWords(std::vector<std::string_view>* words) {
  std::string_view line;
  while (Next(&line)) {
    SplitLine(line, separator_, words);
    if (!words->empty()) {
      return true;
    }
  }
  return false;
}

std::string Quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text(word.substr(0, kLongest));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "\"" + text + (word.size() > kLongest ? "...\"" : "\"");
}

bool ParseCount(std::string_view word, std::size_t* count) {
  constexpr std::uint64_t kLargest = 1000000000000;
  std::uint64_t value = 0;
  const char* const end = word.data() + word.size();
  const auto [ptr, error] = std::from_chars(word.data(), end, value);
  *count = static_cast<std::size_t>(value);
  return error == std::errc() && ptr == end && value <= kLargest;
}

bool ParseWord(std::string_view word, double* value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);
  }
  const char* const end = word.data() + word.size();
  const auto [ptr, error] = std::from_chars(word.data(), end, *value);
  if (error == std::errc::result_out_of_range) {  // Below the least double, or above the largest.
    const bool is_small = word.find("e-") != word.npos || word.find("E-") != word.npos;
    *value = is_small ? 0 : std::numeric_limits<double>::infinity();
  }
  return error != std::errc::invalid_argument && ptr == end;
}

}  // namespace icpscape
