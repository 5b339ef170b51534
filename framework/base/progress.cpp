#include "framework/base/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string_view>
#include <utility>

namespace lightloom {
namespace {

constexpr uint32_t kBarCells = 20;
constexpr std::chrono::milliseconds kRedrawInterval{100};
/// Back to the first column, and erase to the end of the line.
constexpr std::string_view kWipe = "\r\x1b[K";

std::string two_digits(int64_t number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

}  // namespace

ProgressBar::ProgressBar(std::ostream& stream, bool is_terminal, std::string task, std::string unit, uint64_t total,
                         Clock clock)
    : stream_(stream),
      is_terminal_(is_terminal),
      task_(std::move(task)),
      unit_(std::move(unit)),
      total_(std::max<uint64_t>(total, 1)),
      clock_(std::move(clock)),
      last_draw_(clock_()) {
  if (is_terminal_) draw(0, std::nullopt, last_draw_);
}

ProgressBar::~ProgressBar() {
  if (drawn_) stream_ << kWipe << std::flush;
}

void ProgressBar::update(uint64_t done) {
  const auto now = clock_();
  done = std::min(done, total_);
  if (!first_done_) {
    first_done_ = done;
    first_time_ = now;
  }
  if (!due(done, now)) return;
  std::optional<std::chrono::duration<double>> left;
  if (done > *first_done_)
    left = std::chrono::duration<double>(now - first_time_) *
           (static_cast<double>(total_ - done) / static_cast<double>(done - *first_done_));
  draw(done, left, now);
}

void ProgressBar::update(uint64_t done, std::optional<std::chrono::duration<double>> left) {
  const auto now = clock_();
  if (due(done, now)) draw(std::min(done, total_), left, now);
}

bool ProgressBar::due(uint64_t done, std::chrono::steady_clock::time_point now) const {
  return is_terminal_ && (done >= total_ || now - last_draw_ >= kRedrawInterval);
}

void ProgressBar::draw(uint64_t done, std::optional<std::chrono::duration<double>> left,
                       std::chrono::steady_clock::time_point now) {
  const double fraction = static_cast<double>(done) / static_cast<double>(total_);
  stream_ << kWipe << task_ << "  " << done << '/' << total_ << ' ' << unit_ << "  " << bar_text(fraction, kBarCells)
          << "  " << std::lround(std::floor(fraction * 100)) << '%';
  if (left && done < total_) stream_ << "  " << duration_text(*left) << " left";
  stream_ << std::flush;
  last_draw_ = now;
  drawn_ = true;
}

bool standard_error_is_terminal() {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return !dumb && isatty(STDERR_FILENO) != 0;
}

std::string bar_text(double fraction, uint32_t width) {
  constexpr std::array<std::string_view, 8> kEighths = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  const double clamped = std::clamp(fraction, 0.0, 1.0);
  const auto eighths = static_cast<uint32_t>(std::floor(clamped * width * 8));
  std::string text;
  for (uint32_t cell = 0; cell < width; ++cell) {
    const uint32_t filled = eighths > cell * 8 ? eighths - cell * 8 : 0;
    text += filled >= 8 ? std::string_view("█") : kEighths[filled];
  }
  return text;
}

std::string duration_text(std::chrono::duration<double> duration) {
  const auto seconds = static_cast<int64_t>(std::ceil(std::max(duration.count(), 0.0)));
  const int64_t minutes = seconds / 60;
  if (minutes < 60) return std::to_string(minutes) + ":" + two_digits(seconds % 60);
  return std::to_string(minutes / 60) + ":" + two_digits(minutes % 60) + ":" + two_digits(seconds % 60);
}

}  // namespace lightloom
