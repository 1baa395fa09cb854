// run.log of a run directory: every message of the run, as on stderr. A resumed run adds to it.
#pragma once

#include <filesystem>

#include <spdlog/common.h>

namespace granvof {

class RunLog {
 public:
  RunLog() = default;
  RunLog(const RunLog&) = delete;
  RunLog& operator=(const RunLog&) = delete;
  ~RunLog();
  // Opens it; what is said from now on goes there too. Throws OutputError where a pipe or a
  // device has its name, or it cannot be opened.
  void open(const std::filesystem::path& directory, bool resumed);

 private:
  spdlog::sink_ptr sink_;
};

}  // namespace granvof
