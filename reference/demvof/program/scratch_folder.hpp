// The folder for intermediate files, under a name that OpenFOAM and LIGGGHTS take as it stands.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/output/atomic_file.hpp"

namespace demvof {

// OpenFOAM strips blanks and quotes from the name of a case, LIGGGHTS ends a word at a quote: a folder called
// so is given to them by the name of its open descriptor.
class ScratchFolder {
 public:
  // Makes the folder and those above it where they are missing. Throws granvof::OutputError where it cannot
  // be made or written to; nothing is left then.
  explicit ScratchFolder(const std::filesystem::path& path);
  // Removes the folders that it has made and in which nothing was left.
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  // Valid in this process and in those that it forks, as long as this object lives.
  const std::filesystem::path& name() const { return name_; }

 private:
  void make(const std::filesystem::path& path);
  void remove_what_is_empty();

  std::vector<std::filesystem::path> made_;  // the innermost last
  granvof::Descriptor open_;
  std::filesystem::path name_;
};

}  // namespace demvof
