// A scene run by several processes, each with a slab of its tank, held to the run of one.
//
// Only the order in which sums are added up differs, and the solvers of friction, which keep to no box of
// grains along the cut: fields agree to what the solvers' tolerances leave.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/run/cut.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/scales.hpp"
#include "solver/tests/run/small_runs.hpp"
#include "solver/tests/team.hpp"

namespace granvof::test {

inline constexpr double cut_agreement = 1e-6;  // of the largest value of a field
// Of the scene's own scales: what the friction solver leaves of a velocity.
inline constexpr double left_by_solvers = 1e-9;

struct Outcome {
  std::map<std::string, std::vector<double>> fields;  // ghosts included
  std::map<std::string, double> numbers;
  double time = 0.0;
};

inline Outcome outcome_of(TimeLoop& loop) {
  Outcome all;
  const CheckpointView view = loop.checkpoint({});
  for (const auto& [name, values] : view.arrays) all.fields[name].assign(values.begin(), values.end());
  all.numbers.insert(view.scalars.begin(), view.scalars.end());
  all.time = view.time;
  return all;
}

inline Checkpoint saved(const Outcome& all) {
  Checkpoint c;
  c.time = all.time;
  c.arrays = all.fields;
  c.scalars.insert(all.numbers.begin(), all.numbers.end());
  for (const char* name : {"steps", "refused_steps", "newton", "linear", "friction", "unconverged_friction"})
    c.counters[name] = 7;
  return c;
}

inline void take_steps(TimeLoop& loop, int n) {
  for (int i = 0; i < n; ++i)
    if (const auto stuck = loop.advance()) throw std::runtime_error(stuck->reason);
}

// lead(loop) in the lowest of so many processes that share the tank; the others follow.
template <typename Lead>
void with(int processes, const Scene& scene, Lead&& lead) {
  if (processes == 1) {
    TimeLoop loop(scene);
    return lead(loop);
  }
  Team team(processes, Boxes::slabs);
  ASSERT_NO_THROW(team.run([&](int rank, const Communicator& communicator) {
    TimeLoop loop(scene, &communicator);
    if (rank > 0) {
      EXPECT_EQ(loop.follow(), 5);
      return;
    }
    lead(loop);
    loop.dismiss(5);
  }));
}

inline double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::fabs(v));
  return most;
}

// What a field's values are measured by: the scene's velocity, pressure, 1.
inline double scale_of(const Scene& scene, const std::string& field) {
  const Scales scales = scales_of(scene);
  if (field.starts_with("u_")) return scales.velocity;
  if (field.starts_with("p_")) return scales.pressure;
  return field == "theta" ? scales.velocity * scales.velocity : 1.0;
}

// The same state with some disorder in all that moves, and in what it is moved by. What is empty stays so.
inline Outcome shaken(const Scene& scene, Outcome state) {
  std::mt19937 random{5};
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (auto& [name, values] : state.fields) {
    const double speed = name.starts_with("u_") ? 0.05 * scale_of(scene, name) : 0.0;
    for (double& value : values) value = value * (1.0 - 0.05 * (1.0 + share(random))) + speed * share(random);
  }
  std::vector<double>& theta = state.fields.at("theta");
  const std::vector<double>& grains = state.fields.at("f_s");
  for (std::size_t c = 0; c < theta.size(); ++c)
    theta[c] += 1e-3 * grains[c] * scale_of(scene, "theta") * (1.0 + share(random));
  return state;
}

// Largest value of a field; of a component of a velocity, of all of its components: one that is nothing but
// what the solvers leave is no measure.
inline double size_of(const Outcome& outcome, const std::string& field) {
  double most = 0.0;
  for (const auto& [name, values] : outcome.fields)
    if (name == field || (field.starts_with("u_") && name.starts_with(field.substr(0, field.size() - 1))))
      most = std::max(most, largest(values));
  return most;
}

// Fields and numbers of both runs, after the same steps.
inline void expect_alike(const Scene& scene, const Outcome& one, const Outcome& many, int processes) {
  const std::string where = std::to_string(processes) + " processes";
  for (const auto& [name, values] : one.fields) {
    const double size = size_of(one, name);
    double off = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
      off = std::max(off, std::fabs(values[i] - many.fields.at(name)[i]));
    EXPECT_LE(off, cut_agreement * size + left_by_solvers * scale_of(scene, name)) << name << ", " << where;
  }
  for (const auto& [name, value] : one.numbers)
    EXPECT_NEAR(many.numbers.at(name), value,
                cut_agreement * (std::fabs(value) + 1e-3 * std::fabs(one.numbers.at("energy_potential"))))
        << name << ", " << where;
}

// Steps of one process, and those of as many as are named: the same.
inline void expect_the_steps_of_one(const Scene& scene, const std::vector<int>& numbers_of_processes,
                                    int steps) {
  Outcome one;
  with(1, scene, [&](TimeLoop& loop) {
    take_steps(loop, steps);
    one = outcome_of(loop);
  });
  EXPECT_GT(one.numbers.at("energy_kinetic"), 0.0);
  for (const int processes : numbers_of_processes)
    with(processes, scene, [&](TimeLoop& loop) {
      take_steps(loop, steps);
      const Outcome many = outcome_of(loop);
      expect_alike(scene, one, many, processes);
      EXPECT_LE(many.numbers.at("liquid_error"), 1e-12) << processes << " processes";
      EXPECT_LE(many.numbers.at("solid_error"), 1e-12) << processes << " processes";
    });
}

}  // namespace granvof::test
