#include "solver/output/fields_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/build_info.hpp"
#include "solver/output/fields_instant.hpp"
#include "solver/output/hdf5_file.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/own_process.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/xdmf.hpp"

namespace granvof {

namespace {

namespace fs = std::filesystem;

constexpr const char* file_name = "fields.h5";
constexpr const char* pieces_directory = "fields";
constexpr const char* piece_object = "/instant";
// Of the instants that there are a share of one in so many may be missing in the lists. Writing the lists
// then takes so many times what writing them once takes, whatever the number of instants.
constexpr std::size_t instants_per_unlisted = 16;

std::string group_name(std::size_t index) {
  return fmt::format("t{:04}", index);
}

// Runs `action`, turning HDF5's failures into OutputError.
template <class Action>
auto with_path(const char* verb, const fs::path& path, Action action) {
  try {
    return action();
  } catch (const OutputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw OutputError(verb, path, error.what());
  }
}

std::string piece_name(std::size_t index) {
  return fmt::format("{}/{}.h5", pieces_directory, group_name(index));
}

// The group of an instant, and the file that holds it where that is not fields.h5 itself.
struct OpenInstant {
  std::optional<hdf5::Handle> piece;
  hdf5::Handle group;
};

// `file` is the open fields.h5 at `path`. Its link to another file is followed here and not by HDF5, which
// would open whatever stands there, a pipe too.
OpenInstant open_instant(hid_t file, const fs::path& path, std::size_t index) {
  const auto name = group_name(index);
  const auto link = hdf5::link_to_other_file(file, name);
  if (!link) return {std::nullopt, hdf5::open_group(file, name)};
  if (link->file != piece_name(index) || link->object != piece_object) {
    throw std::runtime_error(fmt::format("{} links to {} in {}, allowed: {} in {}", name, link->object,
                                         link->file, piece_object, piece_name(index)));
  }
  const auto piece_path = path.parent_path() / link->file;
  hdf5::Handle piece = hdf5::open_for_reading(piece_path);
  return with_path("read", piece_path, [&]() -> OpenInstant {
    auto group = hdf5::open_group(piece, piece_object);
    return {std::move(piece), std::move(group)};
  });
}

std::vector<double> times_of(hid_t file, const fs::path& path) {
  std::vector<double> times;
  const auto count = hdf5::names_in(file).size();
  for (std::size_t index = 0; index < count; ++index)
    times.push_back(hdf5::read_double_attribute(open_instant(file, path, index).group, "time"));
  return times;
}

void add_values(Digest& digest, const std::vector<double>& values, std::size_t count) {
  std::vector<float> single(count, 0.0F);  // a component that is missing, in 2D, is 0
  for (std::size_t c = 0; c < values.size(); ++c) single[c] = static_cast<float>(values[c]);
  digest.add({reinterpret_cast<const char*>(single.data()), single.size() * sizeof(float)});
}

// The values of an instant, as precise as they are written.
void add_instant(Digest& digest, const CellFields& fields) {
  const std::size_t cells = fields.f_s.size();
  digest.add(fmt::format("{} {} {}\n", fields.time, cells, fields.p_s.empty()));
  for (const auto* values : {&fields.f_s, &fields.alpha, &fields.p_c, &fields.theta, &fields.phi})
    add_values(digest, *values, cells);
  if (!fields.p_s.empty()) add_values(digest, fields.p_s, cells);
  for (const auto* vector : {&fields.u_s, &fields.u_c})
    for (const auto& component : *vector) add_values(digest, component, cells);
}

// Copies one instant to `target`. Its attributes are written anew: those that refer to axes refer to places
// in the file.
void copy_group(const hdf5::Handle& group, hid_t target, const std::string& name) {
  const hdf5::Handle copying(H5Pcreate(H5P_OBJECT_COPY), H5Pclose);
  if (H5Pset_copy_object(copying, H5O_COPY_WITHOUT_ATTR_FLAG) < 0 ||
      H5Ocopy(group, ".", target, name.c_str(), copying, H5P_DEFAULT) < 0) {
    throw std::runtime_error("group " + name + ": " + hdf5::last_error());
  }
  describe_instant(hdf5::open_group(target, name), hdf5::read_double_attribute(group, "time"));
}

// Whether "fields/NAME" is the file of an instant >= first, or a draft of one.
bool is_piece(std::string name, std::size_t first) {
  if (name.ends_with(".tmp")) name.resize(name.size() - 4);
  if (!name.starts_with('t') || !name.ends_with(".h5")) return false;
  const std::string digits = name.substr(1, name.size() - 4);
  return digits.size() >= 4 && digits.size() < 10 &&
         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }) &&
         std::stoul(digits) >= first;
}

// Removes the files of the instants from `first` on, and the folder if that leaves it empty: what else is in
// it is not ours.
void remove_pieces(const fs::path& folder, std::size_t first) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) return;
  std::vector<fs::path> pieces;
  for (const auto& entry : fs::directory_iterator(folder))
    if (is_piece(entry.path().filename().string(), first)) pieces.push_back(entry.path());
  for (const fs::path& file : pieces) {
    fs::remove(file, error);
    if (error) throw OutputError("replace", file, error.message());
  }
  // Fails where something is left, and should; and on a link to a folder elsewhere, which is the user's.
  ::rmdir(folder.c_str());
}

}  // namespace

FieldsFile::FieldsFile(fs::path directory, const Scene& scene)
    : directory_(std::move(directory)),
      scene_name_(scene.name),
      cells_(scene.grid.cells),
      spacing_(scene.grid.spacing) {
  // A slab of one cell is shown as thick as it is fine; how deep the tank is, its case says.
  if (scene.dimensions == 2 && cells_[2] == 1) spacing_[2] = spacing_[0];
}

fs::path FieldsFile::piece(std::size_t index) const {
  return directory_ / piece_name(index);
}

FieldsFile FieldsFile::create(const fs::path& directory, const Scene& scene) {
  FieldsFile file(directory, scene);
  file.write_lists();
  return file;
}

void FieldsFile::check_instants(const fs::path& directory, std::span<const double> times,
                                const std::string& sha256) {
  const auto path = directory / file_name;
  Digest digest;
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::open_for_reading(path);
  with_path("read", path, [&] {
    const std::vector<double> there = times_of(file, path);
    for (std::size_t index = 0; index < times.size(); ++index) {
      if (index < there.size() && there[index] == times[index]) {
        // A damaged instant would be carried into the joined file.
        add_instant(digest, read_instant(file, open_instant(file, path, index).group));
        continue;
      }
      throw OutputError(
          "resume", path,
          fmt::format("instant {} should be of t = {} s, the case asks for it before the checkpoint, and {}",
                      index + 1, times[index],
                      index < there.size() ? fmt::format("is of {} s", there[index]) : "is not there"));
    }
    if (!sha256.empty() && digest.hex() != sha256)
      throw OutputError("resume", path,
                        "its instants are not what the run has written: one was changed since");
  });
}

FieldsFile FieldsFile::resume(const fs::path& directory, const Scene& scene, std::span<const double> times) {
  check_instants(directory, times);
  FieldsFile result(directory, scene);
  const auto path = directory / file_name;
  {
    const hdf5::QuietErrors quiet;
    const auto file = hdf5::open_for_reading(path);
    with_path("resume", path, [&] {
      fs::create_directories(directory / pieces_directory);
      for (std::size_t index = 0; index < times.size(); ++index) {
        const auto instant = open_instant(file, path, index);
        const auto target = result.piece(index);
        const CellFields fields = read_instant(file, instant.group);
        if (!fs::exists(target))  // fields.h5 has been joined: the instant anew, as it was to the byte
          write_file_atomically(target, result.piece_content(fields));
        add_instant(result.digest_, fields);
        result.instants_.push_back({times[index], !fields.p_s.empty(), result.digest_.hex()});
      }
    });
  }
  result.write_lists();
  remove_pieces(directory / pieces_directory, result.instants_.size());
  return result;
}

void FieldsFile::remove(const fs::path& directory) {
  for (const char* name : {"fields.xdmf", "fields.xdmf.tmp", "fields.h5", "fields.h5.tmp"}) {
    std::error_code error;
    fs::remove(directory / name, error);
    if (error) throw OutputError("replace", directory / name, error.message());
  }
  remove_pieces(directory / pieces_directory, 0);
}

void FieldsFile::check_still_there() const {
  for (std::size_t index = 0; index < instants_.size(); ++index)
    if (!fs::exists(piece(index)))
      throw OutputError("write", piece(index), "it was removed while the run went on");
}

std::string FieldsFile::piece_content(const CellFields& fields) const {
  const auto memory = hdf5::create_in_memory();
  write_instant(hdf5::create_group(memory, "instant"), fields, spacing_);
  return hdf5::content_of(memory);
}

void FieldsFile::append(const CellFields& fields) {
  check_sizes(fields);
  if (!instants_.empty() && !fs::exists(piece(instants_.size() - 1))) check_still_there();
  if (fields.cells != cells_) throw std::invalid_argument("the fields have not the grid of the scene");
  const auto path = piece(instants_.size());
  const std::string content = with_path("write", path, [&] {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (error) throw OutputError("write", path, error.message());
    const hdf5::QuietErrors quiet;
    return piece_content(fields);
  });
  write_file_atomically(path, content);
  instants_.push_back({fields.time, !fields.p_s.empty(), {}});
  if (instants_.size() - listed_ > instants_.size() / instants_per_unlisted) {
    try {
      write_lists();
    } catch (...) {
      instants_.pop_back();
      throw;
    }
  }
  add_instant(digest_, fields);
  instants_.back().sha256 = digest_.hex();
}

std::string FieldsFile::sha256(double until) const {
  const auto later = std::find_if(instants_.begin(), instants_.end(),
                                  [=](const Instant& instant) { return instant.time > until; });
  return later == instants_.begin() ? Digest().hex() : std::prev(later)->sha256;
}

void FieldsFile::bring_up_to_date() {
  if (listed_ < instants_.size()) write_lists();
}

std::string FieldsFile::xdmf() const {
  std::vector<XdmfInstant> instants;
  for (std::size_t index = 0; index < instants_.size(); ++index) {
    instants.push_back({group_name(index), instants_[index].time, instants_[index].has_solid_pressure});
  }
  return xdmf_text(file_name, cells_, spacing_, instants);
}

// `file` is an identifier of HDF5.
void FieldsFile::write_file_attributes(std::int64_t file) const {
  const Vec3 origin{};
  hdf5::write_attribute(file, "contract_version", std::int64_t{output_contract_version});
  hdf5::write_attribute(file, "version", std::string(build_info().version));
  hdf5::write_attribute(file, "scene", scene_name_);
  hdf5::write_attribute(file, "cells", std::span<const int>(cells_));
  hdf5::write_attribute(file, "spacing", std::span<const double>(spacing_));
  hdf5::write_attribute(file, "origin", std::span<const double>(origin));
}

void FieldsFile::write_lists() {
  const auto path = directory_ / file_name;
  const std::string content = with_path("write", path, [&] {
    const hdf5::QuietErrors quiet;
    const auto memory = hdf5::create_in_memory();
    write_file_attributes(memory);
    for (std::size_t index = 0; index < instants_.size(); ++index) {
      if (H5Lcreate_external(piece_name(index).c_str(), piece_object, memory, group_name(index).c_str(),
                             H5P_DEFAULT, H5P_DEFAULT) < 0) {
        throw std::runtime_error(hdf5::last_error());
      }
    }
    return hdf5::content_of(memory);
  });
  write_file_atomically(path, content);
  write_file_atomically(directory_ / "fields.xdmf", xdmf());
  listed_ = instants_.size();
}

bool FieldsFile::join() {
  if (instants_.empty()) return true;
  const auto path = directory_ / file_name;
  const auto draft = directory_ / "fields.h5.tmp";
  std::error_code ignored;
  try {
    bring_up_to_date();
    const hdf5::QuietErrors quiet;
    reserve_for_joining(draft);
    if (!succeeds_in_own_process(directory_, [&] { write_joined(draft.filename()); }))
      throw OutputError("write", draft, "HDF5 has not written it");
    const Descriptor written(::open(draft.c_str(), O_RDONLY | O_CLOEXEC));
    if (!written.valid()) throw OutputError("write", draft, "it has gone");
    sync(written, draft);
    rename_into_place(path);
  } catch (const std::runtime_error&) {
    fs::remove(draft, ignored);
    return false;
  }
  remove_pieces(directory_ / pieces_directory, 0);
  return true;
}

// In the directory as the working directory. HDF5 1.10 crashes where a write fails (an error of the disk):
// only to be called where that ends nothing else.
void FieldsFile::write_joined(const fs::path& draft) const {
  const fs::path path = file_name;
  const auto source = hdf5::open_for_reading(path);
  auto target = hdf5::open_for_writing(draft);
  write_file_attributes(target);
  for (std::size_t index = 0; index < instants_.size(); ++index)
    copy_group(open_instant(source, path, index).group, target, group_name(index));
  if (!target.close()) throw OutputError("write", draft, hdf5::last_error());
}

// Makes `draft` an empty HDF5 file with room on the disk for all instants, so that a full disk shows before
// anything is written. HDF5 cuts off what it does not use.
void FieldsFile::reserve_for_joining(const fs::path& draft) const {
  std::uintmax_t bytes = 0;
  for (std::size_t index = 0; index < instants_.size(); ++index) bytes += fs::file_size(piece(index)) + 4096;
  std::error_code ignored;
  fs::remove(draft, ignored);  // a link, or a pipe, that has its name
  const Descriptor file(::open(draft.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
  if (!file.valid()) throw OutputError("write", draft, std::generic_category().message(errno));
  write_all(file, hdf5::content_of(hdf5::create_in_memory()), draft);
  if (const int error = ::posix_fallocate(file.get(), 0, static_cast<off_t>(bytes)); error != 0) {
    throw OutputError("write", draft, std::generic_category().message(error));
  }
}

std::vector<double> read_field_times(const fs::path& fields_h5) {
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::open_for_reading(fields_h5);
  return with_path("read", fields_h5, [&] { return times_of(file, fields_h5); });
}

CellFields read_fields(const fs::path& fields_h5, std::size_t index) {
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::open_for_reading(fields_h5);
  return with_path("read", fields_h5,
                   [&] { return read_instant(file, open_instant(file, fields_h5, index).group); });
}

CellFields read_solid_fraction(const fs::path& fields_h5, std::size_t index) {
  const hdf5::QuietErrors quiet;
  const auto file = hdf5::open_for_reading(fields_h5);
  return with_path("read", fields_h5,
                   [&] { return read_solid_fraction_of(file, open_instant(file, fields_h5, index).group); });
}

}  // namespace granvof
