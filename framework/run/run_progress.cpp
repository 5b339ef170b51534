#include "framework/run/run_progress.hpp"

#include <utility>

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

/// The passes' names are the same in every frame, so they are written once.
Json names_of(const std::vector<PassTime>& times) {
  Json names = Json::array();
  for (const PassTime& time : times) names.push_back(time.pass);
  return names;
}

Json numbers_of(const std::vector<PassTime>& times) {
  Json numbers = Json::array();
  for (const PassTime& time : times) numbers.push_back(time.milliseconds);
  return numbers;
}

std::vector<PassTime> times_from(const Json& names, const Json& numbers) {
  std::vector<PassTime> times;
  for (size_t i = 0; i < names.size(); ++i)
    times.push_back({names.at(i).get<std::string>(), numbers.at(i).get<double>()});
  return times;
}

/// Every second entry, the first one included.
template <typename Entry>
void thin_out(std::vector<Entry>& entries) {
  size_t kept = 1;  // the first one stays where it is: what moves onto itself is lost
  for (size_t i = 2; i < entries.size(); i += 2) entries[kept++] = std::move(entries[i]);
  entries.resize(kept);
}

}  // namespace

void RunProgress::add(double milliseconds, const std::vector<PassTime>& times) {
  if (frames_done++ % timed_every != 0) return;
  if (wall_milliseconds.size() == kMostTimed) {
    thin_out(wall_milliseconds);
    thin_out(pass_times);
    timed_every *= 2;  // and this frame's number is a multiple of it, as kMostTimed is even
  }
  wall_milliseconds.push_back(milliseconds);
  pass_times.push_back(times);
}

Json to_json(const RunProgress& progress) {
  Json frames = Json::array();
  for (const std::vector<PassTime>& times : progress.pass_times) frames.push_back(numbers_of(times));
  return {{"frames", progress.frames_done},
          {"timed_every", progress.timed_every},
          {"passes", progress.pass_times.empty() ? Json::array() : names_of(progress.pass_times.front())},
          {"frames_ms", frames},
          {"once", names_of(progress.once_times)},
          {"once_ms", numbers_of(progress.once_times)},
          {"wall_ms", progress.wall_milliseconds},
          {"resumed_at", progress.resumed_at}};
}

RunProgress progress_from_json(const Json& json) {
  RunProgress progress;
  progress.frames_done = json.at("frames").get<uint32_t>();
  progress.timed_every = json.at("timed_every").get<uint32_t>();
  for (const Json& frame : json.at("frames_ms")) progress.pass_times.push_back(times_from(json.at("passes"), frame));
  progress.once_times = times_from(json.at("once"), json.at("once_ms"));
  progress.wall_milliseconds = json.at("wall_ms").get<std::vector<double>>();
  progress.resumed_at = json.at("resumed_at").get<std::vector<uint32_t>>();
  return progress;
}

}  // namespace lightloom::run
