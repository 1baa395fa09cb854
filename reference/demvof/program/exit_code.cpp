#include "reference/demvof/program/exit_code.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include "solver/output/output_error.hpp"
#include "solver/scene/case_error.hpp"
#include "solver/scene/printable.hpp"

namespace demvof {

namespace {

constexpr int failed = 1, bad_input = 2;
constexpr std::size_t longest_message = 1500;  // bytes; it holds the name of a directory

int say(const std::exception& error, int code) {
  fmt::print(stderr, "demvof: {}\n", granvof::case_file::printable(error.what(), longest_message));
  return code;
}

}  // namespace

int exit_code_of(const std::function<int()>& work) {
  try {
    return work();
  } catch (const granvof::CaseError& error) {  // a line for each fault, made printable where it was found
    fmt::print(stderr, "demvof: {}\n", error.what());
    return bad_input;
  } catch (const granvof::OutputError& error) {
    return say(error, bad_input);
  } catch (const std::filesystem::filesystem_error& error) {
    return say(error, bad_input);
  } catch (const std::exception& error) {
    return say(error, failed);
  }
}

}  // namespace demvof
