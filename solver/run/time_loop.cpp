#include "solver/run/time_loop.hpp"

#include <algorithm>
#include <ctime>
#include <stdexcept>
#include <utility>

#include <spdlog/spdlog.h>

#include "solver/output/stop_signals.hpp"
#include "solver/run/initial_state.hpp"

namespace granvof {
namespace {

// The part of a process in the start of the whole tank, which every one makes.
State start_of(const Grid& grid, const Scene& scene, const Boundary& boundary, const WholeTank& tank) {
  if (!tank.is_cut()) return initial_state(grid, scene, boundary);
  State part(grid);
  tank.take(initial_state(tank.grid(), scene, Boundary(tank.grid())), part);
  return part;
}

}  // namespace

TimeLoop::TimeLoop(const Scene& scene, const Communicator* communicator)
    : scene_(scene),
      grid_(scene, communicator),
      boundary_(grid_),
      tank_(scene, grid_),
      step_(grid_, scene, boundary_),
      control_(grid_, scene, step_.solid_law()),
      now_(start_of(grid_, scene, boundary_, tank_)),
      next_(grid_),
      monitors_(grid_, scene, now_) {}

void TimeLoop::restore(const Checkpoint& saved) {
  if (!tank_.is_cut()) {
    granvof::restore(saved, grid_, now_, control_, monitors_, counters_);
  } else {
    whole_now_.emplace(tank_.grid());
    granvof::restore(saved, tank_.grid(), *whole_now_, control_, monitors_, counters_);
    tell({Order::Kind::restore});
    restore_from_the_lowest();
  }
  now_.fill_ghosts(boundary_);
}

void TimeLoop::restore_from_the_lowest() {
  tank_.deal(whole_now_, now_);
  Marks marks{counters_, monitors_.values(), control_.last()};
  grid_.cells.communicator->broadcast(std::as_writable_bytes(std::span(&marks, 1)));
  counters_ = marks.counters;
  monitors_.restore(marks.monitors);
  control_.restore(marks.dt);
}

void TimeLoop::tell(Order order) const {
  if (leads()) grid_.cells.communicator->broadcast(std::as_writable_bytes(std::span(&order, 1)));
}

int TimeLoop::follow() {
  for (;;) {
    Order order{};
    grid_.cells.communicator->broadcast(std::as_writable_bytes(std::span(&order, 1)));
    switch (order.kind) {
      case Order::Kind::advance:
        take_step(order.longest, nullptr);
        break;
      case Order::Kind::step_back:
        forget_step();
        break;
      case Order::Kind::restore:
        restore_from_the_lowest();
        now_.fill_ghosts(boundary_);
        whole_now_.reset();
        break;
      case Order::Kind::collect_now:
        tank_.collect(now_, whole_now_);
        break;
      case Order::Kind::collect_before:
        tank_.collect(next_, whole_before_);
        break;
      case Order::Kind::account:
        sum_of_core_seconds();
        break;
      case Order::Kind::agree:
        highest_stop_signal();
        break;
      case Order::Kind::end:
        return order.code;
    }
  }
}

void TimeLoop::dismiss(int code) const {
  tell({Order::Kind::end, 0.0, code});
}

double TimeLoop::core_seconds_of_others() const {
  if (!tank_.is_cut()) return 0.0;
  tell({Order::Kind::account});
  return sum_of_core_seconds();
}

// Of all processes but the lowest.
double TimeLoop::sum_of_core_seconds() const {
  const bool lowest = grid_.cells.communicator->rank() == 0;
  return of_all(grid_.cells, lowest ? 0.0 : static_cast<double>(std::clock() - begun_) / CLOCKS_PER_SEC);
}

int TimeLoop::stop_signal_of_any() const {
  if (!tank_.is_cut()) return stop_signal();
  tell({Order::Kind::agree});
  return highest_stop_signal();
}

int TimeLoop::highest_stop_signal() const {
  double number = stop_signal();
  grid_.cells.communicator->max(std::span(&number, 1));
  return static_cast<int>(number);
}

const State& TimeLoop::whole_now() {
  if (!tank_.is_cut()) return now_;
  tell({Order::Kind::collect_now});
  tank_.collect(now_, whole_now_);
  return *whole_now_;
}

const State& TimeLoop::whole_before() {
  if (!tank_.is_cut()) return next_;
  tell({Order::Kind::collect_before});
  tank_.collect(next_, whole_before_);
  return *whole_before_;
}

TimeLoop::Ending TimeLoop::run(std::span<const Observer> observers) {
  for (;;) {
    if (auto stuck = advance()) return {*std::move(stuck)};
    for (const Observer& observer : observers)
      if (auto ending = observer()) return *std::move(ending);
  }
}

std::optional<RunExit> TimeLoop::advance(double longest, const BodyAcceleration* extra) {
  if (extra != nullptr && tank_.is_cut()) throw std::logic_error("sources are those of a whole tank");
  tell({Order::Kind::advance, longest});
  return take_step(longest, extra);
}

std::optional<RunExit> TimeLoop::take_step(double longest, const BodyAcceleration* extra) {
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
  tell({Order::Kind::step_back});
  forget_step();
}

void TimeLoop::forget_step() {
  std::swap(now_, next_);
  counters_ = before_.counters;
  monitors_.restore(before_.monitors);
  control_.restore(before_.dt);
}

CheckpointView TimeLoop::checkpoint(const RunProgress& progress) {
  return checkpoint_view(tank_.grid(), whole_now(), control_, monitors_, counters_, progress);
}

}  // namespace granvof
