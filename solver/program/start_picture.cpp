#include "solver/program/start_picture.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <fmt/format.h>

#include "solver/scene/side_kinds.hpp"

namespace granvof {
namespace {

constexpr double width = 720.0, margin = 60.0;  // of the tank and around it [px]
constexpr int most_lines = 120;                 // of the grid in a direction: more are a grey, not lines

// Of the picture, y down.
class Canvas {
 public:
  explicit Canvas(const Scene& scene) : scale_(width / scene.tank[0]), height_(scale_ * scene.tank[1]) {
    add(R"svg(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {:.1f} {:.1f}" font-family="sans-serif" font-size="13">
<rect width="100%" height="100%" fill="white"/>
)svg",
        width + 2 * margin, height_ + 2 * margin);
  }
  double x(double metres) const { return margin + scale_ * metres; }
  double y(double metres) const { return margin + height_ - scale_ * metres; }

  template <typename... Values>
  void add(fmt::format_string<Values...> text, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), text, std::forward<Values>(values)...);
  }
  void line(const char* name, double x0, double y0, double x1, double y1, const char* style) {
    add(R"svg(<line class="{}" x1="{:.2f}" y1="{:.2f}" x2="{:.2f}" y2="{:.2f}" {}/>
)svg",
        name, x(x0), y(y0), x(x1), y(y1), style);
  }
  void label(double px, double py, const std::string& words, const char* anchor = "middle") {
    add(R"svg(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>
)svg",
        px, py, anchor, words);
  }
  void box(const char* of, const Box& b, const char* fill) {
    add(R"svg(<rect class="{}" x="{:.2f}" y="{:.2f}" width="{:.2f}" height="{:.2f}" fill="{}"/>
)svg",
        of, x(b.lower[0]), y(b.upper[1]), x(b.upper[0]) - x(b.lower[0]), y(b.lower[1]) - y(b.upper[1]), fill);
  }
  std::string finished() { return text_ + "</svg>\n"; }

 private:
  double scale_, height_;  // [px/m], [px]
  std::string text_;
};

std::string word_for(const Side& side) {
  if (side.kind != SideKind::wall) return facts_of(side.kind).name;
  switch (side.solid.kind) {
    case WallKind::slip:
      return "slip";
    case WallKind::no_slip:
      return "no-slip";
    case WallKind::coulomb:
      return fmt::format("coulomb {:g}", side.solid.friction);
    case WallKind::bumpy:
      return fmt::format("bumpy {:g}", side.solid.bumpiness);
  }
  return "";
}

// The front face of a sloping bed leans back from its foot.
void draw_bed(Canvas& canvas, const Scene& scene) {
  if (!scene.bed) return;
  const Box& box = scene.bed->box;
  const double height = box.upper[1] - box.lower[1];
  const double back =
      scene.bed->slope < 90.0 ? height / std::tan(scene.bed->slope * std::numbers::pi / 180.0) : 0.0;
  const double length = box.upper[0] - box.lower[0];
  const double top = back > length ? box.lower[1] + height * length / back : box.upper[1];
  const double top_end = std::max(box.lower[0], box.upper[0] - back);
  canvas.add(
      R"svg(<polygon class="bed" points="{:.2f},{:.2f} {:.2f},{:.2f} {:.2f},{:.2f} {:.2f},{:.2f}" fill="#c98d3f" fill-opacity="0.8"/>
)svg",
      canvas.x(box.lower[0]), canvas.y(box.lower[1]), canvas.x(box.upper[0]), canvas.y(box.lower[1]),
      canvas.x(top_end), canvas.y(top), canvas.x(box.lower[0]), canvas.y(top));
  canvas.label(
      canvas.x(0.5 * (box.lower[0] + box.upper[0])), canvas.y(box.lower[1] + 0.3 * height),
      fmt::format("{:.4g} x {:.4g} mm, f_s {:g}", 1e3 * length, 1e3 * height, scene.bed->solid_fraction));
}

void draw_grid(Canvas& canvas, const Scene& scene) {
  constexpr const char* thin = R"(stroke="#000" stroke-opacity="0.15" stroke-width="0.5")";
  const int columns = scene.grid.cells[0], rows = scene.grid.cells[1];
  if (std::max(columns, rows) > most_lines) return;
  for (int i = 1; i < columns; ++i)
    canvas.line("grid", i * scene.grid.spacing[0], 0.0, i * scene.grid.spacing[0], scene.tank[1], thin);
  for (int j = 1; j < rows; ++j)
    canvas.line("grid", 0.0, j * scene.grid.spacing[1], scene.tank[0], j * scene.grid.spacing[1], thin);
}

void draw_sides(Canvas& canvas, const Scene& scene) {
  const double l = scene.tank[0], h = scene.tank[1];
  const auto style = [&](SideIndex side) {
    return scene.sides[side].kind == SideKind::wall
               ? R"(stroke="#222" stroke-width="3")"
               : R"(stroke="#222" stroke-width="2" stroke-dasharray="6 5")";
  };
  canvas.line("side", 0.0, 0.0, 0.0, h, style(left));
  canvas.line("side", l, 0.0, l, h, style(right));
  canvas.line("side", 0.0, 0.0, l, 0.0, style(bottom));
  canvas.line("side", 0.0, h, l, h, style(top));
  const auto words = [&](SideIndex side) { return word_for(scene.sides[side]); };
  canvas.label(canvas.x(0.5 * l), canvas.y(h) - 8.0, words(top));
  canvas.label(canvas.x(0.5 * l), canvas.y(0.0) + 18.0, words(bottom));
  canvas.label(canvas.x(0.0) - 6.0, canvas.y(0.5 * h), words(left), "end");
  canvas.label(canvas.x(l) + 6.0, canvas.y(0.5 * h), words(right), "start");
}

}  // namespace

std::string picture_of_start(const Scene& scene) {
  Canvas canvas(scene);
  for (const Box& liquid : scene.liquid_boxes) canvas.box("liquid", liquid, "#cfe3f5");
  draw_bed(canvas, scene);
  draw_grid(canvas, scene);
  for (const Box& obstacle : scene.obstacles) canvas.box("obstacle", obstacle, "#777");
  draw_sides(canvas, scene);
  if (scene.gate)
    canvas.line("gate", scene.gate->position, 0.0, scene.gate->position, scene.tank[1],
                R"(stroke="#b3261e" stroke-width="3")");
  const auto& cells = scene.grid.cells;
  canvas.label(margin, 20.0, scene.name, "start");
  canvas.label(margin, canvas.y(0.0) + 40.0,
               fmt::format("tank {:.4g} x {:.4g}{} mm; {} x {} x {} cells of {:.4g} mm{}",
                           1e3 * scene.tank[0], 1e3 * scene.tank[1],
                           scene.dimensions == 3 ? fmt::format(" x {:.4g}", 1e3 * scene.tank[2]) : "",
                           cells[0], cells[1], cells[2], 1e3 * scene.grid.spacing[0],
                           std::max(cells[0], cells[1]) > most_lines ? ", too many to draw" : ""),
               "start");
  return canvas.finished();
}

}  // namespace granvof
