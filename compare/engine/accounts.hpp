// A table of what runs cost: one line a run, added at its end.
#pragma once

#include <filesystem>

#include "compare/engine/order.hpp"

namespace granvof::compare {

// Throws OutputError where `file` is there and is none of these: before the first run, not after it.
void require_accounts(const std::filesystem::path& file);

// Adds a line to a CSV file, which is begun with its header where it is not there. `core_seconds`: of the
// time loop, as run.json says; `cpu_seconds`: of the whole process. Throws OutputError.
void write_account(const std::filesystem::path& file, const Ending& ending);

}  // namespace granvof::compare
