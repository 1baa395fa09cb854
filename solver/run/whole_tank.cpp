#include "solver/run/whole_tank.hpp"

namespace granvof {

WholeTank::WholeTank(const Scene& scene, const Grid& grid) : part_(grid) {
  if (!grid.cells.is_cut()) return;
  whole_.emplace(scene);
  box_.emplace(grid.cells, whole_->cells, WholeBox::Values::box_and_ghosts);
}

void WholeTank::collect(const State& part, std::optional<State>& whole) const {
  if (part_.cells.communicator->rank() == 0 && !whole) whole.emplace(*whole_);
  for_each_field(part_, part, [&](const FieldOfState& of, const Field& f) {
    box_->collect(f.data(), whole ? of(*whole).data() : nullptr, false);
  });
  if (!whole) return;
  whole->time = part.time;
  whole->energy = part.energy;
}

void WholeTank::deal(std::optional<State>& whole, State& part) const {
  if (!whole) whole.emplace(*whole_);
  const Communicator& processes = *part_.cells.communicator;
  for_each_field(*whole_, *whole, [&](const FieldOfState&, Field& f) {
    processes.broadcast(std::as_writable_bytes(f.span()));
  });
  processes.broadcast(std::as_writable_bytes(std::span(&whole->time, 1)));
  processes.broadcast(std::as_writable_bytes(std::span(&whole->energy, 1)));
  take(*whole, part);
}

void WholeTank::take(const State& whole, State& part) const {
  for_each_field(part_, part,
                 [&](const FieldOfState& of, Field& f) { box_->take(of(whole).data(), f.data()); });
  part.time = whole.time;
  part.energy = whole.energy;
}

}  // namespace granvof
