#include "solver/scene/load_scene.hpp"

#include <fmt/format.h>

#include "solver/scene/case_text.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"

namespace granvof {
namespace {

Scene to_scene(const case_file::CaseText& text, case_file::Draft draft) {
  using case_file::Scope;
  Scene scene = case_file::complete(draft, text);
  scene.file = text.file;
  scene.resolved = case_file::resolved_text(draft);
  scene.hash = case_file::hash_of(draft, {Scope::setup, Scope::model, Scope::reference});
  scene.reference_hash = case_file::hash_of(draft, {Scope::setup, Scope::reference});
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& case_file, std::span<const std::string> overrides) {
  const auto text = case_file::read_case(case_file, overrides);
  const auto draft = case_file::read_draft(text);
  if (draft.scene.name != case_file.stem().string()) {
    case_file::refuse(text, draft, "scene.name",
                      fmt::format("\"{}\", the file's stem", case_file.stem().string()));
  }
  return to_scene(text, draft);
}

Scene parse_scene(std::string_view text, const std::string& label, std::span<const std::string> overrides) {
  const auto read = case_file::read_case_text(text, label, overrides);
  return to_scene(read, case_file::read_draft(read));
}

std::string keys_reference() {
  std::string page = "# Keys of a case file\n";
  for (const case_file::Table& table : case_file::tables()) {
    page += fmt::format("\n## [{}]{}\n{}\n\n", table.name, table.optional ? " (optional)" : "", table.help);
    page += "| key | allowed | default | what |\n|---|---|---|---|\n";
    for (const case_file::Key& key : case_file::keys()) {
      if (!key.documented || key.table() != table.name) continue;
      std::string name = key.name.substr(table.name.size() + 1);
      if (table.name == "walls") name.replace(0, std::min(name.find('.'), name.size()), "SIDE");
      std::string allowed;
      for (const char c : key.allowed) allowed += c == '|' ? "or" : std::string(1, c);
      page += fmt::format("| {} | {} | {} | {} |\n", name, allowed,
                          key.required() ? "required" : key.otherwise, key.help);
    }
  }
  page += case_file::presets_reference();
  page +=
      "\nAt the top level `base = \"other.toml\"` takes over another case, table by table and key by key; "
      "what stands "
      "in the file then replaces it. There, an optional table set to false (`gate = false`) is dropped.\n";
  return page;
}

}  // namespace granvof
