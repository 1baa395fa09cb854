// A scene: everything a case file in cases/ says, resolved to SI units and checked.
//
// The solver, the DEM-VOF reference and the comparison all read the same file through load_scene().
// Directions: 0 = x along the tank, 1 = y up, 2 = z across the tank.
// Equations: docs/theory/balances.md, docs/theory/contact.md,
//   docs/theory/drag.md, docs/theory/kinetic-theory.md.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/model/fluid.hpp"
#include "solver/model/grains.hpp"
#include "solver/model/laws.hpp"

namespace granvof {

using Vec3 = std::array<double, 3>;

// --- walls -------------------------------------------------------------------------------------------

enum class WallKind {
  no_slip,  // tangential velocity equals the wall's
  slip,     // no tangential stress
  coulomb,  // solid phase only: tangential stress at most friction * P_s
  bumpy     // solid phase only: grains are glued to it; those that hit them slip and heat, bumpy_wall.hpp
};

struct PhaseWall {
  WallKind kind = WallKind::no_slip;
  double friction = 0.0;     // mu_w [-], >= 0, read for coulomb only
  double bumpiness = 0.0;    // how deep grains reach between the bumps [degrees], in (0, 90], bumpy only
  double restitution = 0.0;  // of grains on the bumps [-], in [0, 1], bumpy only
  bool operator==(const PhaseWall&) const = default;
};

enum class SideKind {
  wall,      // closed to every phase
  open,      // top only: fluid passes at P_c = 0, gas flows in, grains do not pass
  periodic,  // joined to the opposite side
  inlet,     // both phases come in at a given speed
  outlet     // both phases leave, the fluid at a given pressure
};

// What comes in through an inlet: speed of both phases along the inward normal, and their fractions.
struct Inflow {
  double speed = 0.0;           // [m/s], > 0
  double solid_fraction = 0.0;  // [-]; at 0 grains find a closed wall
  double liquid_share = 0.0;    // alpha [-]
  bool operator==(const Inflow&) const = default;
};

// P_c on an outlet: `pressure` at its upper end, from there down that of a fluid at rest beyond it, gas above
// `level` and liquid below.
struct Outflow {
  double pressure = 0.0;  // [Pa]
  double level = 0.0;     // [m]
  bool operator==(const Outflow&) const = default;
};

struct Side {
  SideKind kind = SideKind::wall;
  PhaseWall fluid;
  PhaseWall solid;
  Vec3 velocity{};  // tangential velocity of the wall [m/s]
  Inflow inflow;    // of an inlet
  Outflow outflow;  // of an outlet
  bool operator==(const Side&) const = default;
};

enum SideIndex { left = 0, right = 1, bottom = 2, top = 3, front = 4, back = 5 };

// --- geometry ----------------------------------------------------------------------------------------

struct Box {
  Vec3 lower{};  // [m]
  Vec3 upper{};  // [m]
  bool operator==(const Box&) const = default;
};

// Colour phi of the grains at the start: bands of 1 and 0 in turn, 1 at the bed's lower left. For pictures of
// mixing only.
enum class ColourPattern { uniform, layers, columns, checks };

struct Bed {
  Box box;  // where the grains are at the start; length = upper[0] - lower[0], height in y
  double solid_fraction = 0.0;  // initial packing [-], in (0, f_s,max]
  double slope = 90.0;          // of the front face, from the horizontal [degrees], in (0, 90]; 90: a box
  ColourPattern colour = ColourPattern::uniform;
  double colour_size = 0.0;     // height of a layer, width of a column [m], > 0 unless uniform
  double nominal_height = 0.0;  // h0 [m], > 0: of the box, or more where less solid fills it
  bool operator==(const Bed&) const = default;
};

// A vertical plate at x = position that holds the column and rises at `speed` from t = 0.
struct Gate {
  double position = 0.0;  // [m]; the front face of the bed
  double speed = 0.0;     // [m/s], > 0
  bool operator==(const Gate&) const = default;
};

// --- what is modelled --------------------------------------------------------------------------------

using closures::CriticalPacking;
using closures::DragLaw;
using closures::FrictionLaw;
using closures::KineticTransport;
using closures::Packing;
using closures::RadialDistribution;
using closures::SlopeLimiter;
using closures::TemperatureModel;

// What a chosen law is called in a case file.
template <typename List>
std::string_view word_of(closures::Chosen<List> law);

// Each switch removes one physical part; the ablation reports show what each is worth.
struct Model {
  bool drag = true;  // eqs (8), (9)
  DragLaw drag_law;
  bool les = true;                        // eq (10)
  TemperatureModel granular_temperature;  // eq (7)
  bool pressure_work = true;              // -P_s^K div u_s in (7), see the corrections of (7)
  bool dense_excess = true;               // P_s^EF, eq (14)
  bool kinetic_viscosity = true;          // mu_s^K and zeta_s^K, eqs (20), (21)
  RadialDistribution radial_distribution;
  KineticTransport kinetic_transport;
  bool correlated_collisions = false;  // dissipate less in dense flow, collisions.hpp
  bool contact_friction = true;        // tau_s^E, eq (17)
  FrictionLaw friction_law;
  bool whole_stress_friction = false;  // friction_law is one of contacts and collisions, contact_friction.hpp
  Packing packing;
  bool thin_layer_arrest = false;  // layers on a rough floor stop at mu_stop(h), contact_friction.hpp
  bool shear_dilatancy = false;    // where grains touch follows shear, shear_dilatancy.hpp
  CriticalPacking critical_packing;
  bool dilatancy_friction = true;         // tan(psi) of shear_dilatancy adds to friction
  bool viscous_contact_pressure = false;  // of grains that a liquid shears past each other, suspension.hpp
  bool suspension_viscosity = false;      // of the liquid between sheared grains, suspension.hpp
  bool frictional_restitution = false;    // friction takes from collisions too, restitution.hpp
  bool agitation_drag = false;            // drag on the agitation of sheared grains, agitation_drag.hpp
  bool colour = true;                     // eq (25)

  // Where grains touch is a field of the state, which a bed at rest starts with.
  bool carries_packing() const;
  // Shear dilatancy moves what is carried.
  Packing packing_at_start() const;
  // Collisions shear by no more than the friction law has for what they bear.
  bool bounds_collisions() const;
  // A law asks for the fluid's viscosity between the grains.
  bool has_viscous_contacts() const;
  bool operator==(const Model&) const = default;
};

// P_s of the step: at the new solid fraction, or at the old one (which ties the step to the elastic waves).
enum class ContactPressure { implicit, explicit_ };
enum class InterfaceScheme { cicsam, plic, upwind };

// How a phase carries its momentum: by the speed of the face that takes it up, or with its mass
// (conservative).
enum class Convection { advective, mass_consistent };

// Contact in cells that the bed fills in part: none (the paper), or of the grains' own weight.
enum class BedSurface { whole_cells, part_cells };

struct Numerics {
  double cfl = 0.4;               // convective Courant number of the step, in (0, 0.9]
  double dt_max = 5e-3;           // [s]
  double dt_min = 1e-9;           // a refused step that would be shorter ends the run [s]
  SlopeLimiter transport_scheme;  // of f_s; of second order it makes both momenta so, by van Leer's
  Convection solid_convection = Convection::advective, fluid_convection = Convection::advective;
  BedSurface bed_surface = BedSurface::whole_cells;
  InterfaceScheme interface_scheme = InterfaceScheme::cicsam;
  ContactPressure contact_pressure = ContactPressure::implicit;
  double volume_tolerance = 1e-6;  // largest volume error of a cell in one step, as a fraction of the cell
  double linear_tolerance = 1e-3;  // residual reduction of one linear solve inside Newton
  int newton_max = 30;

  bool has_part_cells() const { return bed_surface == BedSurface::part_cells; }
  bool operator==(const Numerics&) const = default;
};

struct Grid3 {
  std::array<int, 3> cells{1, 1, 1};  // in 2D cells[2] = 1
  Vec3 spacing{};                     // tank / cells [m]; in 2D spacing[2] is the depth
  bool operator==(const Grid3&) const = default;
};

// --- the DEM-VOF reference -----------------------------------------------------------------------------

enum class ReferenceFloor { rough, smooth };  // frozen beads cover the floor; a plane with friction
enum class ReferenceRelease { gate, instant };
enum class ReferenceConvection { upwind, van_leer };  // of first order; of second, limited by van Leer

// How demvof computes the scene; the solver reads none of it.
struct ReferenceSettings {
  double cell = 0.0;       // edge of a fluid cell [m], > 0
  double fluid_dt = 1e-4;  // fluid step [s], > 0
  double dt = 1e-5;        // DEM step [s], > 0; of coarse-grained beads: times coarse_graining, as their
                           // Rayleigh time; at most fluid_dt
  double coarse_graining = 1.0;  // bead's over grain's diameter [-], in [1, 10]
  double slice_depth = 0.0;      // 2D scenes: depth of the periodic slice [m], > 0; 3D: the tank's depth
  std::vector<int> seeds{1, 2};  // one run each: the spread is the reference's own uncertainty
  ReferenceFloor floor = ReferenceFloor::rough;
  ReferenceRelease release = ReferenceRelease::gate;
  ReferenceConvection convection = ReferenceConvection::upwind;  // of the fluid's momentum
  double hold = 0.12;                  // under the final contact law behind the closed gate, before t = 0 [s]
  double young = 5e6;                  // [Pa]
  double poisson = 0.3;                // [-], in (-1, 0.5)
  double bead_friction = 0.0;          // bead on bead [-]; the case's default: solid.friction
  double bead_rolling_friction = 0.0;  // [-], during the run
  double bead_restitution = 0.0;       // [-]; the case's default: solid.restitution
  double wall_friction = 0.0;          // bead on wall [-]; the case's default: bead_friction
  double gate_friction = 0.0;          // bead on the gate's plate [-]; the case's default: wall_friction
  double packing = 0.0;               // solid fraction to prepare [-]; the case's default: bed.solid_fraction
  double preparation_friction = 1.0;  // bead on bead while the column settles: sets the packing [-]
  double preparation_rolling_friction = 0.2;  // [-]
  bool operator==(const ReferenceSettings&) const = default;
};

// --- times and output --------------------------------------------------------------------------------

struct Times {
  double end = 0.0;                 // [s]
  double unit = 1.0;                // seconds per unit of the case file's times: 1, or sqrt(h0 / g)
  double hold = 0.0;                // time behind the closed gate before t = 0 [s], >= 0
  std::vector<double> row_times;    // of series.csv [s], ascending, 0 and the end included
  std::vector<double> field_times;  // [s], ascending, the end included
  double checkpoint_interval =
      0.0;  // wall-clock seconds between checkpoints; 0: only at the end and on failure
  bool operator==(const Times&) const = default;
};

struct Scene {
  std::string name;  // unique, equals the file's stem
  std::string title;
  std::filesystem::path file;
  int dimensions = 2;        // 2 or 3
  Vec3 tank{};               // inner size [m]; in 2D tank[2] is the depth the results are stated for
  double gravity = 9.81;     // |g| [m/s2], >= 0
  double inclination = 0.0;  // of the floor, down towards +x [degrees], in (-90, 90)
  Grid3 grid;
  std::array<Side, 6> sides{};  // indexed by SideIndex
  Fluid gas;
  Fluid liquid;  // a case without [liquid] has the gas here, and no liquid_boxes
  Solid solid;
  Contact contact;
  std::optional<Bed> bed;
  std::vector<Box> liquid_boxes;  // where alpha = 1 at the start, pores of the bed included
  std::optional<Gate> gate;
  std::vector<Box> obstacles;  // closed to every phase; made of whole cells
  std::optional<ReferenceSettings> reference;
  Model model;
  Numerics numerics;
  Times times;
  std::string resolved;  // canonical text of the resolved case: what `granvof check` prints
  std::string hash;      // 16 hex digits: same hash, same geometry, physics, model and reference settings;
                         // grid, numerics, length of the run and output are left out
  std::string
      reference_hash;  // the same without [contact] and [model]: what the DEM-VOF reference depends on
  bool operator==(const Scene&) const = default;
};

}  // namespace granvof
