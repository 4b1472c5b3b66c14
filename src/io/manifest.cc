// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/manifest.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "icpscape/common/text.h"
#include "icpscape/io/output.h"
#include "icpscape/io/sha256.h"
#include "icpscape_version.h"

namespace icpscape {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

struct Manifest::Impl {
  nlohmann::ordered_json json;
  Clock::time_point last = Clock::now();
};

Manifest::Manifest(const std::string& program) : impl_(std::make_unique<Impl>()) {
  impl_->json["program"] = program;
  impl_->json["version"] = Version();
  for (const char* section : {"flags", "changed_flags", "inputs", "results", "timings_s"}) {
    impl_->json[section] = nlohmann::ordered_json::object();
  }
}

Manifest::~Manifest() = default;

void Manifest::SetFlag(const std::string& name, const std::string& value, bool is_changed) {
  impl_->json["flags"][name] = value;
  if (is_changed) {
    impl_->json["changed_flags"][name] = value;
  }
}

void Manifest::AddInput(const std::filesystem::path& path) {
  impl_->json["inputs"][path.string()] = {{"bytes", std::filesystem::file_size(path)},
                                          {"sha256", Sha256(path)}};
}

void Manifest::SetResult(const std::string& name, double value) {
  impl_->json["results"][name] = value;
}

void Manifest::SetResult(const std::string& name, const std::string& value) {
  impl_->json["results"][name] = value;
}

void Manifest::AddTiming(const std::string& name) {
  const Clock::time_point now = Clock::now();
  impl_->json["timings_s"][name] = std::chrono::duration<double>(now - impl_->last).count();
  impl_->last = now;
}

std::string Manifest::TimingsText() const {
  std::vector<std::string> parts;
  for (const auto& [name, seconds] : impl_->json["timings_s"].items()) {
    parts.push_back(name + " " + Fixed(seconds.get<double>(), 2) + " s");
  }
  return Join(parts);
}

void Manifest::SetFiles(const std::vector<std::string>& names) { impl_->json["files"] = names; }

void Manifest::Write(const std::filesystem::path& path) const {
  WriteTextFile(path,
                impl_->json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::optional<std::vector<std::string>> FilesOfManifest(const std::filesystem::path& path,
                                                        const std::string& program) {
  std::ifstream in(path);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("program") || json["program"] != program) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  if (json.contains("files") && json["files"].is_array()) {
    for (const auto& name : json["files"]) {
      if (name.is_string()) {
        names.push_back(name.get<std::string>());
      }
    }
  }
  return names;
}

std::string Version() {
  const std::string commit = ICPSCAPE_COMMIT;
  return std::string(ICPSCAPE_RELEASE) + (commit.empty() ? "" : " (" + commit + ")");
}

}  // namespace icpscape
