#include "solver/output/stop_signals.hpp"

#include <algorithm>
#include <array>
#include <csignal>

namespace granvof {
namespace {

// The last signal; setting it is the one thing a signal handler may do.
volatile std::sig_atomic_t stop_requested = 0;
void request_stop(int signal) {
  stop_requested = signal;
}

struct NamedSignal {
  int number;
  const char* name;
};
constexpr std::array stopping_signals{NamedSignal{SIGINT, "SIGINT"},   NamedSignal{SIGTERM, "SIGTERM"},
                                      NamedSignal{SIGHUP, "SIGHUP"},   NamedSignal{SIGUSR1, "SIGUSR1"},
                                      NamedSignal{SIGXCPU, "SIGXCPU"}, NamedSignal{SIGPIPE, "SIGPIPE"}};

}  // namespace

void listen_to_stop_signals() {
  stop_requested = 0;
  ::sigset_t wanted;
  ::sigemptyset(&wanted);
  for (const NamedSignal& signal : stopping_signals) ::sigaddset(&wanted, signal.number);
  ::pthread_sigmask(SIG_UNBLOCK, &wanted, nullptr);
  for (const NamedSignal& signal : stopping_signals)
    if (std::signal(signal.number, request_stop) == SIG_IGN && signal.number != SIGPIPE)
      std::signal(signal.number, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

int stop_signal() {
  return stop_requested;
}

std::string stop_reason() {
  const int number = stop_signal();
  if (number == 0) return "";
  const auto* found = std::find_if(stopping_signals.begin(), stopping_signals.end(),
                                   [=](const NamedSignal& s) { return s.number == number; });
  return std::string("stopped by a signal (") + found->name + ")";
}

bool stopped_at_cpu_limit() {
  return stop_requested == SIGXCPU;
}

void throw_if_stopped() {
  if (const std::string reason = stop_reason(); !reason.empty()) throw StopRequested(reason);
}

}  // namespace granvof
