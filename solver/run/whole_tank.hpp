// The state of the whole tank, where it is cut among processes: what output and checkpoints are made of, and
// what a start or a checkpoint is dealt out from.
#pragma once

#include <optional>

#include "solver/grid/whole_box.hpp"
#include "solver/state/state.hpp"

namespace granvof {

class WholeTank {
 public:
  // `grid`: of this process; it must outlive this.
  WholeTank(const Scene& scene, const Grid& grid);

  bool is_cut() const { return whole_.has_value(); }
  // The grid's own where the tank is not cut.
  const Grid& grid() const { return whole_ ? *whole_ : part_; }

  // Of a tank that is cut; all processes at once.
  // The whole state in the lowest process: `whole`, which it makes room in. The others keep none.
  void collect(const State& part, std::optional<State>& whole) const;
  // This process's part of the state that the lowest one has whole.
  void deal(std::optional<State>& whole, State& part) const;
  // This process's part of what every one has whole.
  void take(const State& whole, State& part) const;

 private:
  const Grid& part_;
  std::optional<Grid> whole_;
  std::optional<WholeBox> box_;
};

}  // namespace granvof
