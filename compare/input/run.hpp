// One run directory (series.csv, fields.h5, run.json), read for comparison together with its scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compare/input/evidence.hpp"
#include "compare/metrics/curve.hpp"
#include "solver/output/cell_fields.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/series_file.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::compare {

// What run.json states; a number that is missing or null there is absent from `numbers`.
struct RunFacts {
  std::string scene, version, commit, case_hash, resolved_case, host, date;
  std::string exit, reason;               // "finished", "failed", ... and why
  std::string kind;                       // exit.kind; of earlier versions, what follows from the state
  std::map<std::string, double> numbers;  // core_seconds, cells, steps, ... and the program's monitors
  std::vector<LedgerTerm> ledger;         // of its energy; empty: it states none
  std::optional<Grid3> grid;
  std::optional<StatedFiles> files;  // nothing: made by an earlier version
  bool sealed = false;               // it carries its own digest, and that is right (solver/output/seal.hpp)

  std::optional<double> number(std::string_view name) const;
};

struct Run {
  std::string id;
  std::filesystem::path directory;
  Scene scene;
  RunFacts facts;
  Series series;
  double interval = 0.0;  // between rows of the series [s]; 0: unknown

  // The defined samples of a column against time [s]; empty if there is no such column. It has a gap wherever
  // a value is undefined.
  Curve curve(std::string_view column) const;
  // Times [s] of the instants in fields.h5; empty without one.
  std::vector<double> field_times() const;
  // Solid fraction (alone) of the instant `time` [s], if the run wrote one within 1e-6 of its length.
  std::optional<CellFields> solid_fraction_at(double time) const;
};

// Why a run cannot be compared.
enum class RunState {
  usable,
  missing,  // no such directory
  failed,   // it did not reach its end
  refused,  // damaged, or a value in it is not finite
  stale     // it belongs to another state of its case
};

std::string_view name_of(RunState state);

inline constexpr std::size_t longest_reason = 1000;  // bytes: it may quote what a damaged file holds

struct LoadedRun {
  RunState state = RunState::missing;
  std::filesystem::path directory;
  std::string reason;             // empty when usable
  std::optional<RunFacts> facts;  // where run.json could be read
  std::optional<Run> run;         // set when usable
};

// Reads a run and checks it: it ended, it holds no NaN, its case is the one of `scene`, and its files are
// those that were written (evidence.hpp). Never throws for what the directory holds.
LoadedRun load_run(const std::filesystem::path& directory, std::string_view id, const Scene& scene);

// Reads series.csv and checks it and fields.h5 against what `facts` say of them. Throws OutputError.
Series read_evidence(const std::filesystem::path& directory, const RunFacts& facts, const Asked& asked);

// Reads run.json (or a record's record.json). Throws OutputError, also where a value is of the wrong type or
// the file's own digest is another.
RunFacts read_facts(const std::filesystem::path& json_file);

}  // namespace granvof::compare
