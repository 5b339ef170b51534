#include "framework/base/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <string_view>
#include <utility>

namespace lightloom {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

std::atomic<int> requested{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may touch nothing else");
std::array<struct sigaction, kSignals.size()> before;
bool listening = false;

/// Calls only what may be called from a signal handler.
extern "C" void request_stop(int signal) {
  requested.store(signal, std::memory_order_relaxed);
  for (const int next : kSignals) ::signal(next, SIG_DFL);
  constexpr std::string_view kText = "\nstopping as soon as what is done is safe; once more ends it at once\n";
  if (::isatty(STDERR_FILENO) == 0) return;
  // Whether it can be written changes nothing.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText.data(), kText.size());
}

}  // namespace

InterruptRequests::InterruptRequests() : outermost_(!std::exchange(listening, true)) {
  if (!outermost_) return;
  requested = 0;
  struct sigaction action {};
  action.sa_handler = request_stop;
  ::sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (size_t i = 0; i < kSignals.size(); ++i) {
    ::sigaction(kSignals[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
  }
}

InterruptRequests::~InterruptRequests() {
  if (!outermost_) return;
  for (size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &before[i], nullptr);
  requested = 0;
  listening = false;
}

int interrupt_signal() noexcept {
  return requested.load(std::memory_order_relaxed);
}

void stop_if_interrupted() {
  if (const int signal = interrupt_signal(); signal != 0) throw Interrupted(signal);
}

std::string signal_name(int signal) {
  if (signal == SIGINT) return "SIGINT";
  if (signal == SIGTERM) return "SIGTERM";
  if (signal == SIGHUP) return "SIGHUP";
  return "signal " + std::to_string(signal);
}

ExitCode interrupted_code(int signal) {
  return static_cast<ExitCode>(128 + signal);
}

}  // namespace lightloom
