// One multigrid V-cycle in single precision: the preconditioner of every solver of this directory.
//
// A x = mass x + sum over faces of a (x - x_neighbour). Geometric, matrix-free: coarse cells are pairs of
// cells in each coarsened direction, masses are summed, a coarse face is the sum of its fine faces divided by
// the growth of the distance it spans (a half), residuals are summed, corrections injected. Arithmetic coarse
// faces keep the iteration count flat at a contrast of 1e10; harmonic ones do not.
//
// Every level is stored scaled by its diagonal D, as D^-1/2 A D^-1/2: a sweep then reads neither diagonal nor
// mass, only the scaled faces. Smoother: Chebyshev-Jacobi on the eigenvalues [0.5, 2] of D^-1 A, which suits
// any such operator (its largest eigenvalue is at most 2).
//
// Of a box that is cut among processes the levels are cut alike while they have many cells and no pair lies
// across a seam. The first that is not so is gathered: from there on every process has the whole level and
// does the same with it. Every value is to the bit what one process would make of the whole box.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/grid/layout.hpp"
#include "solver/grid/memory.hpp"
#include "solver/grid/whole_box.hpp"
#include "solver/linear/faces.hpp"
#include "solver/linear/padded_layout.hpp"

namespace granvof::linear {

// Where a hierarchy takes its finest coefficients from, one row along x at a time: n[0] values.
class Coefficients {
 public:
  virtual ~Coefficients() = default;
  virtual bool coupled(int direction) const = 0;
  virtual void faces(int direction, int j, int k, float* out) const = 0;
  virtual void masses(int j, int k, float* out) const = 0;
};

class Multigrid {
 public:
  static constexpr int max_smoothing = 8;

  // `spacing` (any unit): a direction is coarsened only while its cells are
  // less than about twice as long as the shortest ones, since weakly coupled directions need no coarsening.
  explicit Multigrid(const Layout& layout, const std::array<double, 3>& spacing = {1.0, 1.0, 1.0});

  // Takes new coefficients. Faces and masses >= 0. No allocation unless other directions become coupled than
  // in the last call (at first: all with more than one cell).
  void set(const Faces& faces, const double* mass);
  void set(const Coefficients& coefficients);

  // z = V-cycle of r from a zero guess with `smoothing` (1...8) sweeps before and after; symmetric and
  // positive. Both in the layout given at construction. Rows without mass and faces: z = r, and no effect on
  // others.
  void apply(const float* r, float* z, int smoothing);
  void apply(const double* r, double* z, int smoothing);

  // The same on the scaled finest level, without copies, for the solvers here: put r * scale() into
  // residual() (box only), then z = scale() * (what cycle returns). All in the padded layout(); padding is 0.
  const Layout& layout() const { return levels_.front().layout; }
  const float* scale() const { return levels_.front().scale.data(); }
  float* residual() { return levels_.front().rhs.data(); }
  // The answer stays valid until the next call. `dot`, if given, receives r . z.
  const float* cycle(int smoothing, double* dot = nullptr);

  int level_count() const { return static_cast<int>(levels_.size()); }

 private:
  struct Level {
    Layout layout;
    std::array<bool, 3> coupled{};      // directions with more than one cell
    std::array<bool, 3> coarsened{};    // on the way to the next level
    std::array<Buffer<float>, 3> face;  // first as given, then scaled
    Buffer<float> mass, scale, root;  // root = sqrt(D), scale = 1 / sqrt(D); both 0 in rows without diagonal
    Buffer<float> weight;             // of injection and sum: root / root of the coarse cell
    Buffer<float> rhs;
    std::array<Buffer<float>, 2> x;
    std::optional<WholeBox> gathered;  // the next level is this one, whole in every process
  };
  struct Sweep {  // x_new = x + momentum (x - x_old) + step (rhs - A x)
    float momentum = 0.0F, step = 0.0F;
  };

  void build(const std::array<bool, 3>& coupled);
  bool stays_cut(const Layout& layout, const std::array<bool, 3>& coarsened) const;
  float* descend_gathered(Level& level, std::size_t depth, int smoothing, double* dot);
  void scale_level(Level& level);
  void coarsen(const Level& fine, Level& coarse) const;
  void gather_coefficients(const Level& cut, Level& whole) const;
  void weigh(Level& fine, const Level& coarse) const;
  float* descend(std::size_t depth, int smoothing, double* dot);
  void smooth(const Level& l, const float* x, const float* old, float old_factor, float* out, Sweep s) const;
  double smooth_and_dot(const Level& l, const float* x, const float* old, float* out, Sweep s) const;
  void restrict_residual(const Level& fine, const float* x, Level& coarse) const;
  void inject(const Level& fine, const Level& coarse, const float* e, float* x) const;

  Layout user_;
  std::array<double, 3> spacing_;
  std::array<Sweep, max_smoothing> sweeps_;
  std::vector<Level> levels_;
};

}  // namespace granvof::linear
