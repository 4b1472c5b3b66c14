// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_JOURNAL_H_
#define ICPSCAPE_SRC_IO_JOURNAL_H_

#include <filesystem>
#include <string>
#include <vector>

namespace icpscape {

/// An append-only file of one-line records, from which a run that was stopped goes on: whatever
/// ended it, every record that Append returned from is read back. (After a loss of power the system
/// may have kept fewer; what is missing is the end.)
///
/// Each line is a record, a blank and a checksum: the first 16 hexadecimal digits of the SHA-256 of
/// the line's before (none for the first), a line feed and the record. The first record is the
/// header: what the others depend on. A torn last line is dropped.
class Journal {
 public:
  enum class Begin {
    kWhereItEnds,  ///< Goes on behind the records that are there.
    kAnew,         ///< Drops them, whatever they are.
  };

  /// Opens or creates the file, for this process only. Throws InputError where it cannot be
  /// written or is in use; and, unless it begins anew, where it has another header (the message
  /// names the first part, separated by "; ", that differs), or is damaged before its end.
  Journal(std::filesystem::path path, const std::string& header, Begin begin = Begin::kWhereItEnds);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Those after the header, of this run and those before.
  const std::vector<std::string>& records() const { return records_; }

  /// Throws InputError where the record cannot be written, UsageError where it has a line feed.
  void Append(const std::string& record);

 private:
  void Load(const std::string& header);

  std::filesystem::path path_;
  int file_ = -1;
  std::string checksum_;  // Of the last line.
  std::vector<std::string> records_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_JOURNAL_H_
