#include "framework/run/replay_inputs.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/image/dumped_image.hpp"
#include "framework/image/exr.hpp"
#include "framework/run/scene_layout.hpp"

namespace lightloom::run {
namespace {

[[noreturn]] void fail_no_pass(const Graph& graph, const std::string& glob) {
  for (const auto& [remarks, what] : {std::pair{&graph.culled, "was left out"}, {&graph.bypassed, "is disabled"}})
    for (const PassRemark& remark : *remarks)
      if (glob_match(glob, remark.pass))
        throw Error(ExitCode::usage, "pass " + in_quotes(remark.pass) + " " + what + " in this run: " + remark.reason);
  std::vector<std::string> names;
  for (const GraphPass& pass : graph.passes) names.push_back(pass.name);
  throw Error(ExitCode::usage, "no pass of the graph matches " + in_quotes(glob),
              did_you_mean(glob, names, "its passes are"));
}

/// "2, 4 to 7"
std::string frames_text(const std::vector<uint32_t>& frames) {
  std::vector<std::string> parts;
  for (size_t i = 0; i < frames.size();) {
    size_t end = i;
    while (end + 1 < frames.size() && frames[end + 1] == frames[end] + 1) ++end;
    parts.push_back(std::to_string(frames[i]) + (end > i ? " to " + std::to_string(frames[end]) : ""));
    i = end + 1;
  }
  return join(parts, ", ");
}

[[noreturn]] void fail_missing(const RecordedRun& run, std::map<std::string, std::vector<uint32_t>> missing) {
  std::vector<std::string> texts;
  std::string options;
  for (auto& [value, frames] : missing) {
    std::sort(frames.begin(), frames.end());
    texts.push_back(value + (frames.size() > 1 ? " of the frames " : " of frame ") + frames_text(frames));
    options += " --dump " + value;
  }
  throw Error(ExitCode::invalid_input,
              "the passes read what was not dumped into '" + run.folder.string() + "': " + join(texts, "; "),
              "render the run again with" + options + ", or --dump '*'");
}

}  // namespace

std::vector<bool> choose_passes(const Graph& graph, const std::vector<std::string>& globs) {
  std::vector<bool> chosen(graph.passes.size(), false);
  for (const std::string& glob : globs) {
    bool any = false;
    for (size_t pass = 0; pass < graph.passes.size(); ++pass) {
      if (!glob_match(glob, graph.passes[pass].name)) continue;
      chosen[pass] = true;
      any = true;
    }
    if (!any) fail_no_pass(graph, glob);
  }
  return chosen;
}

FrameStart start_from_dumps(const RecordedRun& run, const Cut& part, uint32_t frame) {
  FrameStart start;
  start.frame_count = frame - run.first_frame;
  const auto remembered = static_cast<uint32_t>(std::min<uint64_t>(start.frame_count, kHistoryLimit));
  for (uint32_t number = frame - remembered; number < frame; ++number) start.recent_frames.push_back(number);
  std::map<std::string, std::vector<uint32_t>> missing;
  for (const NeededLayer& needed : part.needed) {
    if (needed.age > start.frame_count) continue;
    const Value& value = part.graph.values[needed.value];
    const auto file = run.dumps.file(frame - needed.age, value_name(value));
    if (!file) {
      missing[value_name(value)].push_back(frame - needed.age);
      continue;
    }
    image::HostImage image =
        image::read_dumped(*file, value.desc, image::default_channel_names(value.desc, value.port, value.part));
    start.layers.push_back({needed.value, needed.age, std::move(image.texels)});
  }
  if (!missing.empty()) fail_missing(run, std::move(missing));
  return start;
}

}  // namespace lightloom::run
