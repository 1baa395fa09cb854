// Work that may crash in a library, done by a process of its own.
#pragma once

#include <filesystem>
#include <functional>

namespace granvof {

// Does `work` in a copy of this process, with `directory` as its working directory, and waits for its end;
// true where it returned. False where it threw, crashed, or no process could be made. What it changes in
// memory is lost; descriptors that were open are closed for it, those that a path by a descriptor needs too.
// It does not outlive this process.
bool succeeds_in_own_process(const std::filesystem::path& directory, const std::function<void()>& work);

// Before a process is made whose end is waited for: a caller that ignores SIGCHLD has this process do so too,
// and how the other ended would not be told.
void expect_to_be_told_of_ends();

}  // namespace granvof
