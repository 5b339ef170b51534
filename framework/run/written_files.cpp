#include "framework/run/written_files.hpp"

#include <algorithm>

namespace lightloom::run {

std::string frame_text(uint32_t frame) {
  const std::string digits = std::to_string(frame);
  return digits.size() >= 4 ? digits : std::string(4 - digits.size(), '0') + digits;
}

void WrittenFiles::add(const std::filesystem::path& file) {
  if (std::find(single_.begin(), single_.end(), file) == single_.end()) single_.push_back(file);
}

void WrittenFiles::add(const std::string& before, uint32_t frame, const std::string& after) {
  const auto same = std::find_if(of_frames_.begin(), of_frames_.end(),
                                 [&](const OfFrames& files) { return files.before == before && files.after == after; });
  OfFrames& files = same != of_frames_.end() ? *same : of_frames_.emplace_back(OfFrames{before, after, {}});
  files.frames.add(frame);
}

std::vector<std::filesystem::path> WrittenFiles::all() const {
  std::vector<std::filesystem::path> names = single_;
  for (const OfFrames& files : of_frames_)
    files.frames.for_each([&](uint32_t frame) { names.emplace_back(files.before + frame_text(frame) + files.after); });
  return names;
}

std::filesystem::path WrittenFiles::last_of_frames(const std::string& ending) const {
  const auto last = std::find_if(of_frames_.rbegin(), of_frames_.rend(),
                                 [&](const OfFrames& files) { return files.after.ends_with(ending); });
  if (last == of_frames_.rend()) return {};
  return last->before + frame_text(last->frames.ranges().back().last) + last->after;
}

nlohmann::ordered_json WrittenFiles::json() const {
  nlohmann::ordered_json single = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : single_) single.push_back(file.generic_string());
  nlohmann::ordered_json of_frames = nlohmann::ordered_json::array();
  for (const OfFrames& files : of_frames_)
    of_frames.push_back({{"before", files.before}, {"after", files.after}, {"frames", files.frames.json()}});
  return {{"single", single}, {"of_frames", of_frames}};
}

WrittenFiles::WrittenFiles(const nlohmann::ordered_json& json) {
  for (const nlohmann::ordered_json& file : json.at("single")) single_.emplace_back(file.get<std::string>());
  for (const nlohmann::ordered_json& files : json.at("of_frames"))
    of_frames_.push_back(
        {files.at("before").get<std::string>(), files.at("after").get<std::string>(), FrameRanges(files.at("frames"))});
}

}  // namespace lightloom::run
