#include "solver/output/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/hdf5_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/scene/fnv1a.hpp"

namespace granvof {

namespace {

constexpr std::int64_t format_version = 4;

// The last line of the file, behind the HDF5 data, which HDF5 ignores: a checksum of all bytes before it
// (64-bit FNV-1a). It is compared before HDF5 sees the file, since HDF5 1.10 neither notices all damage nor
// survives all of it.
std::string seal_of(std::string_view content) {
  return fmt::format("granvof checkpoint {:016x}\n", fnv1a(content));
}

void check_seal(const std::filesystem::path& path) {
  const std::string content = read_file(path);
  const std::size_t length = seal_of("").size();
  const std::size_t end = content.size() - std::min(content.size(), length);
  if (content.substr(end) != seal_of(std::string_view(content).substr(0, end))) {
    throw OutputError("resume from", path, "it is damaged, or not a granvof checkpoint");
  }
}

template <class Map>
const typename Map::mapped_type& look_up(const Map& map, const std::string& name,
                                         const std::filesystem::path& file, const char* kind) {
  const auto found = map.find(name);
  if (found == map.end())
    throw OutputError("resume from", file, fmt::format("it has no {} '{}'", kind, name));
  return found->second;
}

std::string checkpoint_content(const Scene& scene, const CheckpointView& state) {
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::create_in_memory();
  hdf5::write_attribute(file, "format_version", format_version);
  hdf5::write_attribute(file, "case_hash", scene.hash);
  hdf5::write_attribute(file, "scene", scene.name);
  hdf5::write_attribute(file, "cells", std::span<const int>(scene.grid.cells));
  hdf5::write_attribute(file, "time", state.time);
  hdf5::write_attribute(file, "rows", state.rows.count);
  hdf5::write_attribute(file, "rows_sha256", state.rows.sha256);
  hdf5::write_attribute(file, "instants_sha256", state.instants_sha256);
  const auto scalars = hdf5::create_group(file, "scalars");
  for (const auto& [name, value] : state.scalars) hdf5::write_attribute(scalars, name, value);
  const auto counters = hdf5::create_group(file, "counters");
  for (const auto& [name, value] : state.counters) hdf5::write_attribute(counters, name, value);
  const auto arrays = hdf5::create_group(file, "arrays");
  for (const auto& [name, values] : state.arrays) hdf5::write_doubles(arrays, name, values);
  return hdf5::content_of(file);
}

void check_origin(const hdf5::Handle& file, const Scene& scene, const std::filesystem::path& path) {
  if (const auto version = hdf5::read_integer_attribute(file, "format_version"); version != format_version) {
    throw OutputError(
        "resume from", path,
        fmt::format("it has format version {}, this program reads {}", version, format_version));
  }
  if (const auto hash = hdf5::read_string_attribute(file, "case_hash"); hash != scene.hash) {
    throw OutputError("resume from", path,
                      fmt::format("it was written by another case: {} with hash {}, this is {} with hash {}",
                                  hdf5::read_string_attribute(file, "scene"), hash, scene.name, scene.hash));
  }
  const auto has = hdf5::read_double_array_attribute(file, "cells");
  const auto& wants = scene.grid.cells;
  if (has != std::vector<double>(wants.begin(), wants.end())) {
    throw OutputError(
        "resume from", path,
        fmt::format("it has {} cells, this case has {}", fmt::join(has, " x "), fmt::join(wants, " x ")));
  }
}

}  // namespace

const std::vector<double>& Checkpoint::array(const std::string& name, std::size_t size) const {
  const auto& values = look_up(arrays, name, file, "array");
  if (values.size() != size) {
    throw OutputError("resume from", file,
                      fmt::format("array '{}' has {} values, {} are expected", name, values.size(), size));
  }
  return values;
}

double Checkpoint::scalar(const std::string& name) const {
  const double value = look_up(scalars, name, file, "scalar");
  if (std::isnan(value))
    throw OutputError("resume from", file, fmt::format("scalar '{}' is no number", name));
  return value;
}

std::int64_t Checkpoint::counter(const std::string& name) const {
  return look_up(counters, name, file, "counter");
}

void write_checkpoint(const std::filesystem::path& path, const Scene& scene, const CheckpointView& state) {
  std::string content;
  try {
    content = checkpoint_content(scene, state);
  } catch (const std::runtime_error& error) {
    throw OutputError("write", path, error.what());
  }
  content += seal_of(content);
  write_file_atomically(path, content);
}

Checkpoint read_checkpoint(const std::filesystem::path& path, const Scene& scene) {
  check_seal(path);
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::open_for_reading(path);
  try {
    check_origin(file, scene, path);
    Checkpoint state;
    state.file = path;
    state.time = hdf5::read_double_attribute(file, "time");
    if (!(std::isfinite(state.time) && state.time >= 0.0))
      throw OutputError("resume from", path, fmt::format("its time is {} s", state.time));
    state.rows = {hdf5::read_integer_attribute(file, "rows"),
                  hdf5::read_string_attribute(file, "rows_sha256")};
    state.instants_sha256 = hdf5::read_string_attribute(file, "instants_sha256");
    const auto scalars = hdf5::open_group(file, "scalars");
    for (const auto& name : hdf5::attribute_names(scalars)) {
      state.scalars[name] = hdf5::read_double_attribute(scalars, name);
    }
    const auto counters = hdf5::open_group(file, "counters");
    for (const auto& name : hdf5::attribute_names(counters)) {
      state.counters[name] = hdf5::read_integer_attribute(counters, name);
    }
    const auto arrays = hdf5::open_group(file, "arrays");
    for (const auto& name : hdf5::names_in(arrays)) state.arrays[name] = hdf5::read_doubles(arrays, name);
    return state;
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw OutputError("resume from", path, error.what());
  }
}

}  // namespace granvof
