#include "compare/engine/engine.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "compare/engine/accounts.hpp"
#include "compare/engine/how_it_ended.hpp"
#include "compare/engine/made.hpp"
#include "compare/engine/work_unit.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/load_scene.hpp"

namespace granvof::compare {
namespace {

namespace fs = std::filesystem;

// The ending of a run that was made before.
Ending kept(Ending ending) {
  const Note note = read_note(ending.directory).value();
  ending.kind = note.kind;
  ending.message = note.message;
  ending.core_seconds = note.core_seconds;
  ending.work_units = note.work_units;
  ending.kept = true;
  return ending;
}

void require_program(const fs::path& program) {
  if (::access(program.c_str(), X_OK) != 0)
    throw std::runtime_error(fmt::format("{} is missing; `make build` builds it", program.string()));
}

}  // namespace

std::string identity_of_program(const fs::path& program, const std::string& version) {
  if (version.find("-dirty") == std::string::npos && version.find('(') != std::string::npos) return version;
  return version + fmt::format(" {} {}", fs::file_size(program),
                               fs::last_write_time(program).time_since_epoch().count());
}

Engine::Engine(EngineOptions options) : options_(std::move(options)) {
  require_program(options_.program.at(0));
  if (!options_.accounts.empty()) require_accounts(options_.accounts);
}

std::vector<std::string> Engine::running() const {
  std::vector<std::string> ids;
  for (const Active& active : active_) ids.push_back(active.order.id);
  return ids;
}

const std::vector<std::string>& Engine::program_of(const Order& order) const {
  return order.program.empty() ? options_.program : order.program;
}

const std::string& Engine::identity_of(const Order& order) {
  const std::string& program = program_of(order).back();
  for (const auto& [known, identity] : identities_)
    if (known == program) return identity;
  return identities_.emplace_back(program, identity_of_program(program, version_of(program))).second;
}

bool Engine::may_start(const Order& order) const {
  const bool alone =
      std::any_of(active_.begin(), active_.end(), [](const Active& a) { return a.order.timed; });
  if (order.timed) return active_.empty();
  return !alone && static_cast<int>(active_.size()) < options_.at_a_time;
}

std::optional<Ending> Engine::start(Order order) {
  Ending ending;
  ending.id = order.id;
  ending.directory = order.directory;
  Active active{std::move(order), std::nullopt, std::move(ending), {}, std::nullopt};
  const Order& wanted = active.order;
  if (wanted.keep) {
    try {
      active.resolved = load_scene(wanted.case_file, wanted.set).resolved;
    } catch (const CaseError& error) {
      active.ending.kind = ending::bad_input;
      active.ending.message = error.what();
      return active.ending;
    }
    const std::string& program = identity_of(wanted);
    if (is_made(wanted.directory, program, active.resolved, wanted.limits)) return kept(active.ending);
    active.ending.resumed = !wanted.timed && can_be_gone_on_with(wanted.directory, program, active.resolved);
  }
  try {
    if (wanted.clear && !active.ending.resumed) clear_made(wanted.directory);
    if (wanted.directory.has_parent_path()) fs::create_directories(wanted.directory.parent_path());
    forget_note(wanted.directory);
  } catch (const std::exception& error) {  // of what is in the way
    active.ending.kind = ending::bad_input;
    active.ending.message = error.what();
    return active.ending;
  }
  launch(active);
  active_.push_back(std::move(active));
  const int beside = static_cast<int>(active_.size()) - 1;
  for (Active& one : active_) one.ending.beside = std::max(one.ending.beside, beside);
  return std::nullopt;
}

void Engine::launch(Active& active) const {
  const Order& order = active.order;
  std::vector<std::string> command = program_of(order);
  for (const std::string& word :
       {std::string("run"), order.case_file.string(), std::string("--out"), order.directory.string(),
        std::string("--threads"), std::to_string(order.threads),
        std::string(active.ending.resumed ? "--resume" : "--force")})
    command.push_back(word);
  for (const std::string& assignment : order.set) {
    command.emplace_back("--set");
    command.push_back(assignment);
  }
  active.earlier = time_of(order.directory / "run.json");
  if (order.timed) active.ending.work_units.push_back(work_unit_seconds());
  active.child.emplace(command, log_of(order.directory), order.limits);
}

// Whether a timed run is to be made once more.
bool Engine::again(Active& active) const {
  const Order& order = active.order;
  if (!order.timed) return false;
  Ending& ending = active.ending;
  ending.work_units.push_back(work_unit_seconds());
  ending.core_seconds.push_back(core_seconds_of(ending.directory).value_or(0.0));
  return ending.finished() && static_cast<int>(ending.core_seconds.size()) < order.timings &&
         ending.core_seconds.back() < cheap_run;
}

std::optional<Ending> Engine::look() {
  for (auto active = active_.begin(); active != active_.end(); ++active) {
    const auto process = active->child->poll();
    if (!process) continue;
    note_how_it_ended(active->ending, *process, active->order.limits, active->earlier);
    if (again(*active)) {
      active->child.reset();
      active->ending.resumed = false;
      launch(*active);
      continue;
    }
    if (active->order.keep) remember(*active);
    Ending ending = std::move(active->ending);
    active_.erase(active);
    account(ending);
    return ending;
  }
  // Those beside each other first: one that goes alone waits for an empty machine.
  for (const bool timed : {false, true})
    for (auto order = waiting_.begin(); order != waiting_.end(); ++order) {
      if (order->timed != timed) continue;
      if (!may_start(*order)) break;
      Order next = std::move(*order);
      order = waiting_.erase(order);
      if (auto ending = start(std::move(next))) return ending;
      return std::nullopt;
    }
  return std::nullopt;
}

void Engine::remember(const Active& active) {
  const Order& order = active.order;
  const Ending& ended = active.ending;
  if (order.clear)
    fs::create_directories(order.directory);  // a run that was ended at once has not made it
  else if (!fs::exists(order.directory / "run.json"))
    return;  // a note alone would make it a directory of somebody else's
  write_note(order.directory, {identity_of(order), short_hash(active.resolved), order.set, ended.kind,
                               ended.message, order.limits, ended.core_seconds, ended.work_units});
}

Ending Engine::wait() {
  for (;;) {
    const std::size_t before = waiting_.size();
    if (auto ending = look()) return *std::move(ending);
    if (waiting_.size() == before) std::this_thread::sleep_for(between_looks);
  }
}

Ending Engine::make(const Order& order) {
  submit(order);
  return wait();
}

void Engine::account(const Ending& ending) const {
  if (!options_.accounts.empty()) write_account(options_.accounts, ending);
}

}  // namespace granvof::compare
