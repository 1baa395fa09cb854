#include "solver/run/run_log.hpp"

#include <memory>
#include <vector>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include "solver/output/atomic_file.hpp"
#include "solver/output/output_error.hpp"

namespace granvof {

void RunLog::open(const std::filesystem::path& directory, bool resumed) {
  const auto file = directory / "run.log";
  require_file(file, "write");
  try {
    sink_ = std::make_shared<spdlog::sinks::basic_file_sink_st>(file.string(), !resumed);
  } catch (const spdlog::spdlog_ex& error) {
    throw OutputError("write", file, error.what());
  }
  spdlog::default_logger()->sinks().push_back(sink_);
  spdlog::default_logger()->flush_on(spdlog::level::info);
}

RunLog::~RunLog() {
  std::erase(spdlog::default_logger()->sinks(), sink_);
}

}  // namespace granvof
