// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/output.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {

std::unique_lock<std::mutex> HoldOutputFiles() {
  // Never destroyed: a signal may come while the program ends.
  static auto* const mutex = new std::mutex;
  return std::unique_lock<std::mutex>(*mutex);
}

void WriteThenRename(const std::filesystem::path& path,
                     const std::function<bool(const std::filesystem::path&)>& write) {
  const std::unique_lock<std::mutex> lock = HoldOutputFiles();
  // The extension is kept: some writers go by it.
  std::filesystem::path part = path;
  part.replace_filename("." + std::to_string(getpid()) + "." + path.filename().string());
  std::error_code error;
  bool written = false;
  try {
    written = write(part);
  } catch (const std::exception&) {
    written = false;
  }
  if (written) {
    std::filesystem::rename(part, path, error);
  }
  if (!written || error) {
    std::filesystem::remove(part, error);
    throw InputError(path.string() + ": cannot be written; expected a writable folder with space.");
  }
}

void WriteTextFile(const std::filesystem::path& path, const std::string& text) {
  WriteThenRename(path, [&](const std::filesystem::path& part) {
    std::ofstream out(part, std::ios::binary);
    out << text;
    out.close();
    return out.good();
  });
}

void PrepareOutputFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::unique_lock<std::mutex> lock = HoldOutputFiles();
  const std::filesystem::path probe = folder / (".probe." + std::to_string(getpid()));
  std::ofstream out(probe);
  out << "probe";
  out.close();
  const bool writable = out.good();
  std::filesystem::remove(probe, error);
  if (!writable) {
    throw InputError(folder.string() + ": cannot be written; expected a folder for the results.");
  }
}

void Table::AddRow(std::vector<std::string> cells) {
  if (cells.size() != columns_.size()) {
    throw UsageError("A row of " + std::to_string(cells.size()) +
                     " cells; expected one for each of " + std::to_string(columns_.size()) +
                     " columns.");
  }
  rows_.push_back(std::move(cells));
}

void Table::Write(const std::filesystem::path& path, const std::string& separator) const {
  std::string text = Join(columns_, separator) + "\n";
  for (const std::vector<std::string>& row : rows_) {
    text += Join(row, separator) + "\n";
  }
  WriteTextFile(path, text);
}

}  // namespace icpscape
