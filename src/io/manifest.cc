// SPDX-License-Identifier: BSD-3-Clause
#include "src/io/manifest.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "icpscape_version.h"
#include "src/common/error.h"
#include "src/io/output.h"

namespace icpscape {
namespace {

using Clock = std::chrono::steady_clock;

std::string Sha256(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError(path.string() + ": cannot be read; expected an input file.");
  }
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr);
  std::vector<char> buffer(1U << 20U);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0) {
    EVP_DigestUpdate(context.get(), buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned size = 0;
  EVP_DigestFinal_ex(context.get(), digest.data(), &size);
  constexpr char kHex[] = "0123456789abcdef";
  std::string text;
  for (unsigned i = 0; i < size; ++i) {
    text += kHex[digest[i] >> 4U];
    text += kHex[digest[i] & 15U];
  }
  return text;
}

}  // namespace

struct Manifest::Impl {
  nlohmann::ordered_json json;
  Clock::time_point last = Clock::now();
};

Manifest::Manifest(const std::string& program) : impl_(std::make_unique<Impl>()) {
  impl_->json["program"] = program;
  impl_->json["version"] = Version();
  for (const char* section : {"flags", "inputs", "results", "timings_s"}) {
    impl_->json[section] = nlohmann::ordered_json::object();
  }
}

Manifest::~Manifest() = default;

void Manifest::SetFlag(const std::string& name, const std::string& value) {
  impl_->json["flags"][name] = value;
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

void Manifest::Write(const std::filesystem::path& path) const {
  WriteTextFile(path,
                impl_->json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

std::string Version() {
  const std::string commit = ICPSCAPE_COMMIT;
  return std::string(ICPSCAPE_RELEASE) + (commit.empty() ? "" : " (" + commit + ")");
}

}  // namespace icpscape
