// Named monitors of a run: volumes, extremes, and whether anything stopped being finite.
#pragma once

#include <string>

#include "solver/state/state.hpp"

namespace granvof {

class Monitors {
 public:
  // Takes the volumes of the start as the reference.
  Monitors(const Grid& grid, const Scene& scene, const State& start);

  // After an accepted step; what left through the sides, net [m3].
  void update(const State& s, double liquid_left, double solid_left);

  double solid_volume(const State& s) const;   // [m3]
  double liquid_volume(const State& s) const;  // [m3]
  // Largest change that the sides do not account for, of what was there or, where that is more, has passed
  // them [-].
  double solid_volume_error() const { return solid_error_; }
  double liquid_volume_error() const { return liquid_error_; }
  double solid_fraction_max() const { return solid_max_; }  // largest ever [-]
  double solid_fraction_min() const { return solid_min_; }  // smallest ever [-]
  // Largest P_s of cells beside sides that grains pass, of the state of the last update() [Pa].
  double outlet_load() const { return outlet_load_; }
  // Empty, or which field or energy is not finite.
  std::string not_finite(const State& s) const;

  struct Values {
    double solid_volume, liquid_volume, liquid_left, solid_left, solid_error, liquid_error, solid_max,
        solid_min;
  };
  Values values() const {
    return {solid_volume_, liquid_volume_, liquid_left_, solid_left_,
            solid_error_,  liquid_error_,  solid_max_,   solid_min_};
  }
  void restore(const Values& v);

 private:
  double load_on_outlets(const State& s) const;

  const Grid& grid_;
  double tank_;   // [m3]
  double rho_s_;  // [kg/m3]
  double solid_volume_ = 0.0, liquid_volume_ = 0.0, liquid_left_ = 0.0, solid_left_ = 0.0;
  double solid_error_ = 0.0, liquid_error_ = 0.0, solid_max_ = 0.0, solid_min_ = 1.0;
  double outlet_load_ = 0.0;
};

}  // namespace granvof
