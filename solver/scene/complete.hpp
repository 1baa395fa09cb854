// From a draft to a scene: fills in what depends on other keys, and refuses what does not fit together.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/case_text.hpp"
#include "solver/scene/draft.hpp"
#include "solver/scene/faults.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/scene.hpp"

namespace granvof::case_file {

// Checks and applies every entry to a fresh draft: unknown keys, types, ranges, missing keys. What is wrong
// is added to the faults; the draft's value of such a key means nothing.
Draft read_draft(const CaseText& text, Faults& faults);

// Fills in the draft's open values (afterwards the draft is what the resolved case prints) and builds the
// scene, all but its file, resolved text and hashes. Throws CaseError for these faults and all it finds.
Scene complete(Draft& draft, const CaseText& text, Faults& faults);

// Canonical text of a completed draft, and the hash of its keys in the given scopes, of those of the list.
std::string resolved_text(const Draft& draft);
std::string hash_of(const Draft& draft, const std::vector<Scope>& scopes,
                    const std::vector<Key>& of = keys());

}  // namespace granvof::case_file
