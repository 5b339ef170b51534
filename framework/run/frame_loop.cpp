#include "framework/run/frame_loop.hpp"

#include <chrono>
#include <memory>
#include <utility>

#include "framework/base/background_jobs.hpp"
#include "framework/base/error.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/run/checkpoint.hpp"
#include "framework/run/lost_frame.hpp"

namespace lightloom::run {
namespace {

using Clock = std::chrono::steady_clock;

/// Frames whose files are being written or wait for that: one, and one more so that the next frame need not wait where
/// frames differ in what they write.
constexpr size_t kFramesBehind = 2;

class FrameLoop {
 public:
  FrameLoop(Executor& executor, RunFolder& folder, RunProgress& progress, const FrameLoopOptions& options)
      : executor_(executor), folder_(folder), progress_(progress), options_(options), writing_(kFramesBehind) {}

  void run() {
    handed_over_ = checkpoint_frames_ = progress_.frames();
    try {
      run_frames();
    } catch (const gpu::DeviceLost& lost) {
      write_what_was_finished(lost);
      throw with_kept(lost, kept());
    }
    writing_.finish();
  }

 private:
  /// What the device had finished before it was lost. That it was lost is said first, also where this fails.
  void write_what_was_finished(const gpu::DeviceLost& lost) {
    try {
      writing_.finish();
    } catch (const Error& error) {
      throw gpu::DeviceLost(
          std::string(lost.what()) + "; the frames before are not all written either: " + error.what(),
          error.hint().empty() ? lost.hint() : error.hint());
    }
  }

  void run_frames() {
    if (progress_.frames() < options_.total) start();
    while (progress_.frames() < options_.total) {
      FinishedFrame frame = finish();
      const bool interrupted = interrupt_signal() != 0;
      const bool go_on = (!options_.go_on_after || options_.go_on_after(frame.result)) && !interrupted;
      write(std::move(frame), interrupted);
      if (options_.on_frame) options_.on_frame(progress_.frames(), options_.total);
      if (!go_on) break;
      // Before the frame is started, not after, as each frame under way has read-back buffers of its own.
      writing_.wait_for_room();
      if (progress_.frames() < options_.total) start();
    }
  }

  [[nodiscard]] KeptFrames kept() const {
    return {.first = options_.first_frame,
            .written = handed_over_,
            .checkpoint = checkpoint_frames_,
            .folder = folder_.path().string()};
  }

  void start() {
    const uint32_t frame = options_.first_frame + progress_.frames();
    started_ = Clock::now();
    executor_.start_frame(
        frame, {.outputs = options_.output_frames.contains(frame), .captures = options_.dump_frames.contains(frame)});
  }

  FinishedFrame finish() {
    FinishedFrame frame = executor_.finish_frame();
    const std::chrono::duration<double, std::milli> elapsed = Clock::now() - started_;
    if (progress_.frames() == 0) progress_.once_times = frame.result.once_times;
    progress_.add(elapsed.count(), frame.result.times);
    return frame;
  }

  void write(FinishedFrame frame, bool last) {
    const std::shared_ptr<Checkpoint> checkpoint = save(last);
    ++handed_over_;
    if (!checkpoint && !frame.wants.outputs && !frame.wants.captures) return;
    writing_.add([this, checkpoint, frame = std::move(frame)] {
      if (!std::exchange(written_, true) && options_.before_first) options_.before_first();
      const FrameResult result = executor_.fetch(frame);
      folder_.write_frame(executor_.plan().graph, result, options_.describe(result));
      if (options_.on_written) options_.on_written(result.frame);
      if (!checkpoint) return;
      folder_.add_file(checkpoint_file());
      checkpoint->folder = folder_.state();
      write_checkpoint(folder_.path(), *checkpoint);
    });
  }

  /// The checkpoint that is due now, but for the state of the folder; empty if none is.
  [[nodiscard]] std::shared_ptr<Checkpoint> save(bool last) {
    if (!checkpoint_is_due(last || progress_.frames() == options_.total)) return nullptr;
    last_checkpoint_ = Clock::now();
    checkpoint_frames_ = progress_.frames();
    return std::make_shared<Checkpoint>(
        Checkpoint{.identity = options_.identity, .folder = {}, .progress = progress_, .state = executor_.save()});
  }

  [[nodiscard]] bool checkpoint_is_due(bool last) const {
    const bool by_frames = options_.checkpoint_every > 0, by_time = options_.checkpoint_time.count() > 0;
    if (!by_frames && !by_time) return false;
    return last || (by_frames && progress_.frames() % options_.checkpoint_every == 0) ||
           (by_time && Clock::now() - last_checkpoint_ >= options_.checkpoint_time);
  }

  Executor& executor_;
  RunFolder& folder_;  ///< of the writing thread, until that has finished
  RunProgress& progress_;
  const FrameLoopOptions& options_;
  Clock::time_point started_;
  uint32_t handed_over_ = 0;        ///< frames that are written, or soon will be
  uint32_t checkpoint_frames_ = 0;  ///< those of them that the last checkpoint has
  Clock::time_point last_checkpoint_ = Clock::now();
  bool written_ = false;  ///< something; of the writing thread
  BackgroundJobs writing_;
};

}  // namespace

void render_frames(Executor& executor, RunFolder& folder, RunProgress& progress, const FrameLoopOptions& options) {
  FrameLoop(executor, folder, progress, options).run();
}

}  // namespace lightloom::run
