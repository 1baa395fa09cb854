#include "reference/demvof/program/test_directory.hpp"

#include <ctime>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reference/demvof/program/scene_setup.hpp"
#include "reference/demvof/program/scratch_folder.hpp"
#include "reference/demvof/program/watched_work.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/digest.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/stop_signals.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/printable.hpp"

namespace demvof {

namespace {

// From fast flow to below the angle of repose; closer together where the flow stops [degrees].
const std::vector<double> slopes{26, 25,   24, 23,   22, 21,   20.5, 20, 19.5,
                                 19, 18.5, 18, 17.5, 17, 16.5, 16,   15, 14};
constexpr double stage_time = 33.2;  // sqrt(d/g): 0.3 s of beads of 0.8 mm

const std::vector<std::string> columns{
    "time [s]",           "slope [deg]",      "inertial_number [-]", "friction [-]",
    "solid_fraction [-]", "mean_speed [m/s]", "load [Pa]",           "temperature_over_shear [-]"};

std::string series_text(const ChuteResult& result) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const ChutePoint& p : result.points) {
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", p.time, p.slope,
                        p.friction.inertial_number, p.friction.friction, p.solid_fraction, p.mean_speed,
                        p.load, p.temperature);
  }
  return text;
}

granvof::FilesWritten files_of(const ChuteResult& result, const std::string& series) {
  granvof::FilesWritten files;
  files.series.rows = static_cast<std::int64_t>(result.points.size());
  if (!result.points.empty())
    files.series.end = std::stod(fmt::format("{:.6g}", result.points.back().time));  // as it is written
  files.series.columns = columns;
  granvof::Digest digest;
  digest.add(series);
  files.series.sha256 = digest.hex();
  return files;
}

}  // namespace

void require_own_tests(const std::filesystem::path& out, const granvof::Scene& scene,
                       const std::string& sign) {
  namespace fs = std::filesystem;
  if (!fs::exists(out)) return;
  const auto refuse = [&](const std::string& why) {
    throw granvof::OutputError("write to", out, why + "; give an empty or new directory");
  };
  if (!fs::is_directory(out)) refuse("it is no directory");
  if (fs::is_empty(out)) return;
  const auto earlier = granvof::read_existing_run(out / "run.json");
  if (!earlier || granvof::read_file(out / "run.json").find('"' + sign + '"') == std::string::npos)
    refuse("it holds files but no such tests of demvof");
  if (earlier->scene != scene.name) refuse("it holds tests of the scene " + earlier->scene);
}

void check_tests(const granvof::Scene& scene) {
  check_beads(scene);
  if (scene.gravity <= 0.0) {
    throw granvof::CaseError(
        fmt::format("{}: tank.gravity is {}, allowed: > 0, beads on a slope are moved by it",
                    granvof::case_file::printable(scene.file.string(), 1000), scene.gravity));
  }
}

int record_tests(const granvof::Scene& scene, const RecordOptions& options, const std::string& sign,
                 const Tests& tests) {
  check_tests(scene);
  require_own_tests(options.out, scene, sign);
  granvof::listen_to_stop_signals();  // nothing is written before the end, and nothing is then
  const ScratchFolder scratch(options.scratch);
  const WorkEnd done = work_in_own_process([&] { return tests(scene, options, scratch.name()); });
  if (done.code) return *done.code;
  fmt::print(stderr, "demvof: {}: {}\n", scene.name, reason_of(done, scratch.name()));
  return 1;
}

ChuteSettings chute_settings(const granvof::Scene& scene, unsigned seed, const std::string& scratch) {
  ChuteSettings chute;
  const BeadSettings beads = bead_settings(scene, scratch);
  chute.diameter = beads.diameter;
  chute.density = beads.density;
  chute.gravity = beads.gravity;
  chute.dt = beads.dt;
  chute.law = beads.law;
  chute.slopes = slopes;
  chute.stage_time = stage_time * chute.time_unit();
  chute.seed = seed;
  chute.scratch_folder = beads.scratch_folder;
  return chute;
}

FrictionFit fit_of(const ChuteResult& result) {
  std::vector<FrictionPoint> points;
  points.reserve(result.points.size());
  for (const ChutePoint& point : result.points) points.push_back(point.friction);
  return fit_friction(points);
}

Monitors friction_monitors(const ChuteResult& result, const FrictionFit& fit) {
  Monitors monitors{{"beads", static_cast<double>(result.beads)},
                    {"mu_s", fit.law.at_rest},
                    {"mu_s_band", fit.band.at_rest},
                    {"mu_2", fit.law.limit},
                    {"mu_2_band", fit.band.limit},
                    {"I_0", fit.law.scale},
                    {"I_0_band", fit.band.scale},
                    {"fit_rms", fit.rms}};
  if (result.lowest_flow) monitors["lowest_flow_deg"] = *result.lowest_flow;
  if (result.stopped_at) monitors["stopped_at_deg"] = *result.stopped_at;
  if (result.started_at) monitors["started_at_deg"] = *result.started_at;
  return monitors;
}

TestClock::TestClock() : date_(granvof::iso_date_now()) {}

double TestClock::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void write_tests(const granvof::Scene& scene, const RecordOptions& options, const TestClock& clock,
                 const ChuteResult& result, const Monitors& monitors) {
  granvof::RunProgress progress;
  progress.simulated_time = result.duration;
  progress.core_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  progress.wall_seconds = clock.wall_seconds();
  progress.monitors = {monitors.begin(), monitors.end()};
  progress.monitors["seed"] = options.seed;
  std::filesystem::create_directories(options.out);
  const std::string series = series_text(result);
  granvof::write_file_atomically(options.out / "series.csv", series);
  const granvof::RunRecord record{{"demvof", options.command, 1, 1, {}}, clock.date(), {}};
  granvof::write_file_atomically(options.out / "run.json",
                                 granvof::run_record_text(scene, record, progress, files_of(result, series),
                                                          {granvof::ExitState::finished, ""}));
}

}  // namespace demvof
