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
// All that would end the program but for those that tell of a fault in it, and KILL.
constexpr std::array stopping_signals{
    NamedSignal{SIGINT, "SIGINT"},   NamedSignal{SIGTERM, "SIGTERM"},     NamedSignal{SIGHUP, "SIGHUP"},
    NamedSignal{SIGQUIT, "SIGQUIT"}, NamedSignal{SIGUSR1, "SIGUSR1"},     NamedSignal{SIGUSR2, "SIGUSR2"},
    NamedSignal{SIGXCPU, "SIGXCPU"}, NamedSignal{SIGPIPE, "SIGPIPE"},     NamedSignal{SIGALRM, "SIGALRM"},
    NamedSignal{SIGPROF, "SIGPROF"}, NamedSignal{SIGPOLL, "SIGPOLL"},     NamedSignal{SIGVTALRM, "SIGVTALRM"},
#ifdef SIGPWR  // of Linux
    NamedSignal{SIGPWR, "SIGPWR"},   NamedSignal{SIGSTKFLT, "SIGSTKFLT"},
#endif
};

using Handler = void (*)(int);

// What is done at a signal now.
Handler handler_of(int signal) {
  struct sigaction now {};
  return ::sigaction(signal, nullptr, &now) == 0 ? now.sa_handler : SIG_DFL;
}

}  // namespace

void listen_to_stop_signals() {
  stop_requested = 0;
  ::sigset_t wanted;
  ::sigemptyset(&wanted);
  for (const NamedSignal& signal : stopping_signals) {
    const bool is_free = handler_of(signal.number) == SIG_DFL || signal.number == SIGPIPE;
    if (is_free) std::signal(signal.number, request_stop);
    if (handler_of(signal.number) == request_stop) ::sigaddset(&wanted, signal.number);
  }
  ::pthread_sigmask(SIG_UNBLOCK, &wanted, nullptr);
}

int stop_signal() {
  return stop_requested;
}

std::string stop_reason(int number) {
  if (number == 0) return "";
  const auto* found = std::find_if(stopping_signals.begin(), stopping_signals.end(),
                                   [=](const NamedSignal& s) { return s.number == number; });
  return std::string("stopped by a signal (") + found->name + ")";
}

void throw_if_stopped() {
  if (const std::string reason = stop_reason(); !reason.empty()) throw StopRequested(reason);
}

}  // namespace granvof
