#include "solver/scene/load_scene.hpp"

#include <fmt/format.h>

#include "solver/scene/case_text.hpp"
#include "solver/scene/complete.hpp"
#include "solver/scene/keys.hpp"
#include "solver/scene/presets.hpp"
#include "solver/scene/printable.hpp"

namespace granvof {
namespace {

Scene to_scene(const case_file::CaseText& text, case_file::Draft draft, case_file::Faults& faults) {
  using case_file::Scope;
  Scene scene = case_file::complete(draft, text, faults);
  scene.file = text.file;
  scene.resolved = case_file::resolved_text(draft);
  scene.hash = case_file::hash_of(draft, {Scope::setup, Scope::model, Scope::reference});
  scene.reference_hash = case_file::hash_of(draft, {Scope::setup, Scope::reference});
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& case_file, std::span<const std::string> overrides) {
  const auto text = case_file::read_case(case_file, overrides);
  case_file::Faults faults;
  const auto draft = case_file::read_draft(text, faults);
  const std::string stem = case_file.stem().string();
  if (draft.scene.name != stem && !faults.touch("scene.name")) {
    faults.add(case_file::fault_of(
        text, draft, "scene.name",
        fmt::format("\"{}\", the file's stem", case_file::printable(stem, case_file::longest_scene_name))));
  }
  return to_scene(text, draft, faults);
}

Scene parse_scene(std::string_view text, const std::string& label, std::span<const std::string> overrides) {
  const auto read = case_file::read_case_text(text, label, overrides);
  case_file::Faults faults;
  const auto draft = case_file::read_draft(read, faults);
  return to_scene(read, draft, faults);
}

std::string keys_reference() {
  std::string page = "# Keys of a case file\n";
  for (const case_file::Table& table : case_file::tables()) {
    page += fmt::format("\n## [{}]{}\n{}\n\n", table.name, table.optional ? " (optional)" : "", table.help);
    page += "| key | allowed | default | part | what |\n|---|---|---|---|---|\n";
    for (const case_file::Key& key : case_file::keys()) {
      if (!key.documented || key.table() != table.name) continue;
      std::string name = key.name.substr(table.name.size() + 1);
      if (table.name == "walls") name.replace(0, std::min(name.find('.'), name.size()), "SIDE");
      std::string allowed;
      for (const char c : key.allowed) allowed += c == '|' ? "or" : std::string(1, c);
      page += fmt::format("| {} | {} | {} | {} | {} |\n", name, allowed,
                          key.required() ? "required" : key.otherwise, key.part->name, key.help);
    }
  }
  page += "\n## Parts\nWhose the keys are.\n\n| part | equations | described in |\n|---|---|---|\n";
  for (const Part* part : all_parts())
    page += fmt::format("| {} | {} | {} |\n", part->name, text_of_equations(part->equations), part->page);
  page += case_file::presets_reference();
  page +=
      "\nAt the top level `base = \"other.toml\"` takes over another case, table by table and key by key; "
      "what stands "
      "in the file then replaces it. A list, `base = [\"other.toml\", \"beads.toml\"]`, takes over one after "
      "the "
      "other; one of them may hold a few keys alone, such as a material. An optional table set to false "
      "(`gate = "
      "false`) is dropped.\n";
  return page;
}

}  // namespace granvof
