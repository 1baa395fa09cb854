// The parts of the model, and of the program around it. A part owns keys of a case (keys.hpp), stages of the
// time step, terms of the energy ledger, monitors and alarms, equations and a page. Whoever declares one of
// these names its part there, once; what a part has is what names it, and a thing without a part fails a
// test.
// Equations: docs/theory/balances.md, docs/theory/contact.md.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace granvof {

struct Scene;

struct Part {
  const char* name;
  std::array<int, 6> equations{};        // of the paper, ascending, then zeros
  const char* page;                      // where it is described, from the root of the project
  const char* code;                      // its operator, or where its rules stand, likewise
  bool (*acts)(const Scene&) = nullptr;  // in a scene; nullptr: in every one
  bool of_grains = false;                // needs grains, whatever its keys say
};

// In the order in which they are listed.
std::span<const Part* const> all_parts();

// "(1), (25)", "(12)-(15)"; nothing for none. Equations ascending, zeros left out.
std::string text_of_equations(std::span<const int> equations);

// Those that are equations, or that not every scene has: which act in this one, and which do not.
struct PartsOfModel {
  std::vector<const Part*> act, rest;
};
PartsOfModel parts_of_model(const Scene& scene);

// A bed, or an inlet of grains; liquid at the start, through an inlet or behind an outlet.
bool has_grains(const Scene& scene);
bool has_liquid(const Scene& scene);
// Theta is made by mu_s^K alone.
bool has_agitation(const Scene& scene);

namespace parts {

// Balances.
extern const Part grains_transport, interface, pressure, momentum;
// Closures.
extern const Part drag, fluid_viscosity, solid_pressure, packing, friction, kinetic_stress,
    granular_temperature, viscous_contacts, bed_surface;
// What bounds the flow.
extern const Part walls, inlet, outlet, obstacles, gate;
// What the scene is made of, how it is computed, and what is said of it.
extern const Part label, materials, start, grid, time_step, ledger, output, reference;

}  // namespace parts

}  // namespace granvof
