#include "solver/run/run_log.hpp"

#include <memory>
#include <vector>

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

namespace granvof {

void RunLog::open(const std::filesystem::path& directory, bool resumed) {
  sink_ = std::make_shared<spdlog::sinks::basic_file_sink_st>((directory / "run.log").string(), !resumed);
  spdlog::default_logger()->sinks().push_back(sink_);
  spdlog::default_logger()->flush_on(spdlog::level::info);
}

RunLog::~RunLog() {
  std::erase(spdlog::default_logger()->sinks(), sink_);
}

}  // namespace granvof
