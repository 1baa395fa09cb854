#include "compare/engine/order.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "solver/output/json_fault.hpp"

namespace granvof::compare {
namespace {

constexpr std::array keys{"id",    "case",    "set",  "directory", "program",    "threads",
                          "timed", "timings", "keep", "clear",     "wall_limit", "cpu_limit"};

}  // namespace

Order read_order(std::string_view json_line) {
  try {
    const auto json = nlohmann::json::parse(json_line);
    for (const auto& [key, value] : json.items())
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        throw std::invalid_argument(fmt::format("unknown key {}", key));
    Order order;
    order.id = json.at("id");
    order.case_file = json.at("case").get<std::string>();
    order.set = json.value("set", order.set);
    order.directory = json.at("directory").get<std::string>();
    order.program = json.value("program", order.program);
    order.threads = json.value("threads", order.threads);
    order.timed = json.value("timed", order.timed);
    order.timings = json.value("timings", order.timings);
    order.keep = json.value("keep", order.keep);
    order.clear = json.value("clear", order.clear);
    order.limits = {json.value("wall_limit", 0.0), json.value("cpu_limit", 0.0)};
    if (order.directory.empty()) throw std::invalid_argument("directory is empty");
    if (order.threads < 1 || order.timings < 1)
      throw std::invalid_argument("threads and timings are 1 or more");
    if (!(order.limits.wall_seconds >= 0.0 && order.limits.cpu_seconds >= 0.0))
      throw std::invalid_argument("a limit is 0 (none) or more");
    return order;
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(json_fault(error));
  }
}

std::string order_line(const Order& order) {
  nlohmann::ordered_json json{{"id", order.id},
                              {"case", order.case_file.string()},
                              {"set", order.set},
                              {"directory", order.directory.string()}};
  if (!order.program.empty()) json["program"] = order.program;
  if (order.threads != 1) json["threads"] = order.threads;
  if (order.timed) json["timed"] = true;
  if (order.timings != 1) json["timings"] = order.timings;
  if (order.keep) json["keep"] = true;
  if (order.clear) json["clear"] = true;
  if (order.limits.wall_seconds > 0.0) json["wall_limit"] = order.limits.wall_seconds;
  if (order.limits.cpu_seconds > 0.0) json["cpu_limit"] = order.limits.cpu_seconds;
  return json.dump();
}

std::string ending_line(const Ending& ending) {
  const nlohmann::ordered_json json{{"id", ending.id},
                                    {"directory", ending.directory.string()},
                                    {"kind", ending.kind},
                                    {"message", ending.message},
                                    {"code", ending.process.code},
                                    {"wall_seconds", ending.process.wall_seconds},
                                    {"cpu_seconds", ending.process.cpu_seconds},
                                    {"kilobytes", ending.process.kilobytes},
                                    {"core_seconds", ending.core_seconds},
                                    {"work_units", ending.work_units},
                                    {"beside", ending.beside},
                                    {"kept", ending.kept},
                                    {"resumed", ending.resumed}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace granvof::compare
