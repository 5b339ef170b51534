#include "framework/base/interrupt.hpp"

#include <gtest/gtest.h>
#include <signal.h>

namespace lightloom {
namespace {

using Handler = void (*)(int);

Handler handler_of(int signal) {
  struct sigaction action {};
  ::sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

TEST(Interrupt, TheFirstSignalIsARequestTheSecondWouldEndTheProcess) {
  EXPECT_EQ(interrupt_signal(), 0);
  {
    const InterruptRequests requests;
    EXPECT_NO_THROW(stop_if_interrupted());
    ::raise(SIGTERM);
    EXPECT_EQ(interrupt_signal(), SIGTERM);
    try {
      stop_if_interrupted();
      ADD_FAILURE() << "it goes on";
    } catch (const Interrupted& interrupted) {
      EXPECT_EQ(interrupted.signal(), SIGTERM);
    }
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) EXPECT_EQ(handler_of(signal), SIG_DFL) << signal_name(signal);
  }
  EXPECT_EQ(interrupt_signal(), 0) << "a request is forgotten with who asks for it";
  EXPECT_EQ(handler_of(SIGINT), SIG_DFL);
}

TEST(Interrupt, TheOuterOneGoesOnAfterAnInnerOne) {
  const InterruptRequests outer;
  { const InterruptRequests inner; }
  ::raise(SIGINT);
  EXPECT_EQ(interrupt_signal(), SIGINT);
}

TEST(Interrupt, IgnoredSignalsStayIgnored) {
  ::signal(SIGHUP, SIG_IGN);
  {
    const InterruptRequests requests;
    ::raise(SIGHUP);
    EXPECT_EQ(interrupt_signal(), 0);
  }
  EXPECT_EQ(handler_of(SIGHUP), SIG_IGN);
  ::signal(SIGHUP, SIG_DFL);
}

TEST(Interrupt, ExitCodesAreThoseOfShells) {
  EXPECT_EQ(static_cast<int>(interrupted_code(SIGINT)), 130);
  EXPECT_EQ(static_cast<int>(interrupted_code(SIGTERM)), 143);
  EXPECT_EQ(signal_name(SIGHUP), "SIGHUP");
}

}  // namespace
}  // namespace lightloom
