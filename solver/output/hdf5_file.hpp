// The few HDF5 calls that this library needs, with handles that close themselves and failures as exceptions.
// Private to solver/output: no public header includes hdf5.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <hdf5.h>

namespace granvof::hdf5 {

// An HDF5 identifier with the function that closes it.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept : id_(other.id_), close_(other.close_) { other.id_ = H5I_INVALID_HID; }
  Handle& operator=(Handle&&) = delete;
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  hid_t get() const { return id_; }
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): passed to every HDF5 call
  // Closes now, and says whether that worked: closing a file writes what is still in memory.
  bool close() {
    const hid_t id = id_;
    id_ = H5I_INVALID_HID;
    return close_(id) >= 0;
  }

 private:
  hid_t id_;
  Close close_;
};

// Keeps HDF5 from printing its error stack while it lives; failures are thrown instead.
class QuietErrors {
 public:
  QuietErrors();
  ~QuietErrors();
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  QuietErrors(QuietErrors&&) = delete;
  QuietErrors& operator=(QuietErrors&&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

// The innermost message of HDF5's error stack.
std::string last_error();

// Creates a file that exists in memory only. content_of() gives the bytes that it would have on disk.
Handle create_in_memory();
std::string content_of(const Handle& file);
// An existing file, a regular one. Throws OutputError.
Handle open_for_writing(const std::filesystem::path& path);
Handle open_for_reading(const std::filesystem::path& path);

// Everything below throws std::runtime_error with HDF5's message; callers add the path. No other file is ever
// opened: HDF5 would open whatever has the name that a file holds (a pipe, on which it waits), and look for
// it in more than one folder. A link that leads elsewhere, or values that lie there, are a failure.
Handle create_group(hid_t parent, const std::string& name);
Handle open_group(hid_t parent, const std::string& name);
// Where a link of `group` that leads into another file leads; nothing where it does not.
struct OtherFile {
  std::string file, object;
};
std::optional<OtherFile> link_to_other_file(hid_t group, const std::string& name);
std::vector<std::string> names_in(hid_t group);  // ascending
std::vector<std::string> attribute_names(hid_t object);
bool exists(hid_t group, const std::string& name);

void write_attribute(hid_t object, const std::string& name, double value);
void write_attribute(hid_t object, const std::string& name, std::int64_t value);
void write_attribute(hid_t object, const std::string& name, std::span<const double> values);
void write_attribute(hid_t object, const std::string& name, std::span<const int> values);
void write_attribute(hid_t object, const std::string& name, const std::string& value);
double read_double_attribute(hid_t object, const std::string& name);
std::int64_t read_integer_attribute(hid_t object, const std::string& name);
std::vector<double> read_double_array_attribute(hid_t object, const std::string& name);
std::string read_string_attribute(hid_t object, const std::string& name);

// float32, chunks of one layer of the first dimension, shuffled and compressed by gzip.
void write_compressed(hid_t group, const std::string& name, std::span<const hsize_t> shape,
                      std::span<const float> values);
// float64, one-dimensional, as it is in memory.
void write_doubles(hid_t group, const std::string& name, std::span<const double> values);
// All values of a dataset of any shape, as double.
std::vector<double> read_doubles(hid_t group, const std::string& name);
std::vector<hsize_t> shape_of(hid_t group, const std::string& name);
Handle open_dataset(hid_t group, const std::string& name);
// Makes a one-dimensional dataset a dimension scale, and the scale of a dimension of another dataset.
void make_scale(hid_t dataset, const std::string& name);
void attach_scale(hid_t dataset, hid_t scale, unsigned dimension);

}  // namespace granvof::hdf5
