#include "reference/demvof/beads/work_meter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

// Before LIGGGHTS' own headers, which take MPI from where they find it.
#include <mpi.h>

#include "liggghts/lammps.h"
// Needs LAMMPS_NS::LAMMPS.
#include "liggghts/atom.h"
#include "liggghts/fix_external.h"
#include "liggghts/library.h"
#include "liggghts/modify.h"

namespace demvof {

namespace {

constexpr int mobile_type = 1;  // see input_files.hpp
constexpr const char* names[] = {"probe_beads", "probe_walls", "probe_all"};

const LAMMPS_NS::Atom& atoms_of(void* lammps) {
  return *static_cast<LAMMPS_NS::LAMMPS*>(lammps)->atom;
}

// Mean velocity over a kick of `half_step` by `force`.
double kicked(double velocity, double force, double mass, double half_step) {
  return velocity + 0.5 * half_step * force / mass;
}

}  // namespace

BeadWork& BeadWork::operator+=(const BeadWork& other) {
  for (double BeadWork::*part : {&BeadWork::gravity, &BeadWork::drag, &BeadWork::force, &BeadWork::contacts,
                                 &BeadWork::walls, &BeadWork::surfaces, &BeadWork::gate_drive})
    this->*part += other.*part;
  return *this;
}

WorkMeter::WorkMeter(void* lammps, const BeadSettings& settings, const FluidLoad& load)
    : lammps_(lammps), load_(load), dt_(settings.dt) {
  const double d = settings.diameter;
  mass_ = settings.density * std::numbers::pi / 6.0 * d * d * d;
  inertia_ = 0.1 * mass_ * d * d;  // 2/5 m r^2
  plate_ = settings.gate.value_or(0.0);
  // Obstacles are a cell away from it, which is at least as wide as a bead: no bead touches both.
  reach_of_plate_ = settings.obstacles.closed.empty() ? std::numeric_limits<double>::infinity() : 0.5 * d;
}

void WorkMeter::look(Place place) {
  const auto n = static_cast<std::size_t>(place);
  const std::string name = names[n];
  // It adds nothing: its own force is applied at step 0 alone, and is zero then.
  const std::string command = "fix " + name + " mobile external pf/callback 1 1000000000";
  lammps_command(lammps_, command.c_str());
  LAMMPS_NS::Modify& modify = *static_cast<LAMMPS_NS::LAMMPS*>(lammps_)->modify;
  auto* fix = dynamic_cast<LAMMPS_NS::FixExternal*>(modify.fix[modify.find_fix(name.c_str())]);
  if (fix == nullptr) throw std::runtime_error("LIGGGHTS has no fix external");
  probes_[n] = {this, place};
  fix->set_callback(&WorkMeter::called, &probes_[n]);
}

void WorkMeter::look_last_again() {
  const std::string command = std::string("unfix ") + names[static_cast<std::size_t>(Place::after_all)];
  lammps_command(lammps_, command.c_str());
  look(Place::after_all);
}

void WorkMeter::called(void* probe, std::int64_t step, int atoms, int*, double**, double** unused) {
  auto& [meter, place] = *static_cast<Probe*>(probe);
  if (step == 0 && atoms > 0) std::fill_n(unused[0], 3 * atoms, 0.0);
  switch (place) {
    case Place::after_beads:
      meter->keep(meter->beads_);
      break;
    case Place::after_walls:
      meter->keep(meter->walls_);
      break;
    case Place::after_all:
      meter->count(step);
      break;
  }
}

void WorkMeter::keep(Forces& forces) const {
  const LAMMPS_NS::Atom& atoms = atoms_of(lammps_);
  const auto numbers = static_cast<std::size_t>(3 * atoms.nlocal);
  if (numbers == 0) return;
  forces.force.assign(atoms.f[0], atoms.f[0] + numbers);
  forces.torque.assign(atoms.torque[0], atoms.torque[0] + numbers);
}

void WorkMeter::count(std::int64_t step) {
  // A run that sets itself up looks at the forces of a step once more, under the new load, with all of that
  // step's speed: only the kick to come is another.
  const bool whole_step = step != last_step_;
  last_step_ = step;
  if (whole_step) work_ += second_kick_;
  second_kick_ = {};
  const LAMMPS_NS::Atom& atoms = atoms_of(lammps_);
  for (int atom = 0; atom < atoms.nlocal; ++atom) {
    if (atoms.type[atom] == mobile_type) count_bead(atom, whole_step, work_);
  }
}

void WorkMeter::count_bead(int atom, bool whole_step, BeadWork& first) {
  const LAMMPS_NS::Atom& atoms = atoms_of(lammps_);
  const auto bead = static_cast<std::size_t>(atoms.tag[atom] - 1);
  const bool loaded = bead < load_.coefficient.size();
  const double coefficient = loaded ? load_.coefficient[bead] : 0.0, half = 0.5 * dt_;
  double plate = 0.0;  // its force upwards
  // The kick that ends a step, at the rate `rate` or after the one that begins it.
  const auto kick_twice = [&](const auto& add, double rate, double load, double inertia) {
    if (whole_step) {
      add(first, kicked(rate, load, inertia, half));
      rate += half * load / inertia;
    }
    add(second_kick_, kicked(rate, load, inertia, half));
  };
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(3 * atom + d), m = 3 * bead + static_cast<std::size_t>(d);
    const double total = atoms.f[atom][d], v = atoms.v[atom][d];
    const double gravity = mass_ * gravity_[static_cast<std::size_t>(d)];
    const double drag = loaded ? coefficient * (load_.velocity[m] - v) : 0.0;
    const double force = loaded ? load_.force[m] : 0.0;
    const double contacts = beads_.force[n], walls = walls_.force[n] - contacts;
    const double surfaces = total - walls_.force[n] - gravity - drag - force;
    const auto add = [&](BeadWork& work, double velocity) {
      const double path = half * velocity;
      work.gravity += gravity * path;
      work.drag += drag * path;
      work.force += force * path;
      work.contacts += contacts * path;
      work.walls += walls * path;
      work.surfaces += surfaces * path;
    };
    kick_twice(add, v, total, mass_);

    const double torque = atoms.torque[atom][d], spin = atoms.omega[atom][d];
    const double by_beads = beads_.torque[n], by_walls = walls_.torque[n] - by_beads,
                 by_surfaces = torque - walls_.torque[n];
    const auto add_spin = [&](BeadWork& work, double rate) {
      const double angle = half * rate;
      work.contacts += by_beads * angle;
      work.walls += by_walls * angle;
      work.surfaces += by_surfaces * angle;
    };
    kick_twice(add_spin, spin, torque, inertia_);
    if (d == 1 && std::abs(atoms.x[atom][0] - plate_) < reach_of_plate_) plate = surfaces;
  }
  if (whole_step) first.gate_drive += plate * gate_speed_ * dt_;
}

double WorkMeter::spin_energy() const {
  const LAMMPS_NS::Atom& atoms = atoms_of(lammps_);
  double sum = 0.0;
  for (int atom = 0; atom < atoms.nlocal; ++atom) {
    if (atoms.type[atom] != mobile_type) continue;
    for (int d = 0; d < 3; ++d) sum += atoms.omega[atom][d] * atoms.omega[atom][d];
  }
  return 0.5 * inertia_ * sum;
}

}  // namespace demvof
