#include "solver/output/hdf5_file.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <hdf5_hl.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/open_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof::hdf5 {

namespace {

constexpr unsigned gzip_level = 4;
constexpr std::size_t memory_increment = std::size_t{1} << 20U;

template <class Result>
Result checked(Result result, const std::string& what) {
  if (result < 0) throw std::runtime_error(what + ": " + last_error());
  return result;
}

Handle space_of(std::span<const hsize_t> shape) {
  return {checked(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), "dataspace"),
          H5Sclose};
}

// Properties of a new dataset. HDF5 would put the hour into it, and two runs would not be equal to the byte.
Handle dataset_properties() {
  Handle properties(checked(H5Pcreate(H5P_DATASET_CREATE), "property list"), H5Pclose);
  checked(H5Pset_obj_track_times(properties, false), "property list");
  return properties;
}

// How a group or a dataset is to be reached: by no link into another file.
Handle inside_this_file(hid_t access_class) {
  Handle access(checked(H5Pcreate(access_class), "property list"), H5Pclose);
  const auto refuse = [](const char*, const char*, const char*, const char*, unsigned*, hid_t,
                         void*) -> herr_t { return -1; };
  checked(H5Pset_elink_cb(access, refuse, nullptr), "property list");
  return access;
}

// Throws unless an attribute holds one value: HDF5 writes as many as there are.
void require_one(const Handle& attribute, const std::string& name) {
  const Handle space(checked(H5Aget_space(attribute), "attribute " + name), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw std::runtime_error("attribute " + name + ": it holds more or less than one value");
}

Handle open_attribute(hid_t object, const std::string& name) {
  return {checked(H5Aopen(object, name.c_str(), H5P_DEFAULT), "attribute " + name), H5Aclose};
}

void write_attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type,
                     const Handle& space, const void* data) {
  const Handle attribute(checked(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT),
                                 "attribute " + name),
                         H5Aclose);
  checked(H5Awrite(attribute, memory_type, data), "attribute " + name);
}

Handle scalar_space() {
  return {checked(H5Screate(H5S_SCALAR), "dataspace"), H5Sclose};
}

std::size_t points_of(const Handle& space) {
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space), "dataspace"));
}

// A file may claim any size.
std::vector<double> room_for(std::size_t values, const std::string& what) {
  try {
    return std::vector<double>(values);
  } catch (const std::exception&) {  // bad_alloc, length_error
    throw std::runtime_error(fmt::format("{}: no memory for {} values", what, values));
  }
}

}  // namespace

QuietErrors::QuietErrors() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

QuietErrors::~QuietErrors() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

std::string last_error() {
  std::string message;
  const auto take = [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
    auto& text = *static_cast<std::string*>(data);
    if (text.empty() && error->desc != nullptr) text = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &message);
  return message.empty() ? "unknown HDF5 error" : message;
}

Handle create_in_memory() {
  const Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), "property list"), H5Pclose);
  checked(H5Pset_fapl_core(access, memory_increment, false), "memory driver");
  return {checked(H5Fcreate("memory", H5F_ACC_TRUNC, H5P_DEFAULT, access), "file in memory"), H5Fclose};
}

std::string content_of(const Handle& file) {
  checked(H5Fflush(file, H5F_SCOPE_GLOBAL), "file in memory");
  const auto size = checked(H5Fget_file_image(file, nullptr, 0), "file in memory");
  std::string content(static_cast<std::size_t>(size), '\0');
  checked(H5Fget_file_image(file, content.data(), content.size()), "file in memory");
  return content;
}

// Without HDF5's own locks, which not every file system has: what is written is written by one program, into
// a file of its own, and whole when it gets its name.
Handle without_locks() {
  Handle access(checked(H5Pcreate(H5P_FILE_ACCESS), "property list"), H5Pclose);
  checked(H5Pset_file_locking(access, false, true), "file locking");
  return access;
}

Handle open_for_writing(const std::filesystem::path& path) {
  require_file(path, "write");
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDWR, without_locks());
  if (id < 0) throw OutputError("write", path, last_error());
  return {id, H5Fclose};
}

Handle open_for_reading(const std::filesystem::path& path) {
  // The library opens by name, and would wait for a pipe: it is given the name of what is open.
  const Descriptor file = open_file(path);
  const hid_t id = H5Fopen(path_by_descriptor(file, path).c_str(), H5F_ACC_RDONLY, without_locks());
  if (id < 0) throw OutputError("read", path, last_error());
  return {id, H5Fclose};
}

Handle create_group(hid_t parent, const std::string& name) {
  return {checked(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "group " + name),
          H5Gclose};
}

Handle open_group(hid_t parent, const std::string& name) {
  return {checked(H5Gopen2(parent, name.c_str(), inside_this_file(H5P_GROUP_ACCESS)), "group " + name),
          H5Gclose};
}

std::optional<OtherFile> link_to_other_file(hid_t group, const std::string& name) {
  H5L_info_t link;
  checked(H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT), "link " + name);
  if (link.type != H5L_TYPE_EXTERNAL) return std::nullopt;
  std::vector<char> value(link.u.val_size);
  checked(H5Lget_val(group, name.c_str(), value.data(), value.size(), H5P_DEFAULT), "link " + name);
  const char* file = nullptr;
  const char* object = nullptr;
  checked(H5Lunpack_elink_val(value.data(), value.size(), nullptr, &file, &object), "link " + name);
  return OtherFile{file, object};
}

std::vector<std::string> names_in(hid_t group) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), "names of a group");
  return names;
}

std::vector<std::string> attribute_names(hid_t object) {
  std::vector<std::string> names;
  const auto add = [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
    static_cast<std::vector<std::string>*>(data)->emplace_back(name);
    return 0;
  };
  checked(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &names), "names of attributes");
  return names;
}

bool exists(hid_t group, const std::string& name) {
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0;
}

void write_attribute(hid_t object, const std::string& name, double value) {
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar_space(), &value);
}

void write_attribute(hid_t object, const std::string& name, std::int64_t value) {
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, scalar_space(), &value);
}

void write_attribute(hid_t object, const std::string& name, std::span<const double> values) {
  const hsize_t shape[] = {values.size()};
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space_of(shape), values.data());
}

void write_attribute(hid_t object, const std::string& name, std::span<const int> values) {
  const hsize_t shape[] = {values.size()};
  write_attribute(object, name, H5T_STD_I32LE, H5T_NATIVE_INT, space_of(shape), values.data());
}

void write_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type(checked(H5Tcopy(H5T_C_S1), "text type"), H5Tclose);
  checked(H5Tset_size(type, std::max<std::size_t>(value.size(), 1)), "text type");
  checked(H5Tset_strpad(type, H5T_STR_NULLPAD), "text type");
  checked(H5Tset_cset(type, H5T_CSET_UTF8), "text type");
  write_attribute(object, name, type, type, scalar_space(), value.c_str());
}

double read_double_attribute(hid_t object, const std::string& name) {
  const auto attribute = open_attribute(object, name);
  require_one(attribute, name);
  double value = 0.0;
  checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "attribute " + name);
  return value;
}

std::int64_t read_integer_attribute(hid_t object, const std::string& name) {
  const auto attribute = open_attribute(object, name);
  require_one(attribute, name);
  std::int64_t value = 0;
  checked(H5Aread(attribute, H5T_NATIVE_INT64, &value), "attribute " + name);
  return value;
}

std::vector<double> read_double_array_attribute(hid_t object, const std::string& name) {
  const auto attribute = open_attribute(object, name);
  const Handle space(checked(H5Aget_space(attribute), "attribute " + name), H5Sclose);
  auto values = room_for(points_of(space), "attribute " + name);
  checked(H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()), "attribute " + name);
  return values;
}

std::string read_string_attribute(hid_t object, const std::string& name) {
  const auto attribute = open_attribute(object, name);
  require_one(attribute, name);
  const Handle type(checked(H5Aget_type(attribute), "attribute " + name), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
    throw std::runtime_error("attribute " + name + ": it is no text of a fixed length");
  std::string value(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, value.data()), "attribute " + name);
  value.resize(std::min(value.size(), value.find('\0')));
  return value;
}

void write_compressed(hid_t group, const std::string& name, std::span<const hsize_t> shape,
                      std::span<const float> values) {
  const Handle properties = dataset_properties();
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  chunk.front() = 1;
  checked(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "chunks");
  checked(H5Pset_shuffle(properties), "shuffle filter");
  checked(H5Pset_deflate(properties, gzip_level), "gzip filter");
  const Handle dataset(checked(H5Dcreate2(group, name.c_str(), H5T_IEEE_F32LE, space_of(shape), H5P_DEFAULT,
                                          properties, H5P_DEFAULT),
                               "dataset " + name),
                       H5Dclose);
  checked(H5Dwrite(dataset, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "dataset " + name);
}

void write_doubles(hid_t group, const std::string& name, std::span<const double> values) {
  const hsize_t shape[] = {values.size()};
  const Handle dataset(checked(H5Dcreate2(group, name.c_str(), H5T_IEEE_F64LE, space_of(shape), H5P_DEFAULT,
                                          dataset_properties(), H5P_DEFAULT),
                               "dataset " + name),
                       H5Dclose);
  checked(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "dataset " + name);
}

std::vector<double> read_doubles(hid_t group, const std::string& name) {
  const auto dataset = open_dataset(group, name);
  const Handle space(checked(H5Dget_space(dataset), "dataset " + name), H5Sclose);
  auto values = room_for(points_of(space), "dataset " + name);
  checked(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "dataset " + name);
  return values;
}

std::vector<hsize_t> shape_of(hid_t group, const std::string& name) {
  const auto dataset = open_dataset(group, name);
  const Handle space(checked(H5Dget_space(dataset), "dataset " + name), H5Sclose);
  std::vector<hsize_t> shape(
      static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space), "dataspace")));
  checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr), "dataspace");
  return shape;
}

// Values that lie in another file are refused: see the header.
Handle open_dataset(hid_t group, const std::string& name) {
  Handle dataset(
      checked(H5Dopen2(group, name.c_str(), inside_this_file(H5P_DATASET_ACCESS)), "dataset " + name),
      H5Dclose);
  const Handle made(checked(H5Dget_create_plist(dataset), "dataset " + name), H5Pclose);
  const bool elsewhere = H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) != 0;
  if (elsewhere) throw std::runtime_error("dataset " + name + ": its values lie in another file");
  return dataset;
}

void make_scale(hid_t dataset, const std::string& name) {
  checked(H5DSset_scale(dataset, name.c_str()), "scale " + name);
}

void attach_scale(hid_t dataset, hid_t scale, unsigned dimension) {
  checked(H5DSattach_scale(dataset, scale, dimension), "scale of a dataset");
}

}  // namespace granvof::hdf5
