#include "solver/run/progress_line.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace granvof {
namespace {

constexpr std::array<std::string_view, 8> bars{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::size_t most_bars = 20;

// In characters; of one in UTF-8 all bytes but the first begin with the bits 10.
int width_of(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

int columns_of_terminal() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

std::string front_plot(std::span<const double> fronts) {
  if (fronts.size() < 2) return {};
  const auto [lowest, highest] = std::ranges::minmax(fronts);
  const std::size_t n = std::min(fronts.size(), most_bars);
  std::string plot;
  for (std::size_t i = 0; i < n; ++i) {
    const double front = fronts[i * (fronts.size() - 1) / (n - 1)];
    const double share = highest > lowest ? (front - lowest) / (highest - lowest) : 0.0;
    plot +=
        bars[std::min(bars.size() - 1, static_cast<std::size_t>(share * static_cast<double>(bars.size())))];
  }
  return fmt::format("front {} {:.4g} m", plot, fronts.back());
}

std::string side_by_side(std::span<const std::string> parts, int columns) {
  std::string line;
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    if (line.empty()) {
      line = part;
      continue;
    }
    if (width_of(line) + 2 + width_of(part) >= columns) break;  // the last column is the cursor's
    line += "  " + part;
  }
  return line;
}

void ProgressLine::add(const Scalars& row) {
  if (!on_) return;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (scalar_table()[i].name == "front_dense" && row[i]) fronts_.push_back(*row[i]);
}

void ProgressLine::show(const RunProgress& progress, double dt, int newton, int linear) {
  if (!on_) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < std::chrono::milliseconds(500)) return;
  last_ = now;
  const double start = -scene_.times.hold;
  const double share = (progress.simulated_time - start) / (scene_.times.end - start);
  const double wall = std::chrono::duration<double>(now - started_).count();
  const double left = share > 0.0 ? wall / share * (1.0 - share) : 0.0;
  const std::array parts{fmt::format("{}: t {:.4f} s", scene_.name, progress.simulated_time),
                         fmt::format("{:3.0f} %  {:.0f} s left", 100.0 * share, left),
                         front_plot(fronts_),
                         fmt::format("dt {:.2e} s", dt),
                         fmt::format("Newton {} linear {}", newton, linear),
                         fmt::format("volume errors: solid {:.1e} liquid {:.1e}", progress.solid_volume_error,
                                     progress.liquid_volume_error)};
  fmt::print(stderr, "\r{}\033[K", side_by_side(parts, columns_of_terminal()));
  std::fflush(stderr);
}

void ProgressLine::clear() const {
  if (on_) fmt::print(stderr, "\r\033[K");
}

}  // namespace granvof
