// From a draft to a scene: fills in what depends on other keys, and refuses what does not fit together.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/case_text.hpp"
#include "solver/scene/draft.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::case_file {

// Checks and applies every entry to a fresh draft: unknown keys, types, ranges, missing keys. Throws
// CaseError.
Draft read_draft(const CaseText& text);

// Fills in the draft's open values (afterwards the draft is what the resolved case prints) and builds the
// scene, all but its file, resolved text and hashes. Throws CaseError.
Scene complete(Draft& draft, const CaseText& text);

// Canonical text of a completed draft, and the hash of its keys in the given scopes.
std::string resolved_text(const Draft& draft);
std::string hash_of(const Draft& draft, const std::vector<Scope>& scopes);

// Refuses the value of a key: throws CaseError with its place, its value and what is allowed.
[[noreturn]] void refuse(const CaseText& text, const Draft& draft, const std::string& name,
                         const std::string& allowed);

}  // namespace granvof::case_file
