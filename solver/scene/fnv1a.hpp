// FNV-1a, 64 bits (Fowler, Noll & Vo): names what a text holds, the same on every machine. Not against
// intent.
#pragma once

#include <cstdint>
#include <string_view>

namespace granvof {

constexpr std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

}  // namespace granvof
