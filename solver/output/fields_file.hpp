// fields.h5: one group per output time, and fields.xdmf that shows it to ParaView.
//
// While a run goes on each instant is a file of its own, fields/tNNNN.h5, and fields.h5 links to them: every
// file is written whole and renamed, so that a run killed at any moment leaves readable output. The two lists
// of all instants (fields.h5 and fields.xdmf) grow with their number; written anew for every instant they
// would cost its square. So they may lag behind by one instant in sixteen, and are up to date at a checkpoint
// and at every end but a kill. join() makes fields.h5 one file without links. Readers see no difference.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "solver/output/cell_fields.hpp"
#include "solver/output/digest.hpp"
#include "solver/scene/scene.hpp"

namespace granvof {

// scene.grid is the grid of the fields; the reference puts its own there.
class FieldsFile {
 public:
  // Writes an empty fields.h5 and fields.xdmf into `directory`. Throws OutputError.
  static FieldsFile create(const std::filesystem::path& directory, const Scene& scene);
  // Goes on behind the instants of `times` [s], ascending; later ones are removed. Throws OutputError, also
  // where the first instants are not of these times or cannot be read.
  static FieldsFile resume(const std::filesystem::path& directory, const Scene& scene,
                           std::span<const double> times);
  // Throws as resume() does, and touches nothing; also where these instants are not those of a digest, if one
  // is given.
  static void check_instants(const std::filesystem::path& directory, std::span<const double> times,
                             const std::string& sha256 = {});
  // Removes what a FieldsFile left in `directory`, and nothing else. Throws OutputError.
  static void remove(const std::filesystem::path& directory);

  // Adds an instant. Throws OutputError; std::invalid_argument if an array has not the size of the grid.
  void append(const CellFields& fields);
  // Lists every instant in fields.h5 and fields.xdmf, where they lag behind. Throws OutputError.
  void bring_up_to_date();
  // Throws OutputError if an instant has been removed since it was written.
  void check_still_there() const;
  std::size_t instants() const { return instants_.size(); }
  // Of the values of all instants up to a time [s]: one that another run has written is known by it, in
  // whatever file it lies.
  std::string sha256(double until) const;

  // Joins all instants into one file. False, and nothing changed, where that was not possible (disk full).
  bool join();

 private:
  FieldsFile(std::filesystem::path directory, const Scene& scene);
  std::filesystem::path piece(std::size_t index) const;
  std::string piece_content(const CellFields& fields) const;
  void write_lists();
  void write_file_attributes(std::int64_t file) const;
  std::string xdmf() const;
  void write_joined(const std::filesystem::path& draft) const;
  void reserve_for_joining(const std::filesystem::path& draft) const;

  struct Instant {
    double time = 0.0;
    bool has_solid_pressure = false;
    std::string sha256;  // of all up to this
  };

  std::filesystem::path directory_;
  std::string scene_name_;
  std::array<int, 3> cells_{};
  Vec3 spacing_{};
  std::vector<Instant> instants_;
  Digest digest_;
  std::size_t listed_ = 0;  // instants that the files on the disk list
};

// Output times [s] of a fields.h5, in order. Throws OutputError.
std::vector<double> read_field_times(const std::filesystem::path& fields_h5);
// Instant number `index`. Throws OutputError.
CellFields read_fields(const std::filesystem::path& fields_h5, std::size_t index);
// The same with time, grid and solid fraction alone: what a record of the reference holds of a run's fields
// is not all of them. Throws OutputError.
CellFields read_solid_fraction(const std::filesystem::path& fields_h5, std::size_t index);

}  // namespace granvof
