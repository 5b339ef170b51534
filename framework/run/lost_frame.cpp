#include "framework/run/lost_frame.hpp"

#include "framework/base/text.hpp"

namespace lightloom::run {
namespace {

std::string under_way(const LostFrame& frame) {
  if (!frame.written) return "in one of its passes " + join(frame.passes, ", ");
  std::vector<std::string> done;
  for (size_t pass = 0; pass < frame.passes.size(); ++pass) {
    if (frame.written->at(2 * pass + 1)) {
      done.push_back(frame.passes[pass]);
      continue;
    }
    const std::string where =
        (frame.written->at(2 * pass) ? "in the pass " : "before the pass ") + in_quotes(frame.passes[pass]);
    return done.empty() ? where : where + ", after " + join(done, ", ");
  }
  // Some drivers note the time of a pass when they take it on.
  return "in or after its last pass";
}

}  // namespace

gpu::DeviceLost in_frame(const gpu::DeviceLost& lost, const LostFrame& frame) {
  return gpu::DeviceLost("frame " + std::to_string(frame.frame) + ", " + under_way(frame) + ": " + lost.what(),
                         lost.hint());
}

gpu::DeviceLost with_kept(const gpu::DeviceLost& lost, const KeptFrames& kept) {
  std::string sentence = lost.what();
  if (kept.written > 0)
    sentence += "; " + std::to_string(kept.written) + (kept.written == 1 ? " frame is" : " frames are") +
                " finished and kept in " + in_quotes(kept.folder);
  const std::string next = kept.checkpoint > 0
                               ? "give the same command with --resume to go on at frame " +
                                     std::to_string(kept.first + kept.checkpoint) + ", where the last checkpoint is"
                               : "with --checkpoint N a run could go on by --resume";
  return gpu::DeviceLost(sentence, lost.hint() + "; " + next);
}

}  // namespace lightloom::run
