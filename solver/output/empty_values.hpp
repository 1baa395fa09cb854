// An option that is given nothing: "--out "$OUT"" in a script where OUT is not set. What the program would do
// then is not what was meant.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace granvof {

// From here on every option of `app` and its subcommands that takes a value refuses an empty one.
inline void refuse_empty_values(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    option->check([](const std::string& given) { return given.empty() ? "got \"\", allowed: a value" : ""; });
  }
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    refuse_empty_values(*command);
}

}  // namespace granvof
