#include "solver/output/digest.hpp"

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <openssl/evp.h>
#include <unistd.h>

#include "solver/output/open_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof {
namespace {

EVP_MD_CTX* of(void* context) {
  return static_cast<EVP_MD_CTX*>(context);
}

void check(bool worked) {
  if (!worked) throw std::runtime_error("SHA-256 failed");
}

}  // namespace

void Digest::Free::operator()(void* context) const {
  EVP_MD_CTX_free(of(context));
}

Digest::Digest() : context_(EVP_MD_CTX_new()) {
  check(context_ && EVP_DigestInit_ex(of(context_.get()), EVP_sha256(), nullptr) == 1);
}

void Digest::add(std::string_view bytes) {
  check(EVP_DigestUpdate(of(context_.get()), bytes.data(), bytes.size()) == 1);
}

std::string Digest::hex() const {
  const Digest copy;  // the digest ends its context; this one goes on
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned length = 0;
  check(EVP_MD_CTX_copy_ex(of(copy.context_.get()), of(context_.get())) == 1 &&
        EVP_DigestFinal_ex(of(copy.context_.get()), bytes.data(), &length) == 1);
  std::string text;
  for (unsigned i = 0; i < length; ++i) text += fmt::format("{:02x}", bytes[i]);
  return text;
}

std::string digest_of_file(const std::filesystem::path& path) {
  const Descriptor file = open_file(path);
  Digest digest;
  for (std::vector<char> block(std::size_t{1} << 20U);;) {
    const ssize_t size = ::read(file.get(), block.data(), block.size());
    if (size == 0) return digest.hex();
    if (size > 0)
      digest.add({block.data(), static_cast<std::size_t>(size)});
    else if (errno != EINTR)
      throw OutputError("read", path, std::generic_category().message(errno));
  }
}

}  // namespace granvof
