#include "libio/results/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>
#include <vector>

#include "libio/results/replace_file.hpp"

namespace whirl::inline io {

namespace {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1) {
      throw FileError("cannot compute SHA-256: libcrypto does not offer it");
    }
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned size = 0;
    EVP_DigestFinal_ex(context_.get(), bytes.data(), &size);
    std::string text;
    for (unsigned i = 0; i < size; ++i) text += fmt::format("{:02x}", bytes.at(i));
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

std::string sha256_of(std::string_view text) {
  Sha256 digest;
  digest.add(text);
  return digest.digits();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  constexpr std::size_t piece = 1u << 20u;
  std::ifstream stream(file, std::ios::binary);
  Sha256 digest;
  std::vector<char> bytes(piece);
  while (stream) {
    stream.read(bytes.data(), static_cast<std::streamsize>(piece));
    digest.add({bytes.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (!stream.eof()) throw FileError(fmt::format("cannot read {}", file.string()));
  return digest.digits();
}

}  // namespace whirl::inline io
