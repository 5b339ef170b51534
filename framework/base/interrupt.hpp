#pragma once

#include <exception>
#include <string>

#include "framework/base/error.hpp"

namespace lightloom {

/// Somebody asked the process to stop. No `Error`, so that what handles failures one by one does not take it for one of
/// them.
class Interrupted : public std::exception {
 public:
  explicit Interrupted(int signal) : signal_(signal) {}
  [[nodiscard]] const char* what() const noexcept override { return "interrupted"; }
  [[nodiscard]] int signal() const { return signal_; }

 private:
  int signal_;
};

/// As long as one of these is there, the first SIGINT, SIGTERM or SIGHUP is a request to stop, which long work asks
/// for; another one ends the process at once, as ever. Signals that were ignored stay so. Not for two threads at a
/// time.
class InterruptRequests {
 public:
  InterruptRequests();
  InterruptRequests(const InterruptRequests&) = delete;
  InterruptRequests& operator=(const InterruptRequests&) = delete;
  /// Signals do what they did before; a request that nobody answered is forgotten.
  ~InterruptRequests();

 private:
  const bool outermost_;
};

/// The signal by which a stop was requested; 0: none. From any thread.
[[nodiscard]] int interrupt_signal() noexcept;
/// Throws Interrupted where a stop was requested. Cheap enough for inner loops.
void stop_if_interrupted();

/// "SIGINT" …
[[nodiscard]] std::string signal_name(int signal);
/// 128 + signal, as shells have it.
[[nodiscard]] ExitCode interrupted_code(int signal);

}  // namespace lightloom
