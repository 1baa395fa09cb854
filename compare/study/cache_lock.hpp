// One study works in a cache at a time: two would take each other's half-made runs for kept ones.
#pragma once

#include <filesystem>

#include "solver/output/atomic_file.hpp"

namespace granvof::compare {

// Held while it lives, and the file gone with it; a program that is killed lets go too, and leaves the file.
class CacheLock {
 public:
  // Takes CACHE/lock, and writes into it who has it. Throws std::runtime_error saying who holds it where
  // another does, OutputError where the file cannot be made.
  explicit CacheLock(const std::filesystem::path& cache);
  CacheLock(const CacheLock&) = delete;
  CacheLock& operator=(const CacheLock&) = delete;
  CacheLock(CacheLock&&) = delete;
  CacheLock& operator=(CacheLock&&) = delete;
  ~CacheLock();

 private:
  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace granvof::compare
