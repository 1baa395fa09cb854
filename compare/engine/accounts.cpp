#include "compare/engine/accounts.hpp"

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "compare/engine/made.hpp"
#include "solver/output/atomic_file.hpp"
#include "solver/output/host_facts.hpp"
#include "solver/output/output_error.hpp"
#include "solver/output/run_record.hpp"

namespace granvof::compare {
namespace {

constexpr std::string_view header =
    "date,run,kind,core_seconds [s],cpu_seconds [s],wall_seconds [s],memory [kB],beside [-],host\n";

}  // namespace

void require_accounts(const std::filesystem::path& file) {
  require_own_file(file, header.substr(0, header.find('[')));
}

void write_account(const std::filesystem::path& file, const Ending& ending) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  if (!out.valid()) throw OutputError("write", file, std::generic_category().message(errno));
  // Tasks of a job array write the same; a file system without locks goes without.
  ::flock(out.get(), LOCK_EX);
  std::string lines;
  if (::lseek(out.get(), 0, SEEK_END) == 0) lines = header;
  std::string host = host_facts().cpu_model;
  std::replace(host.begin(), host.end(), ',', ' ');
  lines += fmt::format("{},{},{},{:.6g},{:.6g},{:.6g},{},{},{}\n", iso_date_now(), ending.id, ending.kind,
                       core_seconds_of(ending.directory).value_or(0.0), ending.process.cpu_seconds,
                       ending.process.wall_seconds, ending.process.kilobytes, ending.beside, host);
  write_all(out, lines, file);
}

}  // namespace granvof::compare
