// A case between text and Scene: what its keys say, before defaults that depend on other keys are filled in.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "solver/scene/presets.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::case_file {

// What one word says of a whole side: its kind, and of a wall what it is to both phases.
struct SideWord {
  SideKind kind = SideKind::wall;
  WallKind wall = WallKind::no_slip;
  bool operator==(const SideWord&) const = default;
};

// Either one word for the whole side, or the phases apart.
struct SideInput {
  std::optional<SideWord> word;
  std::optional<WallKind> fluid, solid;
  std::optional<double> solid_friction, bumpiness, bump_restitution;
  std::vector<double> velocity;  // empty: at rest
  std::optional<double> inflow, inflow_solid_fraction, inflow_liquid_share;
  std::optional<double> outflow_pressure, outflow_level;
};

enum class BedPlace { floor, on_water, floating };
enum class TimeUnit { second, column };

struct BedInput {
  double x = 0.0;
  double length = 0.0, height = 0.0;
  double solid_fraction = 0.0;
  double slope = Bed{}.slope;
  std::variant<double, BedPlace> y = BedPlace::floor;
  std::optional<double> z, width;
  std::optional<double> solid_volume, filled;  // filled: the height that solid_volume fills [m]
  ColourPattern colour = ColourPattern::uniform;
  std::optional<double> colour_size;
};

// Corners by axis, one number an obstacle each.
struct ObstacleInput {
  std::array<std::vector<double>, 3> lower, upper;
};

struct ReferenceInput {
  ReferenceSettings settings;
  std::optional<ReferenceRelease> release;
  std::optional<double> slice_depth, hold, packing, bead_friction, bead_restitution, wall_friction,
      gate_friction;  // gate_friction stays empty where it is that of the walls
};

struct TimesInput {
  double end = 0.0;
  TimeUnit unit = TimeUnit::second;
  double hold = 0.0;
  std::optional<double> series_interval, field_interval;
  std::vector<double> field_times;
  double checkpoint_interval = Times{}.checkpoint_interval;
};

inline constexpr int side_all = 6;  // index of walls.all beside those of SideIndex

struct Draft {
  std::set<std::string> tables;  // the tables that the case has
  Scene scene;                   // holds what a key gives directly; its initial values are the paper's
  Preset preset = default_preset;
  std::vector<double> tank_size;
  std::optional<double> depth;
  double dx = 0.0;
  std::optional<double> dy, dz;
  std::array<SideInput, 7> sides;
  std::optional<double> level;
  std::vector<double> box_origin, box_size;
  BedInput bed;
  std::optional<double> gate_position;
  double gate_speed = 0.0;
  ObstacleInput obstacles;
  TimesInput times;
  ReferenceInput reference;
};

}  // namespace granvof::case_file
