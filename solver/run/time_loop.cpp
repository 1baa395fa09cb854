#include "solver/run/time_loop.hpp"

#include <algorithm>
#include <utility>

#include <spdlog/spdlog.h>

namespace granvof {

TimeLoop::TimeLoop(const Scene& scene, const Communicator* communicator)
    : scene_(scene),
      grid_(scene, communicator),
      boundary_(grid_),
      step_(grid_, scene, boundary_),
      control_(grid_, scene),
      now_(initial_state(grid_, scene, boundary_)),
      next_(grid_),
      monitors_(grid_, scene, now_) {}

void TimeLoop::restore(const Checkpoint& saved) {
  granvof::restore(saved, grid_, now_, control_, monitors_, counters_);
  now_.fill_ghosts(boundary_);
}

TimeLoop::Ending TimeLoop::run(std::span<const Observer> observers) {
  for (;;) {
    if (auto stuck = advance()) return {*std::move(stuck)};
    for (const Observer& observer : observers)
      if (auto ending = observer()) return *std::move(ending);
  }
}

std::optional<RunExit> TimeLoop::advance(double longest, const BodyAcceleration* extra) {
  before_ = {counters_, monitors_.values(), control_.last()};
  double dt = std::min(control_.next(now_), longest);
  for (;;) {
    last_ = step_.advance(now_, dt, next_, extra);
    if (last_.accepted) {
      const std::string field = monitors_.not_finite(next_);
      if (field.empty()) break;
      last_.refused_because = "the " + field + " is not finite";
      last_.not_finite = true;
    }
    ++counters_.refused_steps;
    spdlog::debug("t = {:.6g} s: step of {:.3g} s refused: {}", now_.time, dt, last_.refused_because);
    dt = control_.after_refusal(dt);
    if (dt < scene_.numerics.dt_min)
      return RunExit{ExitState::failed,
                     fmt::format("step collapse at t = {:.6g} s: {}", now_.time, last_.refused_because),
                     last_.not_finite ? ExitKind::not_finite : ExitKind::step_collapse};
  }
  std::swap(now_, next_);
  control_.accepted(dt);
  monitors_.update(now_, last_.liquid_left, last_.solid_left);
  counters_.newton += last_.pressure.newton;
  counters_.linear += last_.pressure.linear;
  counters_.friction += last_.friction.iterations;
  counters_.unconverged_friction += last_.friction.converged ? 0 : 1;
  ++counters_.steps;
  return std::nullopt;
}

void TimeLoop::step_back() {
  std::swap(now_, next_);
  counters_ = before_.counters;
  monitors_.restore(before_.monitors);
  control_.restore(before_.dt);
}

CheckpointView TimeLoop::checkpoint(const RunProgress& progress) const {
  return checkpoint_view(grid_, now_, control_, monitors_, counters_, progress);
}

}  // namespace granvof
