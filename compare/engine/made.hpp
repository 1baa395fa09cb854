// What was made before: a note beside run.json of what run it is of, by which program, how it ended and what
// it cost.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/order.hpp"

namespace granvof::compare {

struct Note {
  std::string program;    // its identity (engine.hpp)
  std::string case_hash;  // of the case in full
  std::vector<std::string> set;
  std::string kind, message;
  Limits limits;  // that it was made under
  std::vector<double> core_seconds, work_units;
};

// Nothing where there is none, or it is damaged.
std::optional<Note> read_note(const std::filesystem::path& directory);
void write_note(const std::filesystem::path& directory, const Note& note);
void forget_note(const std::filesystem::path& directory);  // what is there and no note stays

// Removes a run, whole or not, and its note. Throws std::runtime_error where there is anything else: then all
// stays.
void clear_made(const std::filesystem::path& directory);

// What would be made is there: of this program, case and limits it would end as it did. What somebody
// stopped, what crashed or could not write is not; nor what ended at a limit shorter than `limits`.
bool is_made(const std::filesystem::path& directory, const std::string& program,
             const std::string& resolved_case, const Limits& limits);
// Whether it holds a run that was cut short, by the same version of the program (with all that it was made of
// under version control), and has a checkpoint.
bool can_be_gone_on_with(const std::filesystem::path& directory, const std::string& program,
                         const std::string& resolved_case);

// CPU time of the time loop that run.json states [s]; nothing where it states none.
std::optional<double> core_seconds_of(const std::filesystem::path& directory);

// FNV-1a: names a directory or a case; not safe against intent.
std::string short_hash(std::string_view text);

}  // namespace granvof::compare
