#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace lightloom {

/// Exit status of the command line program.
enum class ExitCode : int { done = 0, run_failed = 1, usage = 2, invalid_input = 3, no_device = 4 };

/// The one exception type of the framework; caught in `main`, where `code` becomes the exit status.
/// `what()` is one sentence that names the place and what was expected; `hint` (may be empty) says what to do.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& sentence, std::string hint = {})
      : std::runtime_error(sentence), code_(code), hint_(std::move(hint)) {}
  [[nodiscard]] ExitCode code() const { return code_; }
  [[nodiscard]] const std::string& hint() const { return hint_; }

 private:
  ExitCode code_;
  std::string hint_;
};

}  // namespace lightloom
