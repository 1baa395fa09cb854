#include "reference/demvof/beads/bead_engine.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mpi.h>
#include <unistd.h>

#include "liggghts/library.h"
#include "liggghts/library_cfd_coupling.h"
#include "reference/demvof/beads/bead_log.hpp"
#include "reference/demvof/beads/input_files.hpp"
#include "reference/demvof/beads/messages_into.hpp"

namespace demvof {

namespace {

constexpr const char* contact = "gran model hertz tangential history";

// A value a type, see input_files.hpp.
using ByType = std::array<double, bead_types>;

std::string text(const ByType& values) {
  return fmt::format("{}", fmt::join(values, " "));
}

ByType same(double value) {
  ByType values{};
  values.fill(value);
  return values;
}

}  // namespace

void FluidLoad::resize(std::size_t beads) {
  coefficient.assign(beads, 0.0);
  velocity.assign(3 * beads, 0.0);
  force.assign(3 * beads, 0.0);
}

BeadEngine::BeadEngine(BeadSettings settings, const BeadState& mobile,
                       const std::vector<double>& frozen_positions)
    : settings_(std::move(settings)),
      mobile_(mobile.count()),
      frozen_(frozen_positions.size() / 3),
      state_(mobile),
      frozen_position_(frozen_positions) {
  std::filesystem::create_directories(settings_.scratch_folder);
  state_.velocity.resize(3 * mobile_, 0.0);

  // A screen of "none" makes LIGGGHTS crash. Where it ends the program, the log says why.
  const std::string log = bead_log(settings_.scratch_folder, ::getpid());
  std::vector<std::string> words{"liggghts", "-screen", "/dev/null", "-log", log};
  std::vector<char*> arguments;
  arguments.reserve(words.size());
  for (std::string& word : words) arguments.push_back(word.data());
  {
    const MessagesInto hidden(log);  // a second engine finds every style of the first: hundreds of lines
    lammps_open(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD, &lammps_);
  }

  command("atom_style granular");
  command("atom_modify map array");
  command(fmt::format("boundary {} f {}", settings_.periodic_length ? "p" : "f",
                      settings_.periodic_depth ? "p" : "f"));
  command("newton off");
  command("communicate single vel yes");
  command("units si");

  const std::string file =
      fmt::format("{}/beads-{}-{}.data", settings_.scratch_folder, ::getpid(), static_cast<void*>(this));
  write_beads(file, settings_, mobile, frozen_positions);
  command(fmt::format("read_data \"{}\"", file));
  std::filesystem::remove(file);

  command(fmt::format("neighbor {} bin", 0.3 * settings_.diameter));
  command("neigh_modify delay 0");
  command("group mobile type 1");
  if (frozen_ > 0) {
    command("group frozen type 2");
    command("neigh_modify exclude group frozen frozen");
  }
  rolling_ = settings_.law.rolling_friction > 0.0;
  declare_materials();
  const std::string rolling = rolling_ ? " rolling_friction epsd2" : "";
  {
    const MessagesInto hidden(log);
    command(fmt::format("pair_style {}{}", contact, rolling));
  }
  command("pair_coeff * *");
  meter_ = std::make_unique<WorkMeter>(lammps_, settings_, load_);
  meter_->look(WorkMeter::Place::after_beads);
  declare_walls();
  meter_->look(WorkMeter::Place::after_walls);
  if (!settings_.obstacles.closed.empty()) declare_mesh("obstacles", write_obstacles, 5);
  if (settings_.gate) declare_mesh("gate", write_gate, 4);
  gate_present_ = settings_.gate.has_value();
  declare_surfaces();

  command(fmt::format("timestep {}", settings_.dt));
  set_gravity(settings_.gravity, settings_.inclination);
  command("fix coupling all couple/cfd couple_every 1000000 mpi");
  command("fix fluid mobile couple/cfd/force/implicit");
  meter_->look(WorkMeter::Place::after_all);
  command("fix motion mobile nve/sphere");
  command("thermo_style custom step atoms");
  command("thermo 1000000000");
  command("thermo_modify lost ignore norm no");
  command("run 0");  // registers the coupling's properties

  allocate_external_double(load_scalar_, 1, static_cast<int>(mobile_ + frozen_), 0.0, lammps_);
  allocate_external_double(load_vector_, 3, static_cast<int>(mobile_ + frozen_), 0.0, lammps_);
  set_velocities(state_.velocity);
  refresh_state();
}

BeadEngine::~BeadEngine() {
  if (lammps_ == nullptr) return;
  lammps_close(lammps_);
  std::error_code ignored;
  std::filesystem::remove(bead_log(settings_.scratch_folder, ::getpid()), ignored);
}

void BeadEngine::command(const std::string& line) {
  std::string text = line;
  lammps_command(lammps_, text.data());
}

void BeadEngine::declare_materials() {
  const ContactLaw& law = settings_.law;
  const auto each = [&](const char* name, const char* property, double value) {
    command(fmt::format("fix {} all property/global {} peratomtype {}", name, property, text(same(value))));
  };
  const auto pairs = [&](const char* name, const char* property, const std::array<ByType, bead_types>& rows) {
    std::vector<std::string> lines;
    for (const ByType& row : rows) lines.push_back(text(row));
    command(fmt::format("fix {} all property/global {} peratomtypepair {} {}", name, property, bead_types,
                        fmt::join(lines, " ")));
  };
  const auto uniform = [&](double value) {
    std::array<ByType, bead_types> rows;
    rows.fill(same(value));
    return rows;
  };
  each("young", "youngsModulus", law.young);
  each("poisson", "poissonsRatio", law.poisson);
  pairs("restitution", "coefficientRestitution", uniform(law.restitution));
  const double bead = law.bead_friction, wall = law.wall_friction, gate = law.gate_friction,
               obstacle = law.obstacle_friction;
  const ByType of_beads{bead, bead, wall, gate, obstacle};
  pairs("friction", "coefficientFriction",
        {of_beads,
         of_beads,
         same(wall),
         {gate, gate, wall, gate, wall},
         {obstacle, obstacle, wall, wall, obstacle}});
  if (rolling_) pairs("rolling", "coefficientRollingFriction", uniform(law.rolling_friction));
}

void BeadEngine::declare_walls() {
  const auto plane = [&](const char* name, const char* kind, double position) {
    command(fmt::format("fix {} mobile wall/{} primitive type 3 {} {}", name, contact, kind, position));
  };
  if (!settings_.periodic_length) {
    plane("left", "xplane", 0.0);
    plane("right", "xplane", settings_.tank[0]);
  }
  plane("bottom", "yplane", 0.0);
  plane("top", "yplane", settings_.tank[1]);
  if (!settings_.periodic_depth) {
    plane("front", "zplane", 0.0);
    plane("back", "zplane", settings_.tank[2]);
  }
}

void BeadEngine::declare_mesh(const char* name, MeshWriter& write, int type) {
  const std::string file = fmt::format("{}/{}-{}-{}.stl", settings_.scratch_folder, name, ::getpid(),
                                       static_cast<const void*>(this));
  write(file, settings_);
  command(fmt::format("fix {} all mesh/surface file \"{}\" type {}", name, file, type));
  std::filesystem::remove(file);
}

// LIGGGHTS has one wall of meshes, whatever their number.
bool BeadEngine::declare_surfaces() {
  std::vector<const char*> meshes;
  if (!settings_.obstacles.closed.empty()) meshes.push_back("obstacles");
  if (gate_present_) meshes.push_back("gate");
  if (meshes.empty()) return false;
  command(fmt::format("fix surfaces mobile wall/{} mesh n_meshes {} meshes {}", contact, meshes.size(),
                      fmt::join(meshes, " ")));
  return true;
}

void BeadEngine::set_gravity(double gravity, double slope) {
  settings_.gravity = gravity;
  const double sign = gravity < 0.0 ? -1.0 : 1.0, angle = slope * std::numbers::pi / 180.0;
  command(fmt::format("fix gravity mobile gravity {} vector {:.17g} {:.17g} 0", std::abs(gravity),
                      sign * std::sin(angle), -sign * std::cos(angle)));
  gravity_ = {gravity * std::sin(angle), -gravity * std::cos(angle), 0.0};
  meter_->set_gravity(gravity_);
  set_up_ = false;
}

void BeadEngine::set_contact_law(const ContactLaw& law) {
  settings_.law = law;
  declare_materials();
  set_up_ = false;
}

void BeadEngine::set_velocities(const std::vector<double>& velocity) {
  gathered_.assign(3 * (mobile_ + frozen_), 0.0);
  std::copy(velocity.begin(), velocity.end(), gathered_.begin());
  std::string name = "v";
  lammps_scatter_atoms(lammps_, name.data(), 1, 3, gathered_.data());
}

void BeadEngine::raise_gate(double speed) {
  if (!gate_present_) return;
  command(fmt::format("fix gatemotion all move/mesh mesh gate linear 0. {} 0.", speed));
  gate_moving_ = true;
  gate_speed_ = speed;
  raised_since_ = time();
  meter_->set_gate_speed(speed);
  set_up_ = false;
}

void BeadEngine::remove_gate() {
  if (!gate_present_) return;
  command("unfix surfaces");
  if (gate_moving_) command("unfix gatemotion");
  command("unfix gate");
  gate_present_ = false;
  if (declare_surfaces()) meter_->look_last_again();
  meter_->set_gate_speed(0.0);
  set_up_ = false;
}

void BeadEngine::set_load(const FluidLoad& load) {
  load_ = load;
  const std::size_t n = mobile_;
  const auto send = [&](const char* name, const char* type, double** data) {
    void* address = data;
    data_of_to_liggghts(name, type, lammps_, address, "double");
  };
  for (std::size_t i = 0; i < n; ++i) load_scalar_[i][0] = load.coefficient[i];
  send("Ksl", "scalar-atom", load_scalar_);
  std::copy(load.velocity.begin(), load.velocity.begin() + 3 * n, &load_vector_[0][0]);
  send("uf", "vector-atom", load_vector_);
  std::copy(load.force.begin(), load.force.begin() + 3 * n, &load_vector_[0][0]);
  send("dragforce", "vector-atom", load_vector_);
}

void BeadEngine::run(int steps) {
  command(fmt::format("run {} {} post no", steps, set_up_ ? "pre no" : "pre yes"));
  set_up_ = true;
  steps_done_ += steps;
  refresh_state();
}

void BeadEngine::refresh_state() {
  if (static_cast<std::size_t>(lammps_get_natoms(lammps_)) != mobile_ + frozen_) {
    throw std::runtime_error(
        fmt::format("{} beads have left the tank",
                    mobile_ + frozen_ - static_cast<std::size_t>(lammps_get_natoms(lammps_))));
  }
  gathered_.resize(3 * (mobile_ + frozen_));
  std::string x = "x", v = "v";
  lammps_gather_atoms(lammps_, x.data(), 1, 3, gathered_.data());
  std::copy(gathered_.begin(), gathered_.begin() + 3 * mobile_, state_.position.begin());
  lammps_gather_atoms(lammps_, v.data(), 1, 3, gathered_.data());
  std::copy(gathered_.begin(), gathered_.begin() + 3 * mobile_, state_.velocity.begin());
}

double BeadEngine::translation_energy() const {
  double sum = 0.0;
  for (const double v : state_.velocity) sum += v * v;
  return 0.5 * bead_mass() * sum;
}

double BeadEngine::potential_energy() const {
  double sum = 0.0;
  for (std::size_t n = 0; n < state_.position.size(); ++n) sum -= gravity_[n % 3] * state_.position[n];
  return bead_mass() * sum;
}

ElasticEnergy BeadEngine::elastic_energy() const {
  std::optional<double> edge;
  if (gate_present_) edge = gate_moving_ ? gate_speed_ * (time() - raised_since_) : 0.0;
  return demvof::elastic_energy(settings_, state_.position, frozen_position_, edge);
}

double BeadEngine::bead_volume() const {
  const double d = settings_.diameter;
  return std::numbers::pi / 6.0 * d * d * d;
}

double BeadEngine::bead_mass() const {
  return settings_.density * bead_volume();
}

}  // namespace demvof
