// Wall time by named part of the time step.
#pragma once

#include <chrono>
#include <map>
#include <string>

namespace granvof {

class Stopwatch {
 public:
  // Runs body() and adds its time to `part`.
  template <typename Body>
  void time(const char* part, Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    body();
    seconds_[part] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  const std::map<std::string, double>& seconds() const { return seconds_; }

 private:
  std::map<std::string, double> seconds_;
};

}  // namespace granvof
