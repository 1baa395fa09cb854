#include "compare/study/study_file.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "compare/checks/theory.hpp"
#include "compare/input/toml_entry.hpp"
#include "solver/scene/keys.hpp"

namespace granvof::compare {
namespace {

// What methods, others and parts have in common.
template <typename Named>
Named read_named(const TomlEntry& entry) {
  Named named;
  named.name = entry.text("name");
  if (entry.has("set")) named.set = entry.assignments("set");
  if (entry.has("about")) named.about = entry.text("about");
  return named;
}

Method read_method(const TomlEntry& entry) {
  entry.allow_only({"name", "set", "about", "grids", "other_model", "advise"});
  auto method = read_named<Method>(entry);
  if (entry.has("grids")) {
    const double grids = entry.positive("grids");
    if (grids != std::floor(grids)) entry.fail("grids", fmt::format("{} given; allowed: 1, 2, ...", grids));
    method.grids = static_cast<std::size_t>(grids);
  }
  if (entry.has("other_model")) method.other_model = entry.truth("other_model");
  if (entry.has("advise")) method.advise = entry.truth("advise");
  return method;
}

Other read_other(const TomlEntry& entry) {
  entry.allow_only({"name", "records", "set", "about", "line"});
  auto other = read_named<Other>(entry);
  if (entry.has("records")) other.records = entry.text("records");
  if (entry.has("line")) other.line = entry.text("line");
  return other;
}

// What the key of an assignment is, and of which part of the model; "" for no key.
std::string what_is(const std::string& assignment) {
  const case_file::Key* key = case_file::find_key(assignment.substr(0, assignment.find('=')));
  return key ? fmt::format("{}: {}", key->part->name, key->help.substr(0, key->help.rfind('.'))) : "";
}

Part read_part(const TomlEntry& entry) {
  entry.allow_only({"name", "set", "form", "about"});
  auto part = read_named<Part>(entry);
  if (entry.has("set") == entry.has("form")) entry.fail("", "give one of 'set' and 'form'");
  if (entry.has("form"))
    part.form = entry.one_of("form", {Form::rigid_lid, Form::two_dimensions, Form::each_choice});
  if (part.about.empty() && !part.set.empty()) part.about = what_is(part.set.front());
  return part;
}

void require_method(const TomlEntry& entry, std::string_view key, const std::string& name,
                    const std::vector<Method>& methods) {
  if (std::none_of(methods.begin(), methods.end(), [&](const Method& m) { return m.name == name; }))
    entry.fail(key, fmt::format("no [[method]] has the name '{}'", name));
}

Panel read_panel(const TomlEntry& entry, const Chart& chart, const std::vector<Method>& methods) {
  entry.allow_only({"quantity", "window", "against", "method", "record", "formula", "published", "column"});
  Panel panel;
  std::optional<Window> window;
  if (entry.has("window")) window = entry.window("window");
  try {
    panel.quantity = parse_quantity(entry.text("quantity"), window);
  } catch (const std::invalid_argument& error) {
    entry.fail("quantity", error.what());
  }
  panel.against =
      entry.one_of("against", {Against::finest, Against::dem, Against::theory, Against::published});
  const auto only = [&](std::string_view key, Against kind) {
    if (entry.has(key) && panel.against != kind)
      entry.fail(key, fmt::format("only against = \"{}\" has it", name_of(kind)));
    return panel.against == kind;
  };
  if (only("method", Against::finest)) {
    panel.method = entry.has("method") ? entry.text("method") : methods.front().name;
    require_method(entry, "method", panel.method, methods);
    if (std::find(chart.methods.begin(), chart.methods.end(), panel.method) == chart.methods.end())
      entry.fail("method", fmt::format("'{}' is not among the methods of the chart", panel.method));
  }
  if (only("record", Against::dem))
    panel.record = entry.has("record") ? entry.text("record") : chart.case_name;
  if (only("formula", Against::theory)) {
    panel.formula = entry.text("formula");
    if (panel.quantity.is_curve)
      entry.fail("formula", "a formula is the reference of a metric, not of a curve");
    if (!find_formula(panel.formula))
      entry.fail("formula", fmt::format("'{}' given; see checks/theory.cpp", panel.formula));
  }
  only("column", Against::published);
  if (only("published", Against::published)) {
    panel.published = entry.text("published");
    panel.column = entry.text("column");
    if (!panel.quantity.is_curve) entry.fail("published", "a published series is the reference of a curve");
  }
  return panel;
}

Chart read_chart(const TomlEntry& entry, const std::vector<Method>& methods) {
  entry.allow_only({"case", "grids", "set", "methods", "down_to", "panel"});
  Chart chart;
  chart.case_name = entry.text("case");
  chart.grids = entry.positives("grids");
  if (!std::is_sorted(chart.grids.begin(), chart.grids.end(), std::greater_equal<>()))
    entry.fail("grids", "expected cell sizes from large to small, each once");
  if (chart.grids.size() < 2) entry.fail("grids", "a line needs two cell sizes or more");
  if (entry.has("set")) chart.set = entry.assignments("set");
  for (const Method& method : methods) chart.methods.push_back(method.name);
  if (entry.has("methods")) chart.methods = entry.texts("methods");
  for (const std::string& name : chart.methods) require_method(entry, "methods", name, methods);
  chart.down_to = entry.has("down_to") ? entry.positive("down_to") : chart.grids.back();
  for (const TomlEntry& panel : entry.entries("panel"))
    chart.panels.push_back(read_panel(panel, chart, methods));
  if (chart.panels.empty()) entry.fail("", "a chart needs a [[chart.panel]]");
  return chart;
}

Study read_root(const toml::table& root, std::string_view name) {
  const TomlEntry top(root, "study", name);
  top.allow_only({"method", "other", "part", "chart"});
  Study study;
  std::set<std::string> methods, others, parts, charts;
  for (const TomlEntry& entry : top.entries("method")) {
    study.methods.push_back(read_method(entry));
    if (!methods.insert(study.methods.back().name).second)
      entry.fail("name", fmt::format("'{}' is given twice", study.methods.back().name));
  }
  if (study.methods.empty()) top.fail("", "there is no [[method]]");
  for (const TomlEntry& entry : top.entries("other")) {
    study.others.push_back(read_other(entry));
    if (!others.insert(study.others.back().name).second || methods.contains(study.others.back().name))
      entry.fail("name", fmt::format("'{}' is given twice", study.others.back().name));
  }
  for (const TomlEntry& entry : top.entries("part")) {
    study.parts.push_back(read_part(entry));
    if (!parts.insert(study.parts.back().name).second)
      entry.fail("name", fmt::format("'{}' is given twice", study.parts.back().name));
  }
  for (const TomlEntry& entry : top.entries("chart")) {
    study.charts.push_back(read_chart(entry, study.methods));
    if (!charts.insert(study.charts.back().case_name).second)
      entry.fail("case", fmt::format("'{}' has two charts", study.charts.back().case_name));
  }
  return study;
}

}  // namespace

std::string_view name_of(Form form) {
  switch (form) {
    case Form::rigid_lid:
      return "rigid lid";
    case Form::two_dimensions:
      return "two dimensions";
    case Form::each_choice:
      return "each choice";
  }
  return "each choice";
}

std::string_view name_of(Against against) {
  switch (against) {
    case Against::finest:
      return "finest";
    case Against::dem:
      return "DEM";
    case Against::theory:
      return "theory";
    case Against::published:
      return "published";
  }
  return "finest";
}

std::vector<Method> methods_of(const Study& study, const Chart* chart) {
  if (!chart) return study.methods;
  std::vector<Method> shown;
  for (const Method& method : study.methods)
    if (std::find(chart->methods.begin(), chart->methods.end(), method.name) != chart->methods.end())
      shown.push_back(method);
  return shown;
}

std::vector<Method> methods_to_advise(const Study& study, const Chart* chart) {
  std::vector<Method> tried = methods_of(study, chart);
  std::erase_if(tried, [&](const Method& method) {
    const bool of_a_scene =
        std::any_of(method.set.begin(), method.set.end(), [](const std::string& assignment) {
          return !assignment.starts_with("model.") && !assignment.starts_with("numerics.");
        });
    return !method.advise || (!chart && of_a_scene);
  });
  return tried;
}

Study parse_study(std::string_view text, std::string_view name) {
  return read_root(parse_toml(text, name), name);
}

Study read_study(const std::filesystem::path& file) {
  return read_root(parse_toml_file(file), file.string());
}

}  // namespace granvof::compare
