// fields.xdmf: the description by which ParaView opens fields.h5.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace granvof {

struct XdmfInstant {
  std::string group;  // of fields.h5
  double time = 0.0;  // [s]
  bool has_solid_pressure = false;
};

// Text of an XDMF 2 file: a temporal collection of uniform grids, all fields at cell centres.
// `cells` and `spacing` [m] are along x, y, z; the grid starts at the origin.
std::string xdmf_text(const std::string& data_file, const std::array<int, 3>& cells,
                      const std::array<double, 3>& spacing, const std::vector<XdmfInstant>& instants);

}  // namespace granvof
