// The folder for intermediate files, under a name that OpenFOAM and LIGGGHTS take as it stands.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/output/atomic_file.hpp"

namespace demvof {

// Each run has one of its own in the folder given, locked as long as one of its processes lives: whatever
// ends OpenFOAM and LIGGGHTS, all that they wrote goes with it. OpenFOAM strips blanks and quotes from the
// name of a case, LIGGGHTS ends a word at a quote: a folder called so is given to them by the name of its
// open descriptor.
class ScratchFolder {
 public:
  // Makes the folder and those above it where they are missing, and removes what runs that were killed have
  // left in it. Throws granvof::OutputError where it cannot be made or written to; nothing is left then.
  explicit ScratchFolder(const std::filesystem::path& path);
  // Removes the run's own folder, and those above it that were made for it and are empty now.
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ScratchFolder(ScratchFolder&&) = delete;
  ScratchFolder& operator=(ScratchFolder&&) = delete;

  // Of the run's own folder. Valid in this process and in those that it forks, as long as this object lives.
  const std::filesystem::path& name() const { return name_; }

 private:
  void make(const std::filesystem::path& path);
  void make_own(const std::filesystem::path& folder, const std::filesystem::path& given);
  void remove_what_was_made();

  std::vector<std::filesystem::path> made_;  // the innermost last
  std::filesystem::path own_;
  granvof::Descriptor open_;
  std::filesystem::path name_;
};

}  // namespace demvof
