// SHA-256 of what is written (FIPS 180-4, by OpenSSL's libcrypto), by which a reader knows a file that was
// cut, edited or exchanged.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace granvof {

// The digest of a text that grows.
class Digest {
 public:
  Digest();

  void add(std::string_view bytes);
  std::string hex() const;  // of all added so far: 64 hex digits

 private:
  struct Free {
    void operator()(void* context) const;
  };
  std::unique_ptr<void, Free> context_;
};

// Of a whole file. Throws OutputError.
std::string digest_of_file(const std::filesystem::path& path);

}  // namespace granvof
