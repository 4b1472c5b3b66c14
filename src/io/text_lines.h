// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_TEXT_LINES_H_
#define ICPSCAPE_SRC_IO_TEXT_LINES_H_

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace icpscape {

/// The lines of a file's text, which end with \n or \r\n. A byte order mark at the beginning is no
/// text.
class TextLines {
 public:
  /// `file` is the path of the file. The text must live as long as this object.
  TextLines(std::string file, std::string_view text);

  /// The next line, without its end; false at the end of the text.
  bool Next(std::string_view* line);
  /// The words of the next line that has any, between separators; false at the end of the text.
  bool NextWords(std::vector<std::string_view>* words);
  /// From here on words are separated by this; at the beginning by blanks.
  void SeparateAt(char separator) { separator_ = separator; }

  const std::string& file() const { return file_; }
  /// "a.ply:12", of the line that came last.
  std::string Place() const { return file_ + ":" + std::to_string(number_); }
  /// Bytes up to the end of the line that came last, and after it.
  std::size_t position() const { return position_; }
  std::size_t left() const { return text_.size() - position_; }

 private:
  std::string file_;
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
  char separator_ = ' ';
};

/// The words of a line. Where the separator is no blank, blanks about words are left out, and a
/// word may be empty; a line of blanks has no word.
void SplitLine(std::string_view line, char separator, std::vector<std::string_view>* words);

/// A word for a message: in quotes, cut where it is long, without what cannot be printed.
std::string Quoted(std::string_view word);

/// A count as a header writes it; false where the word is none, or one above 1e12.
bool ParseCount(std::string_view word, std::size_t* count);

/// The number that the whole word spells; false where it does not. "nan" and "inf" are numbers.
bool ParseWord(std::string_view word, double* value);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_TEXT_LINES_H_
