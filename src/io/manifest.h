// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_MANIFEST_H_
#define ICPSCAPE_SRC_IO_MANIFEST_H_

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace icpscape {

/// What a run was: program, version, effective flags, hashes of its inputs, timings and headline
/// results; written as manifest.json beside the tables.
class Manifest {
 public:
  explicit Manifest(const std::string& program);
  ~Manifest();
  Manifest(const Manifest&) = delete;
  Manifest& operator=(const Manifest&) = delete;

  void SetFlag(const std::string& name, const std::string& value);
  /// Records path, size and SHA-256. Throws InputError where the file cannot be read.
  void AddInput(const std::filesystem::path& path);
  void SetResult(const std::string& name, double value);
  void SetResult(const std::string& name, const std::string& value);
  /// Seconds since the last call (or the start), under that name.
  void AddTiming(const std::string& name);
  /// "read 0.03 s, landscape 0.41 s": what AddTiming was told, in its order.
  std::string TimingsText() const;

  void Write(const std::filesystem::path& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "0.1.0 (1a2b3c4d5e6f)": release and, where the sources are a git checkout, the commit.
std::string Version();

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_MANIFEST_H_
