#include <exception>
#include <optional>

#include <fcntl.h>
#include <unistd.h>

#include "solver/parallel/processes.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/fnv1a.hpp"

namespace granvof {

Scene load_alike(const Communicator& processes, const std::function<Scene()>& load) {
  std::optional<Scene> scene;
  std::exception_ptr fault;
  try {
    scene = load();
  } catch (...) {
    fault = std::current_exception();
  }
  // The halves of the text's hash are numbers without rounding; the largest of a number and of its opposite
  // are those of all.
  const std::uint64_t hash = scene ? fnv1a(scene->resolved) : 0;
  const double low = static_cast<double>(hash & 0xffffffffU), high = static_cast<double>(hash >> 32);
  std::array<double, 5> all{fault ? 1.0 : 0.0, low, -low, high, -high};
  processes.max(all);
  if (fault) std::rethrow_exception(fault);
  if (all[0] != 0.0) throw CaseError("granvof: another process cannot read the case that this one reads");
  if (all[1] != -all[2] || all[3] != -all[4])
    throw CaseError("granvof: the processes read different cases under the same name");
  return *std::move(scene);
}

void keep_silent() {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere < 0) return;
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
  ::close(nowhere);
}

}  // namespace granvof
