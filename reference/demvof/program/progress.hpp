// The line on stderr that says how far a recording is and how long it still takes.
#pragma once

#include <chrono>
#include <string>

namespace demvof {

class ProgressLine {
 public:
  ProgressLine(bool wanted, std::string name);
  void say(const std::string& what);
  // `now` between `start` and `end` [s]; prints every second on a terminal, every 30 s elsewhere.
  void update(double now, double start, double end);
  void end();

 private:
  bool wanted_ = false, terminal_ = false;
  std::string name_;
  std::chrono::steady_clock::time_point begin_, last_;
  bool begun_ = false;
};

}  // namespace demvof
