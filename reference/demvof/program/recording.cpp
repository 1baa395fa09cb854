#include "reference/demvof/program/recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/demvof/program/scene_setup.hpp"
#include "reference/demvof/program/snapshot.hpp"
#include "solver/output/extract.hpp"

namespace demvof {

namespace {

using granvof::CellFields;
using granvof::Scene;

// Value of a mean that is weighted by how much of its carrier there is; where there is none, plainly linear.
double carried(double share, double carrier, double value, double later_carrier, double later_value) {
  const double sum = std::lerp(carrier, later_carrier, share);
  const double weight = sum > 0.0 ? share * later_carrier / sum : share;
  return std::lerp(value, later_value, weight);
}

CellFields fields_between(const CellFields& a, const CellFields& b, double share, double time) {
  CellFields at = b;
  at.time = time;
  for (std::size_t c = 0; c < at.f_s.size(); ++c) {
    const double solid = a.f_s[c], later_solid = b.f_s[c];
    at.f_s[c] = std::lerp(solid, later_solid, share);
    at.alpha[c] = carried(share, 1.0 - solid, a.alpha[c], 1.0 - later_solid, b.alpha[c]);
    at.p_c[c] = std::lerp(a.p_c[c], b.p_c[c], share);
    at.theta[c] = carried(share, solid, a.theta[c], later_solid, b.theta[c]);
    at.phi[c] = carried(share, solid, a.phi[c], later_solid, b.phi[c]);
    for (std::size_t d = 0; d < 3; ++d) {
      if (b.u_s[d].empty()) continue;
      at.u_s[d][c] = carried(share, solid, a.u_s[d][c], later_solid, b.u_s[d][c]);
      at.u_c[d][c] = std::lerp(a.u_c[d][c], b.u_c[d][c], share);
    }
  }
  return at;
}

}  // namespace

std::vector<granvof::Column> monitor_columns() {
  std::vector<granvof::Column> columns{
      {"fluid_step", "s", "length of the last fluid step"},
      {"bead_front", "m", "x left of which 99.5 % of the beads have their centres"},
      {"bead_speed_rms", "m/s", "rms speed of the beads"},
      {"floor_slip", "-",
       "mean u_x of the lowest layer of beads over that of the next, beyond the initial bed"},
      {"excess_base_pressure", "Pa", "floor pressure under the initial bed beyond the liquid's own weight"},
      {"fluid_speed_max", "m/s", "largest speed of the continuous phase"},
      {"liquid_volume_change", "-", "relative change of the liquid volume since the start"}};
  for (const EnergyTerm& term : energy_terms) columns.push_back({term.name, "J", term.meaning});
  return columns;
}

Instant between(const Instant& earlier, const Instant& later, double time) {
  const double from = earlier.fields.time, to = later.fields.time;
  const double share = time == to ? 1.0 : (time - from) / (to - from);
  Instant at{later.monitors, fields_between(earlier.fields, later.fields, share, time)};
  for (std::size_t m = 1; m < at.monitors.size(); ++m) {  // the first is the length of the step
    const granvof::Value a = earlier.monitors[m], b = later.monitors[m];
    at.monitors[m] = a && b ? granvof::Value(std::lerp(*a, *b, share)) : std::nullopt;
  }
  return at;
}

int gate_face(const Scene& scene) {
  return static_cast<int>(std::lround(scene.gate->position / scene.grid.spacing[0]));
}

GateKeeper::GateKeeper(CoupledRun& run, const Scene& scene, bool stays)
    : run_(run), scene_(scene), present_(scene.gate.has_value()), stays_(stays) {
  if (!present_) return;
  face_ = gate_face(scene);
  run_.set_gate_edge(face_, 0.0);
}

void GateKeeper::release() {
  if (!present_ || stays_) return;
  if (scene_.reference->release == granvof::ReferenceRelease::instant) {
    run_.beads().remove_gate();
    run_.remove_gate();
    present_ = false;
  } else {
    run_.beads().raise_gate(scene_.gate->speed);
    bead_plate_ = true;
  }
}

void GateKeeper::follow(double time) {
  if (!present_ || stays_) return;
  const double edge = scene_.gate->speed * time;
  if (bead_plate_ && edge > scene_.bed->box.upper[1] + 4.0 * bead_diameter(scene_)) {
    run_.beads().remove_gate();
    bead_plate_ = false;
  }
  if (edge > scene_.tank[1]) {
    run_.remove_gate();
    present_ = false;
    return;
  }
  run_.set_gate_edge(face_, edge);
}

Recording::Recording(CoupledRun& run, const Scene& scene, granvof::RunWriter& writer,
                     granvof::RunProgress& progress, double hold)
    : run_(run),
      scene_(scene),
      writer_(writer),
      progress_(progress),
      hold_(hold),
      ledger_(run),
      due_(granvof::due_output(scene.times, -1.0, scene.times.end)),
      liquid_start_(run.fluid().liquid_volume()) {}

void Recording::count(double step) {
  last_step_ = step;
  ++progress_.steps;
  for (const double f : run_.solid_fraction())
    progress_.solid_fraction_max = std::max(progress_.solid_fraction_max, f);
  if (liquid_start_ > 0.0) {
    const double change = std::abs(run_.fluid().liquid_volume() / liquid_start_ - 1.0);
    progress_.liquid_volume_error = std::max(progress_.liquid_volume_error, change);
  }
}

Instant Recording::observe() const {
  const BeadState& beads = run_.beads().state();
  // A scene without liquid has none to lose.
  const double change = liquid_start_ > 0.0 ? run_.fluid().liquid_volume() / liquid_start_ - 1.0 : 0.0;
  std::vector<granvof::Value> monitors{last_step_,
                                       bead_front(beads),
                                       bead_rms_speed(beads),
                                       floor_slip(beads, bead_diameter(scene_), scene_.bed->box.upper[0]),
                                       excess_base_pressure(run_, scene_),
                                       run_.fluid().largest_speed(),
                                       change};
  // A slice stands for the tank's depth, as in every other column.
  const double slices = scene_.tank[2] / depth_of(scene_);
  const EnergyTerms energy = ledger_.terms();
  for (const EnergyTerm& term : energy_terms) monitors.emplace_back(slices * energy.*term.value);
  return {std::move(monitors), snapshot(run_, scene_, now())};
}

bool Recording::write(const Instant& instant, const granvof::DueOutput& due) {
  if (due.row)
    writer_.write_series_row(due.time, instant.monitors, granvof::extract_scalars(instant.fields, scene_));
  if (due.fields) writer_.write_fields(instant.fields);
  return due.row;
}

void Recording::begin() {
  ledger_.begin();
  Instant instant = observe();
  for (; next_ < due_.size() && due_[next_].time <= 0.0; ++next_) {
    instant.fields.time = due_[next_].time;  // the release, but for rounding
    write(instant, due_[next_]);
  }
}

bool Recording::advance() {
  // The state before the step is kept where the step can reach what is due.
  const double farthest = now() + run_.longest_step();
  const bool may_pass = next_ < due_.size() && due_[next_].time <= farthest;
  const Instant earlier = may_pass ? observe() : Instant{};
  count(run_.step());
  if (!may_pass || due_[next_].time > now()) return false;
  const Instant later = observe();
  bool row = false;
  for (; next_ < due_.size() && due_[next_].time <= now(); ++next_)
    row |= write(between(earlier, later, due_[next_].time), due_[next_]);
  return row;
}

}  // namespace demvof
