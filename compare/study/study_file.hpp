// Reads compare/study.toml: methods, model parts and charts, as data. Its head describes the format.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/study/quantity.hpp"

namespace granvof::compare {

struct Method {
  std::string name;
  std::vector<std::string> set;  // overrides "key=value"; empty: the case as it is
  std::string about;
  // On this many of the largest cells only, for a method that is too dear on the others; nothing: on all.
  std::optional<std::size_t> grids = std::nullopt;
  // It solves other equations than the first method: our own finest grid is no reference for it.
  bool other_model = false;
  // Whether `advise` tries it: not what costs many times the others.
  bool advise = true;
  std::string preset =
      {};  // the preset that it makes in the scene at hand, where one looked (advise_scene.hpp)
};

// Another program's runs, or the reference's at another resolution, as points of the charts.
struct Other {
  std::string name;
  std::string records;           // below reference/results: RECORDS/CASE/, empty: CASE/
  std::vector<std::string> set;  // overrides of the case that these runs had
  std::string about;
  std::string line;  // the points of one line are joined; empty: a point by itself
};

// Overrides that depend on the scene; `each_choice` stands for a part a choice beside the paper's model.
enum class Form { rigid_lid, two_dimensions, each_choice };

struct Part {
  std::string name;
  std::vector<std::string> set;
  std::optional<Form> form;  // instead of `set`
  std::string about;
};

enum class Against { finest, dem, theory, published };

struct Panel {
  Quantity quantity;
  Against against = Against::finest;
  std::string method;   // finest: whose run on the smallest cell is the reference
  std::string record;   // dem: name in reference/results
  std::string formula;  // theory: name in checks/theory.hpp
  std::string published, column;
};

struct Chart {
  std::string case_name;
  std::vector<double> grids;         // cell sizes [m], descending
  std::vector<std::string> set;      // of all runs
  std::vector<std::string> methods;  // names of those that are shown
  double down_to = 0.0;              // smallest cell of the methods that are no reference [m]
  std::vector<Panel> panels;
};

struct Study {
  std::vector<Method> methods;
  std::vector<Other> others;
  std::vector<Part> parts;
  std::vector<Chart> charts;
};

// Those of `chart`, in the study's order; all without one.
std::vector<Method> methods_of(const Study& study, const Chart* chart);
// The same for `advise`: without those it does not try, and without a chart only those that leave the scene's
// own tank, grains and bed as they are.
std::vector<Method> methods_to_advise(const Study& study, const Chart* chart);

std::string_view name_of(Form form);
std::string_view name_of(Against against);

// Throw TableError, as checks/table.hpp does; `name` stands for the file in messages.
Study read_study(const std::filesystem::path& file);
Study parse_study(std::string_view text, std::string_view name);

}  // namespace granvof::compare
