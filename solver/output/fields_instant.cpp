#include "solver/output/fields_instant.hpp"

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "solver/output/hdf5_file.hpp"

namespace granvof {

namespace {

// Everything that an instant holds, in the terms of netCDF, so that what reads that knows axes, units and
// meaning.
struct Variable {
  const char* name;
  const char* units;
  const char* long_name;
};

constexpr std::array variables{Variable{"f_s", "-", "solid fraction"},
                               Variable{"alpha", "-", "liquid share of the continuous phase"},
                               Variable{"p_c", "Pa", "fluid pressure"},
                               Variable{"p_s", "Pa", "solid pressure"},
                               Variable{"theta", "m2/s2", "granular temperature"},
                               Variable{"phi", "-", "colour of the solid"},
                               Variable{"u_s", "m/s", "velocity of the grains"},
                               Variable{"u_c", "m/s", "velocity of the continuous phase"}};
// In the order of the data's dimensions; the last of vectors alone.
constexpr std::array axes{Variable{"z", "m", "centres of the cells"},
                          Variable{"y", "m", "centres of the cells"},
                          Variable{"x", "m", "centres of the cells"},
                          Variable{"component", "-", "0 along x, 1 along y, 2 along z"}};

void write_axes(hid_t group, const std::array<int, 3>& cells, const Vec3& spacing) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t d = 2 - axis;
    std::vector<double> centres(static_cast<std::size_t>(cells[d]));
    for (std::size_t i = 0; i < centres.size(); ++i) centres[i] = (static_cast<double>(i) + 0.5) * spacing[d];
    hdf5::write_doubles(group, axes[axis].name, centres);
  }
  hdf5::write_doubles(group, axes[3].name, std::array{0.0, 1.0, 2.0});
}

void write_scalar(hid_t group, const char* name, const CellFields& fields,
                  const std::vector<double>& values) {
  const hsize_t shape[] = {static_cast<hsize_t>(fields.cells[2]), static_cast<hsize_t>(fields.cells[1]),
                           static_cast<hsize_t>(fields.cells[0])};
  std::vector<float> single(values.size());
  for (std::size_t c = 0; c < values.size(); ++c) single[c] = static_cast<float>(values[c]);
  hdf5::write_compressed(group, name, shape, single);
}

// Always three components: a missing one, in 2D, is 0.
void write_vector(hid_t group, const char* name, const CellFields& fields,
                  const std::array<std::vector<double>, 3>& components) {
  const hsize_t shape[] = {static_cast<hsize_t>(fields.cells[2]), static_cast<hsize_t>(fields.cells[1]),
                           static_cast<hsize_t>(fields.cells[0]), 3};
  std::vector<float> single(3 * fields.f_s.size(), 0.0F);
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t c = 0; c < components[d].size(); ++c)
      single[3 * c + d] = static_cast<float>(components[d][c]);
  }
  hdf5::write_compressed(group, name, shape, single);
}

// Values of cells that lie in another order are those of a grid that is none of ours.
void require_shape(hid_t group, const char* name, std::vector<hsize_t> shape, const CellFields& fields) {
  const std::vector<hsize_t> grid{static_cast<hsize_t>(fields.cells[2]),
                                  static_cast<hsize_t>(fields.cells[1]),
                                  static_cast<hsize_t>(fields.cells[0])};
  const std::vector<hsize_t> has = hdf5::shape_of(group, name);
  shape.insert(shape.begin(), grid.begin(), grid.end());
  if (has != shape)
    throw std::runtime_error(fmt::format("{} has the shape ({}), allowed: ({})", name, fmt::join(has, ", "),
                                         fmt::join(shape, ", ")));
}

std::vector<double> read_scalar(hid_t group, const char* name, const CellFields& fields) {
  require_shape(group, name, {}, fields);
  return hdf5::read_doubles(group, name);
}

std::array<std::vector<double>, 3> read_vector(hid_t group, const char* name, const CellFields& fields) {
  require_shape(group, name, {3}, fields);
  const auto values = hdf5::read_doubles(group, name);
  std::array<std::vector<double>, 3> components;
  for (std::size_t d = 0; d < 3; ++d) {
    components[d].reserve(values.size() / 3);
    for (std::size_t c = d; c < values.size(); c += 3) components[d].push_back(values[c]);
  }
  return components;
}

}  // namespace

void describe_instant(hid_t group, double time) {
  hdf5::write_attribute(group, "time", time);
  std::vector<hdf5::Handle> scales;
  for (const Variable& axis : axes) {
    if (!hdf5::exists(group, axis.name)) continue;  // of an earlier version
    scales.push_back(hdf5::open_dataset(group, axis.name));
    hdf5::make_scale(scales.back(), axis.name);
    hdf5::write_attribute(scales.back(), "units", std::string(axis.units));
    hdf5::write_attribute(scales.back(), "long_name", std::string(axis.long_name));
  }
  for (const Variable& variable : variables) {
    if (!hdf5::exists(group, variable.name)) continue;
    const auto data = hdf5::open_dataset(group, variable.name);
    hdf5::write_attribute(data, "units", std::string(variable.units));
    hdf5::write_attribute(data, "long_name", std::string(variable.long_name));
    const std::size_t dimensions = hdf5::shape_of(group, variable.name).size();
    for (std::size_t i = 0; i < scales.size() && i < dimensions; ++i)
      hdf5::attach_scale(data, scales[i], static_cast<unsigned>(i));
  }
}

void write_instant(hid_t group, const CellFields& fields, const Vec3& spacing) {
  write_axes(group, fields.cells, spacing);
  write_scalar(group, "f_s", fields, fields.f_s);
  write_scalar(group, "alpha", fields, fields.alpha);
  write_scalar(group, "p_c", fields, fields.p_c);
  write_scalar(group, "theta", fields, fields.theta);
  write_scalar(group, "phi", fields, fields.phi);
  if (!fields.p_s.empty()) write_scalar(group, "p_s", fields, fields.p_s);
  write_vector(group, "u_s", fields, fields.u_s);
  write_vector(group, "u_c", fields, fields.u_c);
  describe_instant(group, fields.time);
}

CellFields read_instant(hid_t file, hid_t group) {
  CellFields fields = read_solid_fraction_of(file, group);
  fields.alpha = read_scalar(group, "alpha", fields);
  fields.p_c = read_scalar(group, "p_c", fields);
  fields.theta = read_scalar(group, "theta", fields);
  fields.phi = read_scalar(group, "phi", fields);
  if (hdf5::exists(group, "p_s")) fields.p_s = read_scalar(group, "p_s", fields);
  fields.u_s = read_vector(group, "u_s", fields);
  fields.u_c = read_vector(group, "u_c", fields);
  try {
    check_sizes(fields);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(error.what());
  }
  return fields;
}

CellFields read_solid_fraction_of(hid_t file, hid_t group) {
  CellFields fields;
  fields.time = hdf5::read_double_attribute(group, "time");
  const auto cells = hdf5::read_double_array_attribute(file, "cells");
  const auto spacing = hdf5::read_double_array_attribute(file, "spacing");
  if (cells.size() != 3 || spacing.size() != 3) throw std::runtime_error("cells or spacing is not a triple");
  double count = 1.0;
  for (std::size_t d = 0; d < 3; ++d) {
    if (!(cells[d] >= 1.0 && cells[d] <= std::numeric_limits<int>::max()))
      throw std::runtime_error(fmt::format("there are {} cells in a direction", cells[d]));
    fields.cells[d] = static_cast<int>(cells[d]);
    fields.spacing[d] = spacing[d];
    count *= cells[d];
  }
  fields.f_s = hdf5::read_doubles(group, "f_s");
  if (static_cast<double>(fields.f_s.size()) != count)
    throw std::runtime_error(fmt::format("f_s has {} values for {} cells", fields.f_s.size(), count));
  require_shape(group, "f_s", {}, fields);
  return fields;
}

}  // namespace granvof
