// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/io/sha256.h"

namespace icpscape {
namespace {

constexpr std::size_t kChecksumDigits = 16;

std::string Checksum(const std::string& before, const std::string& record) {
  return Sha256OfText(before + "\n" + record).substr(0, kChecksumDigits);
}

// The line of a record, without its line feed.
std::string Line(const std::string& checksum_before, const std::string& record) {
  return record + " " + Checksum(checksum_before, record);
}

[[noreturn]] void ThrowUnwritable(const std::filesystem::path& path) {
  throw InputError(path.string() + ": cannot be written; expected a writable folder.");
}

// "voxel_m=0.25, now voxel_m=0.5": the first part in which two headers differ.
std::string Difference(const std::string& was, const std::string& is) {
  const auto part = [](const std::string& text, std::size_t begin) {
    return begin > text.size() ? "nothing" : text.substr(begin, text.find("; ", begin) - begin);
  };
  std::size_t begin = 0;
  while (part(was, begin) == part(is, begin)) {
    begin += part(was, begin).size() + 2;
  }
  return part(was, begin) + ", now " + part(is, begin);
}

void RequireOneLine(const std::string& record) {
  if (record.find('\n') != std::string::npos) {
    throw UsageError("A journal's record has a line feed; expected one line: " + record);
  }
}

}  // namespace

Journal::Journal(std::filesystem::path path, const std::string& header, Begin begin)
    : path_(std::move(path)) {
  RequireOneLine(header);
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    ThrowUnwritable(path_);
  }
  try {
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      throw InputError(path_.string() + ": another run writes it; expected another folder.");
    }
    if (begin == Begin::kAnew && ftruncate(file_, 0) != 0) {
      ThrowUnwritable(path_);
    }
    Load(header);
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() { close(file_); }

void Journal::Load(const std::string& header) {
  std::ifstream in(path_, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  std::size_t begin = 0;
  for (int number = 1; begin < text.size(); ++number) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    const std::size_t blank = line.rfind(' ');
    const bool whole = end != std::string::npos && blank != std::string::npos &&
                       line == Line(checksum_, line.substr(0, blank));
    if (!whole) {
      const bool is_last = end == std::string::npos || end + 1 == text.size();
      // A first line that does not begin our header is of another file: it is not cut off.
      if (!is_last || (number == 1 && Line("", header).rfind(line, 0) != 0)) {
        throw InputError(path_.string() + ":" + std::to_string(number) +
                         ": damaged; expected an undamaged journal, or another folder.");
      }
      break;  // The record that a run was writing when it ended.
    }
    checksum_ = line.substr(blank + 1);
    if (number == 1 && line.substr(0, blank) != header) {
      throw InputError(path_.string() + ": was written with " +
                       Difference(line.substr(0, blank), header) +
                       "; expected the same, another folder, or a restart.");
    }
    if (number > 1) {
      records_.push_back(line.substr(0, blank));
    }
    begin = end + 1;
  }
  if (ftruncate(file_, static_cast<off_t>(begin)) != 0 || lseek(file_, 0, SEEK_END) < 0) {
    ThrowUnwritable(path_);
  }
  if (checksum_.empty()) {
    Append(header);
    records_.clear();
  }
}

void Journal::Append(const std::string& record) {
  RequireOneLine(record);
  const std::string line = Line(checksum_, record) + "\n";
  if (write(file_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) {
    throw InputError(path_.string() + ": cannot be written; expected a disk with space.");
  }
  checksum_ = line.substr(line.size() - 1 - kChecksumDigits, kChecksumDigits);
  records_.push_back(record);
}

}  // namespace icpscape
