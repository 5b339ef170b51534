#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>

#include "framework/run/executor.hpp"
#include "framework/run/frame_set.hpp"
#include "framework/run/run_folder.hpp"
#include "framework/run/run_progress.hpp"

namespace lightloom::run {

/// Called after each rendered frame, whose files may be under way still. What it throws ends the run.
using FrameCallback = std::function<void(uint32_t done, uint32_t total)>;

struct FrameLoopOptions {
  uint32_t first_frame = 0;
  uint32_t total = 0;             ///< frames
  FrameSet output_frames;         ///< whose outputs are written
  FrameSet dump_frames;           ///< whose captures are written
  uint32_t checkpoint_every = 0;  ///< frames between two checkpoints; the last frame gets one as well. 0: none
  /// Time between two checkpoints, at the end of the frame in which it is over; the last frame gets one as well. 0:
  /// none.
  std::chrono::duration<double> checkpoint_time{0};
  nlohmann::ordered_json identity;  ///< of the checkpoints
  /// What dumps say of a frame; called on the thread that writes.
  std::function<nlohmann::ordered_json(const FrameResult&)> describe;
  /// Shown each frame, without its images, while the device has nothing to do; is the run to go on after it? Empty:
  /// yes.
  std::function<bool(const FrameResult&)> go_on_after;
  FrameCallback on_frame;
  std::function<void()> before_first;              ///< before the first file is written, on the thread that writes
  std::function<void(uint32_t frame)> on_written;  ///< when a frame's files are whole, on the thread that writes
};

/// Renders the frames that `progress` lacks, or those up to the one after which it is not to go on, and writes their
/// files: while the device works on a frame, those of the frame before are fetched and written on a thread of their
/// own. The device waits where the disk is slower, so memory does not depend on the number of frames. A checkpoint is
/// written behind the files of all frames it counts; where checkpoints are wanted, also for the frame after which a
/// stop was requested (base/interrupt.hpp), the last one then. Throws what rendering or writing throws, once the files
/// of the frames rendered before are whole.
void render_frames(Executor& executor, RunFolder& folder, RunProgress& progress, const FrameLoopOptions& options);

}  // namespace lightloom::run
