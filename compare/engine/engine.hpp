// The run engine: everything that makes runs of granvof makes them here (verify, ablate, advise, charts, the
// stability map, sweeps, measurements of cost). docs/run-engine.md says why it is not a workflow engine.
//
// Two lanes: runs that are made for their results go beside each other, as many as are asked for; a run that
// is made for its cost goes alone. How a run ended is what its run.json says under exit.kind, and where it
// could not say anything, how its process ended; messages are for people.
#pragma once

#include <deque>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/order.hpp"

namespace granvof::compare {

struct EngineOptions {
  std::vector<std::string> program;  // granvof: words before "run CASE"
  int at_a_time = 1;                 // runs beside each other, one thread each
  std::filesystem::path accounts;    // a line a run: what it cost; empty: none
};

class Engine {
 public:
  // Throws std::runtime_error where a program is missing.
  explicit Engine(EngineOptions options);

  void submit(Order order) { waiting_.push_back(std::move(order)); }
  bool idle() const { return waiting_.empty() && active_.empty(); }
  std::vector<std::string> running() const;  // ids

  // Starts what may start, and gives back a run that has ended; nothing where none has. Never waits, but for
  // work units of a timed run. Throws std::runtime_error where the program cannot be started.
  std::optional<Ending> look();
  // Until one has ended. idle() must be false.
  Ending wait();
  // One order alone.
  Ending make(const Order& order);

 private:
  struct Active {
    Order order;
    std::optional<Child> child;
    Ending ending;
    std::string resolved;                                    // the case in full; of an order that is kept
    std::optional<std::filesystem::file_time_type> earlier;  // run.json that was there before
  };

  bool may_start(const Order& order) const;
  std::optional<Ending> start(Order order);
  void launch(Active& active) const;
  bool again(Active& active) const;
  void remember(const Active& active);
  void account(const Ending& ending) const;
  const std::vector<std::string>& program_of(const Order& order) const;
  const std::string& identity_of(const Order& order);

  EngineOptions options_;
  std::deque<Order> waiting_;
  std::list<Active> active_;
  std::vector<std::pair<std::string, std::string>> identities_;  // of programs
};

// Of a program: its version, and its size and time where that does not say which build it is.
std::string identity_of_program(const std::filesystem::path& program, const std::string& version);

}  // namespace granvof::compare
