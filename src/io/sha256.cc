// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/sha256.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#include "icpscape/common/error.h"

namespace icpscape {

namespace {

class Digest {
 public:
  Digest() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }

  void Add(const char* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }

  std::string Hexadecimal() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &size);
    constexpr char kHex[] = "0123456789abcdef";
    std::string text;
    for (unsigned i = 0; i < size; ++i) {
      text += kHex[digest[i] >> 4U];
      text += kHex[digest[i] & 15U];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(),
                                                                   &EVP_MD_CTX_free};
};

}  // namespace

std::string Sha256(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError(path.string() + ": cannot be read; expected an input file.");
  }
  Digest digest;
  std::vector<char> buffer(1U << 20U);
  while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0) {
    digest.Add(buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  return digest.Hexadecimal();
}

std::string Sha256OfText(const std::string& text) {
  Digest digest;
  digest.Add(text.data(), text.size());
  return digest.Hexadecimal();
}

std::string Sha256OfScan(const std::filesystem::path& file, const PointCloud& cloud) {
  if (!file.empty()) {
    return Sha256(file);
  }
  std::string bytes;
  for (const std::vector<float>* axis : {&cloud.x, &cloud.y, &cloud.z, &cloud.time_s}) {
    bytes.append(reinterpret_cast<const char*>(axis->data()), axis->size() * sizeof(float));
  }
  return Sha256OfText(bytes);
}

}  // namespace icpscape
