// checkpoint.h5: the state of a run, from which it continues bit for bit.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "solver/scene/scene.hpp"

namespace granvof {

// The rows of series.csv at that moment: run.json, which is written after the checkpoint, may know less of
// them.
struct RowsSoFar {
  std::int64_t count = 0;
  std::string sha256;  // of the header and these rows; empty where nothing is known
};

// What a program hands over; names are free, arrays in any layout the program reads back itself.
struct CheckpointView {
  double time = 0.0;  // [s]
  std::map<std::string, std::span<const double>> arrays;
  std::map<std::string, double> scalars;
  std::map<std::string, std::int64_t> counters;
  RowsSoFar rows;
  std::string instants_sha256;  // of the fields written so far; empty where nothing is known
};

// The same, read back.
struct Checkpoint {
  double time = 0.0;  // [s]
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, double> scalars;
  std::map<std::string, std::int64_t> counters;
  RowsSoFar rows;
  std::string instants_sha256;

  // Lookups that throw OutputError naming the file and what is missing or has another size.
  const std::vector<double>& array(const std::string& name, std::size_t size) const;
  double scalar(const std::string& name) const;
  std::int64_t counter(const std::string& name) const;

  std::filesystem::path file;
};

// Replaces `path` atomically; on OutputError the previous checkpoint stays.
void write_checkpoint(const std::filesystem::path& path, const Scene& scene, const CheckpointView& state);

// Throws OutputError if the file is missing, damaged, of another format, or of a case with another hash or
// grid.
Checkpoint read_checkpoint(const std::filesystem::path& path, const Scene& scene);

}  // namespace granvof
