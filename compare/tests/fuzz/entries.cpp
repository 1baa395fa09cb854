#include "compare/tests/fuzz/entries.hpp"

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/input/run.hpp"
#include "compare/lay/lay.hpp"
#include "solver/output/checkpoint.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/seal.hpp"
#include "solver/output/series_file.hpp"
#include "solver/plausibility/plausibility.hpp"
#include "solver/scene/cost_estimate.hpp"
#include "solver/scene/load_scene.hpp"
#include "solver/tests/small_tank.hpp"
#include "solver/tests/temporary_directory.hpp"

namespace granvof::fuzz {
namespace {

// A reader took what it must not take, or gave what it must not give.
struct Broken : std::logic_error {
  using std::logic_error::logic_error;
};

void require(bool held, const char* what) {
  if (!held) throw Broken(what);
}

// The bytes as a file; the same file every time.
std::filesystem::path file_of(std::string_view bytes, const char* name) {
  static const test::TemporaryDirectory directory;
  auto path = directory.path() / name;
  std::ofstream(path, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

template <class Read>
void refused_or_read(Read read) {
  try {
    read();
  } catch (const OutputError&) {
    return;  // the file is refused by name
  }
}

std::optional<Scene> read_or_refused(std::string_view text, const char* name) {
  try {
    return parse_scene(text, name);
  } catch (const CaseError&) {
    return std::nullopt;
  }
}

// What is read can be written out in full and read again, to the same scene.
void take_case(std::string_view bytes) {
  const auto scene = read_or_refused(bytes, "fuzz.toml");
  if (!scene) return;
  (void)plausibility(*scene);
  require(estimate_cost(*scene).core_seconds >= 0.0, "a run that gives time back");
  const auto again = read_or_refused(scene->resolved, "resolved.toml");
  require(again && again->resolved == scene->resolved && again->hash == scene->hash,
          "a case that is not what it says in full");
}

void take_series(std::string_view bytes) {
  refused_or_read([&] {
    const Series series = read_series(file_of(bytes, "series.csv"));
    for (const auto& row : series.rows)
      require(row.size() == series.columns.size(), "a row of another length");
    for (const Column& column : series.columns) (void)series.column(column.name);
  });
}

// As they are, and with a seal that is right, so that what is behind it is reached.
std::array<std::string, 2> with_seal(std::string_view bytes) {
  return {std::string(bytes), bytes.ends_with("\n}") ? sealed(bytes) : std::string(bytes)};
}

// As the solver reads it to go on, and as the comparison reads it.
void take_run_json(std::string_view bytes) {
  for (const std::string& text : with_seal(bytes)) {
    const auto file = file_of(text, "run.json");
    refused_or_read([&] { (void)read_existing_run(file); });
    refused_or_read([&] { (void)compare::read_facts(file); });
  }
}

const Scene& small_scene() {
  static const Scene scene = test::small_tank("fuzz", "size = [0.2, 0.1]", 0.05,
                                              "[bed]\nlength = 0.1\nheight = 0.05\nsolid_fraction = 0.57\n",
                                              {"grid.dx=0.05", "time.end=1"});
  return scene;
}

const std::string& whole_checkpoint() {
  static const std::string content = [] {
    const std::vector<double> values{1.0, 2.0, 3.0};
    CheckpointView view;
    view.time = 0.5;
    view.arrays["f_s"] = values;
    view.scalars["dt"] = 1e-3;
    view.counters["steps"] = 7;
    const auto path = file_of("", "whole.h5");
    write_checkpoint(path, small_scene(), view);
    return read_file(path);
  }();
  return content;
}

// The bytes as they are; and as changes (place, place, value) to a whole checkpoint, cut off at the last
// place where one byte is left over. Whatever is changed, it is refused.
void take_checkpoint(std::string_view bytes) {
  refused_or_read([&] { (void)read_checkpoint(file_of(bytes, "checkpoint.h5"), small_scene()); });
  std::string changed = whole_checkpoint();
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  for (std::size_t i = 0; i + 3 <= bytes.size(); i += 3)
    changed[(byte(i) * 256U + byte(i + 1)) % changed.size()] = bytes[i + 2];
  if (bytes.size() % 3 == 1) changed.resize(changed.size() * byte(bytes.size() - 1) / 256U);
  bool taken = true;
  refused_or_read([&] {
    taken = false;
    (void)read_checkpoint(file_of(changed, "changed.h5"), small_scene());
    taken = true;
  });
  require(taken == (changed == whole_checkpoint()), "a damaged checkpoint is taken, or a whole one refused");
}

void take_lay(std::string_view bytes) {
  try {
    const compare::Run theirs = compare::read_their_series(file_of(bytes, "theirs.csv"), small_scene());
    compare::Run ours = theirs;
    ours.interval = 1.0;
    const auto curves = compare::lay(ours, theirs);
    for (const compare::LaidCurve& curve : curves)
      require(!curve.rms || *curve.rms == 0.0, "a series that is not at no distance from itself");
    (void)compare::lay_table(curves, "theirs");
    (void)compare::lay_json(curves, ours, "theirs");
  } catch (const OutputError&) {
    return;
  } catch (const std::invalid_argument&) {
    return;
  }
}

constexpr std::array table{Entry{"case", take_case}, Entry{"series", take_series},
                           Entry{"run-json", take_run_json}, Entry{"checkpoint", take_checkpoint},
                           Entry{"lay", take_lay}};

}  // namespace

std::span<const Entry> entries() {
  return table;
}

const Entry* find_entry(std::string_view name) {
  for (const Entry& entry : table)
    if (entry.name == name) return &entry;
  return nullptr;
}

}  // namespace granvof::fuzz
