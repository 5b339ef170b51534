#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

namespace lightloom {

/// A bar on one line of a terminal, such as "render  12/16 frames  ██████▌   75%  0:12 left", redrawn in place and
/// wiped when the object ends, so that nothing of it mixes with later output. Where the stream is no terminal it writes
/// nothing at all: logs stay clean.
class ProgressBar {
 public:
  using Clock = std::function<std::chrono::steady_clock::time_point()>;

  /// `stream` must outlive the bar. `total` is the number of steps; `unit` names them ("frames").
  ProgressBar(std::ostream& stream, bool is_terminal, std::string task, std::string unit, uint64_t total,
              Clock clock = std::chrono::steady_clock::now);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  /// `done` steps are finished. The line is redrawn at most ten times a second, and for the last step. The time left
  /// comes from the steps since the first call: those before it may have been there already, and what is done once,
  /// such as compiling, is not counted.
  void update(uint64_t done);
  /// The same with what the caller knows of the time left, which is shown instead of an estimate from `done` alone;
  /// where the caller knows nothing yet, none is shown.
  void update(uint64_t done, std::optional<std::chrono::duration<double>> left);

 private:
  [[nodiscard]] bool due(uint64_t done, std::chrono::steady_clock::time_point now) const;
  void draw(uint64_t done, std::optional<std::chrono::duration<double>> left,
            std::chrono::steady_clock::time_point now);

  std::ostream& stream_;
  bool is_terminal_;
  std::string task_;
  std::string unit_;
  uint64_t total_;
  Clock clock_;
  std::chrono::steady_clock::time_point last_draw_;
  bool drawn_ = false;
  /// Of the first call.
  std::optional<uint64_t> first_done_;
  std::chrono::steady_clock::time_point first_time_;
};

/// True if standard error is a terminal that understands cursor control.
[[nodiscard]] bool standard_error_is_terminal();

/// `fraction` (0 to 1) of `width` character cells filled, in eighths of a cell, padded with blanks.
[[nodiscard]] std::string bar_text(double fraction, uint32_t width);

/// "0:07", "12:30", "3:05:00"; whole seconds, rounded up.
[[nodiscard]] std::string duration_text(std::chrono::duration<double> duration);

}  // namespace lightloom
