// The fluid side of demvof: gas and liquid between the beads, solved by OpenFOAM's finite volumes in memory.
//
// Equations (volume-averaged, pressure shared by both phases):
//   d(eps)/dt + div(eps u) = 0,   eps = 1 - f_s given by the beads
//   d(eps rho u)/dt + div(eps rho u u) = -eps grad p + div(eps (mu + mu_t)(grad u + grad u^T)) + eps rho g +
//   F d(eps alpha)/dt + div(alpha eps u) = 0   (MULES, with the flux of the first equation)
// F is the reaction to the drag on the beads, an explicit part plus an implicit part K (u_old - u_new).
//
// This header is free of OpenFOAM and of C++17, because OpenFOAM 1912 compiles as C++14 only.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace demvof {

using Vector = std::array<double, 3>;

// What closes a side of the tank for the fluid.
enum class FluidSide {
  no_slip,
  slip,
  open,  // top only: p = 0 outside, gas flows in
  empty  // front and back of a two-dimensional grid: no equation across
};

// How the fluid's momentum is carried: first order, or second order where it is smooth (van Leer, J. Comput.
// Phys. 14, 1974, limited in the direction of the steepest change).
enum class MomentumConvection { upwind, van_leer };

struct FluidSettings {
  std::array<int, 3> cells{{1, 1, 1}};  // nx, ny, nz; cell (i, j, k) has index (k ny + j) nx + i
  Vector spacing{};                     // [m]
  // 1 in the cells that obstacles fill, closed to the fluid, which sticks to them; empty where there are
  // none. What is handed in or out of such a cell says nothing: 0.
  std::vector<char> obstacles;
  double gravity = 9.81;                                 // [m/s2], >= 0
  double inclination = 0.0;                              // of the floor, down towards +x [degrees]
  double gas_density = 1.0, liquid_density = 1000.0;     // [kg/m3]
  double gas_viscosity = 1e-5, liquid_viscosity = 1e-3;  // [Pa s]
  bool large_eddy = true;                                // mu_t of eq (10)
  double smagorinsky = 0.18;                             // C_s [-]
  MomentumConvection convection = MomentumConvection::upwind;
  std::array<FluidSide, 6> sides{};  // left, right, bottom, top, front, back
  std::string scratch_folder;        // where OpenFOAM's dictionaries are written; removed at the end
};

// What the beads see of the fluid, one value a cell.
struct FluidView {
  std::vector<double> alpha;                             // liquid share [-]
  std::vector<double> pressure;                          // p [Pa], 0 at the open top
  std::array<std::vector<double>, 3> velocity;           // u [m/s]
  std::array<std::vector<double>, 3> pressure_gradient;  // grad p, hydrostatic part included [Pa/m]
};

// What the beads did to the fluid over the step, one value a cell.
struct BeadLoad {
  std::vector<double> void_fraction;         // eps at the end of the step, in (0, 1]
  std::vector<double> drag_coefficient;      // K [kg/(m3 s)]
  std::array<std::vector<double>, 3> force;  // explicit force density on the fluid [N/m3]
};

// What forces and scheme did to the kinetic energy of the fluid since the start [J]: gains of the fluid but
// for the last four, which it lost. In each step they are taken with the velocity that the step ends with,
// where momentum so discretised gives their sum exactly but for what the splitting of momentum and pressure
// leaves.
struct FluidWork {
  double drag = 0.0;      // by the beads, explicit and implicit part
  double pressure = 0.0;  // -eps grad p
  double gravity = 0.0;
  double viscosity = 0.0;           // dissipated, LES included
  double outflow = 0.0;             // carried through the top
  double numerical_time = 0.0;      // 1/2 m |u_new - u_old|^2 of the implicit step
  double numerical_momentum = 0.0;  // by the convection scheme
};

// The beads as the pressure prediction sees them, one value a cell.
struct BeadInertia {
  double density = 0.0;                  // rho_s [kg/m3]
  std::vector<double> drag_coefficient;  // K [kg/(m3 s)]
  std::array<std::vector<double>, 3>
      velocity;                              // mean bead velocity; the fluid's where there are no beads [m/s]
  std::array<std::vector<double>, 3> force;  // known force on the beads beside pressure, drag, weight [N/m3]
};

class Fluid {
 public:
  struct Fields;  // the OpenFOAM objects, fluid_fields.hpp

  // alpha and void_fraction: one value a cell at the start; the fluid is at rest.
  // Throws std::runtime_error with OpenFOAM's message when it refuses.
  Fluid(const FluidSettings& settings, const std::vector<double>& alpha,
        const std::vector<double>& void_fraction);
  ~Fluid();
  Fluid(const Fluid&) = delete;
  Fluid& operator=(const Fluid&) = delete;
  Fluid(Fluid&&) = delete;
  Fluid& operator=(Fluid&&) = delete;

  // A plate on the cell faces at x = face * spacing[0]: open[j] is the share of the face in row j through
  // which fluid passes, 0 closed to 1 open. An empty vector removes the plate.
  void set_gate(int face, const std::vector<double>& open);

  // Advance by dt [s]. Throws std::runtime_error when a value is no longer finite.
  void step(double dt, const BeadLoad& load);

  // Pressure gradient [Pa/m], one value a cell, under which fluid and beads together would keep the volume
  // over the next dt, were the beads free of contacts: their inertia is part of the pressure equation, so
  // that light beads do not overreact to a pressure that was made without them (added mass). Changes nothing
  // in the fluid.
  std::array<std::vector<double>, 3> predict_pressure_gradient(double dt, const BeadInertia& beads);

  const FluidView& view() const { return view_; }
  // Largest Courant number per second [1/s], near the liquid (alpha > 1e-3) and anywhere.
  double courant_rate_liquid() const { return courant_liquid_; }
  double courant_rate() const { return courant_; }
  double time() const;
  double liquid_volume() const;  // integral of eps alpha [m3]
  Vector momentum() const;       // integral of eps rho u [kg m/s]
  double largest_speed() const;  // [m/s]
  const FluidWork& work() const { return work_; }
  double kinetic_energy() const;    // with the mass whose momentum is that of momentum() [J]
  double potential_energy() const;  // of gas and liquid, zero at the bottom left corner [J]
  // Force of the walls, the gate and the open top on the fluid over the last step [N], pressure and friction.
  Vector boundary_force() const { return boundary_force_; }

 private:
  std::unique_ptr<Fields> fields_;
  FluidView view_;
  double courant_liquid_ = 0.0, courant_ = 0.0;
  Vector boundary_force_{};
  FluidWork work_;
  void refresh_view();
};

}  // namespace demvof
