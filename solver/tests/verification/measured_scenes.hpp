// Shipped scenes to be simulated, and what their measurements are held to and kept as.
#pragma once

#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "solver/scene/load_scene.hpp"
#include "solver/tests/cases_directory.hpp"
#include "solver/tests/simulation.hpp"

namespace granvof::test {

inline Scene shipped_scene(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return load_scene(cases_directory().string() + "/" + name + ".toml", overrides);
}

// A measured number: a property of the test's record and a line that can be quoted.
template <typename Number>
void report(const std::string& name, Number value) {
  std::ostringstream text;
  text.precision(6);
  text << static_cast<double>(value);
  ::testing::Test::RecordProperty(name, text.str());
  std::printf("  %s = %s\n", name.c_str(), text.str().c_str());
}

// Rows of a published series in cases/published, comments and the heading left out.
inline std::vector<std::vector<double>> published(const std::string& file) {
  std::ifstream in(cases_directory().string() + "/published/" + file);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || !(std::isdigit(static_cast<unsigned char>(line[0])) || line[0] == '-')) continue;
    std::istringstream numbers(line);
    std::vector<double> row;
    for (double v = 0.0; numbers >> v;) row.push_back(v);
    rows.push_back(row);
  }
  return rows;
}

// A recorded curve: linear between its points, its ends beyond them.
struct Curve {
  std::vector<double> x, y;
  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
  double operator()(double at) const {
    if (at <= x.front()) return y.front();
    for (std::size_t i = 1; i < x.size(); ++i)
      if (at <= x[i]) return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    return y.back();
  }
  // Positions at which the curve crosses zero.
  std::vector<double> zeros() const {
    std::vector<double> found;
    for (std::size_t i = 1; i < x.size(); ++i)
      if ((y[i - 1] < 0.0) != (y[i] < 0.0))
        found.push_back(x[i - 1] + (x[i] - x[i - 1]) * y[i - 1] / (y[i - 1] - y[i]));
    return found;
  }
};

}  // namespace granvof::test
