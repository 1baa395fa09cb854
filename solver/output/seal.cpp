#include "solver/output/seal.hpp"

#include <stdexcept>

#include "solver/output/digest.hpp"
#include "solver/output/output_error.hpp"

namespace granvof {
namespace {

constexpr std::string_view end_of_object = "\n}";
constexpr std::string_view before_digest = ",\n  \"sha256\": \"";
constexpr std::string_view after_digest = "\"\n}\n";

std::string digest_of(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.hex();
}

}  // namespace

std::string sealed(std::string_view object) {
  if (!object.ends_with(end_of_object)) throw std::invalid_argument("not the text of a JSON object");
  object.remove_suffix(end_of_object.size());
  std::string text(object);
  text += before_digest;
  text += digest_of(object);
  return text += after_digest;
}

Seal seal_of(std::string_view text) {
  const std::size_t begin = text.rfind(before_digest);
  if (begin == std::string_view::npos) return Seal::none;
  const std::string_view object = text.substr(0, begin), seal = text.substr(begin + before_digest.size());
  return seal == digest_of(object) + std::string(after_digest) ? Seal::whole : Seal::broken;
}

void require_seal(std::string_view text, bool has_member, const std::filesystem::path& file) {
  const Seal seal = seal_of(text);
  if (seal == Seal::broken || (seal == Seal::none && has_member))
    throw OutputError("use", file, "it is not what was written: its own SHA-256 is another");
}

}  // namespace granvof
