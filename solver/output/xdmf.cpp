#include "solver/output/xdmf.hpp"

#include <iterator>

#include <fmt/format.h>

namespace granvof {

namespace {

void add_attribute(std::string& text, const std::string& data_file, const XdmfInstant& instant,
                   const std::array<int, 3>& cells, const char* name, bool vector) {
  fmt::format_to(std::back_inserter(text),
                 R"(        <Attribute Name="{0}" AttributeType="{1}" Center="Cell">
          <DataItem Dimensions="{2} {3} {4}{5}" NumberType="Float" Precision="4" Format="HDF">{6}:/{7}/{0}</DataItem>
        </Attribute>
)",
                 name, vector ? "Vector" : "Scalar", cells[2], cells[1], cells[0], vector ? " 3" : "",
                 data_file, instant.group);
}

}  // namespace

std::string xdmf_text(const std::string& data_file, const std::array<int, 3>& cells,
                      const std::array<double, 3>& spacing, const std::vector<XdmfInstant>& instants) {
  std::string text = R"(<?xml version="1.0"?>
<Xdmf Version="2.0">
  <Domain>
    <Grid Name="granvof" GridType="Collection" CollectionType="Temporal">
)";
  for (const auto& instant : instants) {
    // Dimensions, origin and spacing are in the order z, y, x, as the data.
    fmt::format_to(std::back_inserter(text),
                   R"(      <Grid Name="{}" GridType="Uniform">
        <Time Value="{}"/>
        <Topology TopologyType="3DCoRectMesh" Dimensions="{} {} {}"/>
        <Geometry GeometryType="ORIGIN_DXDYDZ">
          <DataItem Dimensions="3" NumberType="Float" Precision="8" Format="XML">0 0 0</DataItem>
          <DataItem Dimensions="3" NumberType="Float" Precision="8" Format="XML">{} {} {}</DataItem>
        </Geometry>
)",
                   instant.group, instant.time, cells[2] + 1, cells[1] + 1, cells[0] + 1, spacing[2],
                   spacing[1], spacing[0]);
    for (const char* name : {"f_s", "alpha", "p_c", "theta", "phi"}) {
      add_attribute(text, data_file, instant, cells, name, false);
    }
    if (instant.has_solid_pressure) add_attribute(text, data_file, instant, cells, "p_s", false);
    for (const char* name : {"u_s", "u_c"}) add_attribute(text, data_file, instant, cells, name, true);
    text += "      </Grid>\n";
  }
  text += "    </Grid>\n  </Domain>\n</Xdmf>\n";
  return text;
}

}  // namespace granvof
