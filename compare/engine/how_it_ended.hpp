// Kind and message of a run that has ended.
#pragma once

#include <filesystem>
#include <optional>

#include "compare/engine/order.hpp"

namespace granvof::compare {

// Fills kind, message and process of `ending` in. `earlier`: the time of the run.json that was in the
// directory before: one that is still there says nothing of this run.
void note_how_it_ended(Ending& ending, const Ended& process, const Limits& limits,
                       const std::optional<std::filesystem::file_time_type>& earlier);

std::optional<std::filesystem::file_time_type> time_of(const std::filesystem::path& file);

// The log of an order's run.
std::filesystem::path log_of(const std::filesystem::path& directory);

}  // namespace granvof::compare
