#include "reference/demvof/program/record_chute.hpp"

#include <chrono>
#include <ctime>

#include <fmt/format.h>

#include "reference/demvof/beads/mpi_session.hpp"
#include "reference/demvof/bulk_friction/chute.hpp"
#include "reference/demvof/program/scene_setup.hpp"
#include "reference/demvof/program/scratch_folder.hpp"
#include "reference/demvof/program/watched_work.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/digest.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"
#include "solver/output/stop_signals.hpp"

namespace demvof {

namespace {

// From fast flow to below the angle of repose; closer together where the flow stops [degrees].
const std::vector<double> slopes{26, 25,   24, 23,   22, 21,   20.5, 20, 19.5,
                                 19, 18.5, 18, 17.5, 17, 16.5, 16,   15, 14};

const std::vector<std::string> columns{"time [s]",     "slope [deg]",        "inertial_number [-]",
                                       "friction [-]", "solid_fraction [-]", "mean_speed [m/s]"};

std::string series_text(const ChuteResult& result) {
  std::string text = fmt::format("{}\n", fmt::join(columns, ","));
  for (const ChutePoint& p : result.points) {
    text += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", p.time, p.slope,
                        p.friction.inertial_number, p.friction.friction, p.solid_fraction, p.mean_speed);
  }
  return text;
}

granvof::FilesWritten files_of(const ChuteResult& result, const std::string& series) {
  granvof::FilesWritten files;
  files.series.rows = static_cast<std::int64_t>(result.points.size());
  if (!result.points.empty()) files.series.end = result.points.back().time;
  files.series.columns = columns;
  granvof::Digest digest;
  digest.add(series);
  files.series.sha256 = digest.hex();
  return files;
}

// Before hours of work: the directory is new or empty, or holds an earlier result of the same scene.
void require_own(const std::filesystem::path& out, const granvof::Scene& scene) {
  namespace fs = std::filesystem;
  if (!fs::exists(out)) return;
  const auto refuse = [&](const std::string& why) {
    throw granvof::OutputError("write to", out, why + "; give an empty or new directory");
  };
  if (!fs::is_directory(out)) refuse("it is no directory");
  if (fs::is_empty(out)) return;
  const auto earlier = granvof::read_existing_run(out / "run.json");
  if (!earlier || granvof::read_file(out / "run.json").find("\"mu_s\"") == std::string::npos)
    refuse("it holds files but no chute of demvof");
  if (earlier->scene != scene.name) refuse("it is a chute of the scene " + earlier->scene);
}

int record_in_this_process(const granvof::Scene& scene, const RecordOptions& options,
                           const ScratchFolder& scratch) {
  const MpiSession session;
  const auto clock = std::chrono::steady_clock::now();
  const std::string date = granvof::iso_date_now();
  ChuteSettings chute;
  const BeadSettings beads = bead_settings(scene, scratch.name().string());
  chute.diameter = beads.diameter;
  chute.density = beads.density;
  chute.gravity = beads.gravity;
  chute.dt = beads.dt;
  chute.law = beads.law;
  chute.slopes = slopes;
  chute.seed = options.seed;
  chute.scratch_folder = beads.scratch_folder;
  const ChuteResult result = run_chute(chute);

  std::vector<FrictionPoint> points;
  points.reserve(result.points.size());
  for (const ChutePoint& point : result.points) points.push_back(point.friction);
  const FrictionFit fit = fit_friction(points);
  granvof::RunProgress progress;
  progress.simulated_time = result.duration;
  progress.core_seconds = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  progress.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock).count();
  progress.monitors = {{"seed", options.seed},    {"beads", static_cast<double>(result.beads)},
                       {"mu_s", fit.law.at_rest}, {"mu_s_band", fit.band.at_rest},
                       {"mu_2", fit.law.limit},   {"mu_2_band", fit.band.limit},
                       {"I_0", fit.law.scale},    {"I_0_band", fit.band.scale},
                       {"fit_rms", fit.rms}};
  if (result.lowest_flow) progress.monitors["lowest_flow_deg"] = *result.lowest_flow;
  if (result.stopped_at) progress.monitors["stopped_at_deg"] = *result.stopped_at;

  std::filesystem::create_directories(options.out);
  const std::string series = series_text(result);
  granvof::write_file_atomically(options.out / "series.csv", series);
  const granvof::RunRecord record{{"demvof", options.command, 1, 1, {}}, date, {}};
  granvof::write_file_atomically(options.out / "run.json",
                                 granvof::run_record_text(scene, record, progress, files_of(result, series),
                                                          {granvof::ExitState::finished, ""}));
  fmt::print("mu_s {:.4f} +- {:.4f}, mu_2 {:.4f} +- {:.4f}, I_0 {:.4f} +- {:.4f}; {} points, rms {:.4f}\n",
             fit.law.at_rest, fit.band.at_rest, fit.law.limit, fit.band.limit, fit.law.scale, fit.band.scale,
             points.size(), fit.rms);
  return 0;
}

}  // namespace

int record_chute(const granvof::Scene& scene, const RecordOptions& options) {
  check_beads(scene);
  require_own(options.out, scene);
  granvof::listen_to_stop_signals();  // nothing is written before the end, and nothing is then
  const ScratchFolder scratch(options.scratch);
  const WorkEnd done = work_in_own_process([&] { return record_in_this_process(scene, options, scratch); });
  if (done.code) return *done.code;
  fmt::print(stderr, "demvof: {}: {}\n", scene.name, reason_of(done, scratch.name()));
  return 1;
}

}  // namespace demvof
