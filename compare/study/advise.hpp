// The cheapest configuration of a scene that meets a tolerance: a walk over grid, method and model parts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/study/study_file.hpp"

namespace granvof::compare {

struct Configuration {
  double cell = 0.0;  // [m]
  Method method;
  std::vector<Part> without;  // parts of the model removed or simplified, no two of them on the same key
};

struct Trial {
  std::optional<double> error;  // relative, against the reference [-]; nothing: `failure` says why
  double cost = 0.0;            // [core-s per simulated s]
  std::string failure;
  double noise = 0.0;  // relative uncertainty of the cost [-]
};

// Where configurations are tried.
class Bench {
 public:
  virtual ~Bench() = default;
  virtual Trial trial(const Configuration& configuration) = 0;
  // Relative distance of two configurations from each other [-]; nothing where one did not run.
  virtual std::optional<double> distance(const Configuration& a, const Configuration& b) = 0;
  // Whether results are held against this very run.
  virtual bool is_reference(const Configuration& configuration) = 0;
  // The overrides of a part in this scene; nothing where it does not apply.
  virtual std::optional<std::vector<std::string>> overrides(const Part& part) = 0;
};

struct Step {
  Configuration configuration;
  Trial trial;
  std::string remark;  // what was concluded from it
};

struct Advice {
  std::optional<Step> chosen;        // nothing: no configuration met the tolerance and was confirmed
  std::optional<Step> confirmation;  // the same method and parts on the next finer grid
  std::optional<double> moved;       // relative distance of the two [-]
  std::vector<Step> steps;           // all that was tried, in order: the evidence
};

// Walks `cells` (large to small) and, on each, all methods. A configuration within `tolerance` is confirmed
// on the next finer cells: there the error must be within the tolerance too, and the two no further apart
// than that (where the next finer run is the reference itself this is no independent witness, and taken
// last); what met it by accident on a coarse grid fails this, and the walk goes on. Of what is confirmed on a
// grid the cheapest is taken (of those that cost the same within their noise the first of `methods`). Then
// parts of the model go: each is tried alone on the next coarser cells (the same, if there are none), the
// cheapest without it first; it may go where it moves the result by at most a quarter of the tolerance and
// saves at least 10 % of the cost, and more than the noise of both costs. Those go together on the chosen
// grid, and the one that moved most stays until the rest meets the tolerance and is confirmed. The smallest
// cells serve to confirm only.
Advice advise(const std::vector<double>& cells, const std::vector<Method>& methods,
              const std::vector<Part>& parts, double tolerance, Bench& bench);

// "preset paper (first order, CICSAM)" of a method that is a preset, else its name.
std::string name_of(const Method& method);
// "second order, CICSAM on 2.5 mm, no LES".
std::string name_of(const Configuration& configuration);

}  // namespace granvof::compare
