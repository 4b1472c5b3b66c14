// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_OUTPUT_H_
#define ICPSCAPE_SRC_IO_OUTPUT_H_

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace icpscape {

/// Calls write(part) for a file beside `path` and renames it to `path` when write returned true: a
/// reader never sees half a file, and an older one survives a failure. One file at a time. Throws
/// InputError.
void WriteThenRename(const std::filesystem::path& path,
                     const std::function<bool(const std::filesystem::path&)>& write);

/// While the lock is held nothing is being written by these functions, and no temporary file of
/// theirs is there: code that ends the process takes it first.
std::unique_lock<std::mutex> HoldOutputFiles();

/// Writes the text as a whole file, as above.
void WriteTextFile(const std::filesystem::path& path, const std::string& text);

/// Creates the folder (and its parents) and proves that a file can be written there. Throws
/// InputError: before the work, not after it.
void PrepareOutputFolder(const std::filesystem::path& folder);

/// A table of text cells under one header line, written as comma-separated values or, for pgfplots,
/// separated by blanks.
class Table {
 public:
  explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
  /// One cell per column. Throws UsageError.
  void AddRow(std::vector<std::string> cells);
  void WriteCsv(const std::filesystem::path& path) const { Write(path, ","); }
  void WritePgfplots(const std::filesystem::path& path) const { Write(path, " "); }

 private:
  void Write(const std::filesystem::path& path, const std::string& separator) const;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_OUTPUT_H_
