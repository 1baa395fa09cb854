// Which signals a run takes for itself.
#include <csignal>

#include <gtest/gtest.h>

#include "solver/output/stop_signals.hpp"

using granvof::listen_to_stop_signals;
using granvof::stop_reason;
using granvof::stop_signal;

namespace {

volatile std::sig_atomic_t heard_by_another = 0;

}  // namespace

TEST(StopSignals, OneForWhichSomethingElseListensIsLeftToIt) {
  std::signal(SIGPROF, [](int) { heard_by_another = 1; });
  listen_to_stop_signals();
  std::raise(SIGPROF);
  std::signal(SIGPROF, SIG_DFL);
  EXPECT_EQ(heard_by_another, 1);
  EXPECT_EQ(stop_signal(), 0);
}

TEST(StopSignals, OneThatIsIgnoredStaysSoButPipe) {
  std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  listen_to_stop_signals();
  std::raise(SIGHUP);
  EXPECT_EQ(stop_signal(), 0);
  std::raise(SIGPIPE);
  EXPECT_EQ(stop_reason(), "stopped by a signal (SIGPIPE)");
  std::signal(SIGHUP, SIG_DFL);
}

TEST(StopSignals, ListeningAgainForgetsTheLast) {
  listen_to_stop_signals();
  std::raise(SIGUSR2);
  EXPECT_EQ(stop_reason(), "stopped by a signal (SIGUSR2)");
  listen_to_stop_signals();
  EXPECT_EQ(stop_reason(), "");
  std::raise(SIGUSR2);
  EXPECT_EQ(stop_signal(), SIGUSR2);
}
