#include "solver/scene/complete.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "solver/closures/friction/laws.hpp"
#include "solver/scene/completion.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof::case_file {
namespace {

constexpr double most_cells = 1e9;  // of a grid

void name(const Completion& c) {
  const std::string& text = c.s.name;
  const auto breaks_path = [](char x) {
    return static_cast<unsigned char>(x) < 0x20 || x == '/' || x == 0x7f;
  };
  if (text == "." || text == ".." || text.size() > longest_scene_name ||
      std::ranges::any_of(text, breaks_path)) {
    c.refuse("scene.name", fmt::format("the name of a file: at most {} bytes, no \"/\", not \".\" or \"..\"",
                                       longest_scene_name));
  }
  if (c.s.title.empty()) c.s.title = text;
}

void tank(const Completion& c) {
  c.components("tank.size", c.d.tank_size);
  if (!c.flat() && c.given("tank.depth"))
    c.refuse("tank.depth", "no such key in 3D: tank.size has the depth");
  if (c.flat()) c.d.depth = c.d.depth.value_or(1.0);
  c.s.tank = {c.d.tank_size[0], c.d.tank_size[1], c.flat() ? *c.d.depth : c.d.tank_size[2]};
}

void grid(const Completion& c) {
  Draft& d = c.d;
  c.only_in_3d("grid.dz");
  d.dy = d.dy.value_or(d.dx);
  if (!c.flat()) d.dz = d.dz.value_or(d.dx);
  const std::array<double, 3> wanted{d.dx, *d.dy, d.dz.value_or(c.s.tank[2])};
  double total = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::string key = std::string("grid.d") + "xyz"[axis];
    if (!c.given(key)) key = "grid.dx";
    const double cells = c.s.tank[axis] / wanted[axis];
    const double whole = std::round(cells);
    total *= std::max(1.0, cells);
    if (total > most_cells) c.refuse(key, fmt::format("a spacing that gives at most {} cells", most_cells));
    if (whole < 1.0 || std::abs(cells - whole) > 1e-6) {
      const double fewer = std::max(1.0, std::floor(cells));
      c.refuse(
          key,
          fmt::format("a spacing that divides the tank's {} = {} m into whole cells, the nearest {:.9g} ({} "
                      "cells) and {:.9g} ({} cells)",
                      "xyz"[axis], c.s.tank[axis], c.s.tank[axis] / (fewer + 1.0), fewer + 1.0,
                      c.s.tank[axis] / fewer, fewer));
    }
    c.s.grid.cells[axis] = static_cast<int>(whole);
    c.s.grid.spacing[axis] = c.s.tank[axis] / whole;
  }
}

void level(const Completion& c) {
  if (!c.d.level) return;
  if (c.outside(0.0, *c.d.level, 1))
    c.refuse("liquid.level", fmt::format("at most the tank's height {} m", c.s.tank[1]));
  c.s.liquid_boxes.push_back({{0.0, 0.0, 0.0}, {c.s.tank[0], *c.d.level, c.s.tank[2]}});
}

void liquid_box(const Completion& c) {
  const std::vector<double>&origin = c.d.box_origin, &size = c.d.box_size;
  if (origin.empty() != size.empty()) {
    c.refuse(origin.empty() ? "liquid.box.origin" : "liquid.box.size",
             "box = { origin = [...], size = [...] }");
  }
  if (origin.empty()) return;
  c.components("liquid.box.origin", origin);
  c.components("liquid.box.size", size);
  Box box{{0.0, 0.0, 0.0}, c.s.tank};
  for (int axis = 0; axis < c.s.dimensions; ++axis) {
    box.lower[axis] = origin[axis];
    box.upper[axis] = origin[axis] + size[axis];
    if (c.outside(box.lower[axis], box.upper[axis], axis)) {
      c.refuse("liquid.box.size",
               fmt::format("a box inside the tank: in {} it ends at {:.9g} m, the tank at {:.9g} m",
                           "xyz"[axis], box.upper[axis], c.s.tank[axis]));
    }
  }
  c.s.liquid_boxes.push_back(box);
}

void complete_materials(Completion& c) {
  if (!c.has("liquid")) c.s.liquid = c.s.gas;
  c.rule({"tank", "scene.dimensions", "liquid.level"}, [&] { level(c); });
  c.rule({"tank", "scene.dimensions", "liquid.box"}, [&] { liquid_box(c); });
  Contact& contact = c.s.contact;
  c.rule({"contact.solid_fraction_min", "contact.solid_fraction_max"}, [&] {
    if (contact.solid_fraction_min >= contact.solid_fraction_max) {
      c.refuse("contact.solid_fraction_min",
               fmt::format("below contact.solid_fraction_max = {}", contact.solid_fraction_max));
    }
  });
  c.rule({"contact.fast_friction", "solid.friction", "model"}, [&] {
    constexpr std::string_view key = "contact.fast_friction";
    if (!c.s.model.friction_law.facts().reads_key(key) && !c.s.model.thin_layer_arrest) return;
    // that of glass beads, for grains that rub no more than they do
    if (!c.given(std::string(key)))
      contact.fast_friction = std::max(contact.fast_friction, c.s.solid.friction);
    if (contact.fast_friction < c.s.solid.friction) {
      c.refuse(std::string(key),
               fmt::format("at least solid.friction = {}, with friction_law = {}, or thin_layer_arrest "
                           "(model.preset = \"{}\")",
                           c.s.solid.friction, closures::words_that_read<closures::FrictionLaws>(key),
                           word_of(c.d.preset)));
    }
  });
  c.rule({"contact.critical_solid_fraction", "contact.solid_fraction_min", "contact.solid_fraction_max",
          "model"},
         [&] {
           if (c.s.model.shear_dilatancy && (contact.critical_solid_fraction <= contact.solid_fraction_min ||
                                             contact.critical_solid_fraction >= contact.solid_fraction_max)) {
             c.refuse(
                 "contact.critical_solid_fraction",
                 fmt::format("between contact.solid_fraction_min = {} and contact.solid_fraction_max = {}",
                             contact.solid_fraction_min, contact.solid_fraction_max));
           }
         });
  c.rule({"contact.dense_solid_fraction", "contact.solid_fraction_max"}, [&] {
    if (contact.dense_solid_fraction > contact.solid_fraction_max) {
      c.refuse("contact.dense_solid_fraction",
               fmt::format("at most contact.solid_fraction_max = {}", contact.solid_fraction_max));
    }
  });
}

}  // namespace

int Completion::layer_of(const std::string& key) const {
  const auto found = text.entries.find(key);
  return found == text.entries.end() ? -1 : found->second.layer;
}

void Completion::refuse(const std::string& key, const std::string& allowed) const {
  throw Refusal{fault_of(text, d, key, allowed)};
}

void Completion::only_in_3d(const std::string& key) const {
  if (flat() && given(key)) refuse(key, "no such key in 2D (scene.dimensions = 2)");
}

void Completion::needs(const std::string& table, const std::string& other) const {
  if (has(table) && !has(other)) {
    throw Refusal{{table, text.place_of(table),
                   fmt::format("{}: got [{}] without [{}], allowed: both or neither", table, table, other)}};
  }
}

void Completion::components(const std::string& key, const std::vector<double>& list) const {
  if (static_cast<int>(list.size()) != s.dimensions) {
    refuse(key, fmt::format("{} numbers (scene.dimensions = {})", s.dimensions, s.dimensions));
  }
}

Scene complete(Draft& draft, const CaseText& text, Faults& faults) {
  Completion c(draft, text, faults);
  c.rule({"scene.name"}, [&] { name(c); });
  c.rule({"scene.dimensions", "tank"}, [&] { tank(c); });
  c.rule({"scene.dimensions", "tank", "grid"}, [&] { grid(c); });
  complete_walls(c);
  complete_materials(c);
  complete_bed(c);
  complete_gate(c);
  complete_obstacles(c);
  complete_times(c);
  complete_reference(c);
  faults.throw_if_any();
  return draft.scene;
}

}  // namespace granvof::case_file
