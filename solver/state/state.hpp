// Everything that is carried from one time step to the next.
#pragma once

#include <array>
#include <string>

#include "solver/grid/boundary.hpp"
#include "solver/state/energy_terms.hpp"

namespace granvof {

struct State {
  double time = 0.0;   // [s]; negative while the column is held before its release
  Field f_s;           // solid fraction [-]
  Field alpha;         // liquid share of the continuous phase [-]
  Field p_c, p_s;      // fluid and solid pressure [Pa]
  Field theta;         // granular temperature [m2/s2]
  Field phi;           // colour of the solid [-]
  Field packing;       // solid fraction at which the grains touch: f_s,min but with shear dilatancy [-]
  FaceField u_s, u_c;  // velocities on faces [m/s]
  FaceField u_strain;  // u_s after the friction step: the velocity whose strain sets the next friction [m/s]
  EnergyTerms energy;  // stored now, and where it went since the start [J]

  explicit State(const Grid& grid);
  void fill_ghosts(const Boundary& boundary);
};

// The one list of what a state holds: who makes, fills, saves or watches its fields goes through it.
struct CellQuantity {
  const char* key;   // in a checkpoint
  const char* name;  // in messages
  Field State::*field;
  void (*fill)(const Boundary& boundary, Field& field);  // its ghosts
};
struct FaceQuantity {
  const char* key;  // and the index of the component
  const char* name;
  FaceField State::*field;
  Phase phase;
};

inline constexpr auto fill_as_scalar = [](const Boundary& boundary, Field& f) { boundary.fill_scalar(f); };
inline constexpr std::array cell_quantities{
    CellQuantity{"f_s", "solid fraction", &State::f_s,
                 [](const Boundary& boundary, Field& f) { boundary.fill_solid_fraction(f); }},
    CellQuantity{"alpha", "liquid share", &State::alpha,
                 [](const Boundary& boundary, Field& f) { boundary.fill_liquid_share(f); }},
    CellQuantity{"p_c", "fluid pressure", &State::p_c,
                 [](const Boundary& boundary, Field& f) { boundary.fill_pressure(f); }},
    CellQuantity{"p_s", "solid pressure", &State::p_s, fill_as_scalar},
    CellQuantity{"theta", "granular temperature", &State::theta, fill_as_scalar},
    CellQuantity{"phi", "colour", &State::phi, fill_as_scalar},
    CellQuantity{"packing", "packing", &State::packing, fill_as_scalar},
};
inline constexpr std::array face_quantities{
    FaceQuantity{"u_s", "solid velocity", &State::u_s, Phase::solid},
    FaceQuantity{"u_c", "velocity of the continuous phase", &State::u_c, Phase::fluid},
    FaceQuantity{"u_strain", "solid velocity after friction", &State::u_strain, Phase::solid},
};

// One of the fields of every state.
struct FieldOfState {
  const CellQuantity* of_cells = nullptr;  // or
  const FaceQuantity* of_faces = nullptr;
  int d = 0;  // and which component

  std::string key() const { return of_cells ? of_cells->key : of_faces->key + std::to_string(d); }
  template <typename StateType>
  auto& operator()(StateType& s) const {
    return of_cells ? s.*of_cells->field : (s.*of_faces->field)[d];
  }
};

// visit(FieldOfState, its field) for every field of a state.
template <typename StateType, typename Visit>
void for_each_field(const Grid& grid, StateType& s, Visit&& visit) {
  for (const CellQuantity& q : cell_quantities) visit(FieldOfState{&q, nullptr, 0}, s.*q.field);
  for (const FaceQuantity& q : face_quantities)
    for (int d = 0; d < grid.dim; ++d) visit(FieldOfState{nullptr, &q, d}, (s.*q.field)[d]);
}

}  // namespace granvof
