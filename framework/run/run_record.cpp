#include "framework/run/run_record.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Pairs = std::vector<std::pair<std::string, std::string>>;
using SizeOption = std::optional<std::pair<uint32_t, uint32_t>>;

Json size_record(const SizeOption& size) {
  return size ? Json{size->first, size->second} : Json();
}

SizeOption size_of(const Json& record) {
  if (record.is_null()) return std::nullopt;
  return std::pair{record.at(0).get<uint32_t>(), record.at(1).get<uint32_t>()};
}

Json pairs_record(const Pairs& pairs) {
  Json record = Json::array();
  for (const auto& [name, value] : pairs) record.push_back(Json::array({name, value}));
  return record;
}

Pairs pairs_of(const Json& record) {
  Pairs pairs;
  for (const Json& pair : record) pairs.emplace_back(pair.at(0).get<std::string>(), pair.at(1).get<std::string>());
  return pairs;
}

std::vector<std::string> texts_of(const Json& record) {
  return record.get<std::vector<std::string>>();
}

Json read_json(const fs::path& file) {
  Json json = Json::parse(read_text_file(file), nullptr, false);
  if (!json.is_object()) throw Error(ExitCode::invalid_input, "'" + file.string() + "' is no JSON object");
  return json;
}

fs::path found_path(const std::string& recorded, const fs::path& working_directory) {
  std::error_code ignored;
  const fs::path path = recorded;
  if (path.is_absolute() || path.empty() || fs::exists(path, ignored)) return path;
  const fs::path from_there = working_directory / path;
  return fs::exists(from_there, ignored) ? from_there : path;
}

RecordedRun run_of(const fs::path& folder, const Json& record) {
  RecordedRun run;
  run.folder = folder;
  const fs::path directory = record.at("working_directory").get<std::string>();
  run.graph = found_path(record.at("graph").at("file").get<std::string>(), directory);
  run.graph_text = record.at("graph").at("text").get<std::string>();
  run.link = link_options_of(record.at("link"));
  run.scene = found_path(record.at("scene").at("file").get<std::string>(), directory);
  run.scene_hash = record.at("scene").at("content_hash").get<std::string>();
  run.camera = record.at("camera").get<std::string>();
  run.camera_path_record = record.at("camera_path");
  if (run.camera_path_record.is_object())
    run.camera_path = found_path(run.camera_path_record.at("file").get<std::string>(), directory);
  run.seed = record.at("seed").get<uint32_t>();
  run.first_frame = record.at("frames").at("first").get<uint32_t>();
  run.frames_per_second = record.at("frames_per_second").get<double>();
  if (const Json& time = record.at("frozen_time"); !time.is_null()) run.frozen_time = time.get<double>();
  run.dump_format = record.at("dump_format").get<std::string>();
  const Json& device = record.at("device");
  run.device = device.at("name").get<std::string>() + ", " + device.at("driver_info").get<std::string>() + ", " +
               device.at("uuid").get<std::string>();
  run.program = record.at("lightloom").get<std::string>() + " " + record.at("commit").get<std::string>();
  run.shaders = record.at("shaders").get<std::string>();
  return run;
}

}  // namespace

Json link_record(const LinkOptions& options) {
  Json type_sets = Json::array();
  for (const TypeSet& set : options.type_sets)
    type_sets.push_back(Json::array({set.option, set.type, set.param, set.value}));
  return {{"variants", options.variants},
          {"swaps", pairs_record(options.swaps)},
          {"type_sets", type_sets},
          {"disables", options.disables},
          {"sets", pairs_record(options.sets)},
          {"formats", pairs_record(options.formats)},
          {"view", size_record(options.view)},
          {"trace", size_record(options.trace)},
          {"captures", options.captures},
          {"hoist", options.hoist},
          {"general", options.general}};
}

LinkOptions link_options_of(const Json& record) {
  LinkOptions options;
  options.variants = texts_of(record.at("variants"));
  options.swaps = pairs_of(record.at("swaps"));
  for (const Json& set : record.at("type_sets")) {
    const std::vector<std::string> texts = texts_of(set);
    options.type_sets.push_back({texts.at(0), texts.at(1), texts.at(2), texts.at(3)});
  }
  options.disables = texts_of(record.at("disables"));
  options.sets = pairs_of(record.at("sets"));
  options.formats = pairs_of(record.at("formats"));
  options.view = size_of(record.at("view"));
  options.trace = size_of(record.at("trace"));
  options.captures = texts_of(record.at("captures"));
  options.hoist = record.at("hoist").get<bool>();
  options.general = record.at("general").get<bool>();
  return options;
}

uint64_t shaders_hash(const ShaderFolders& folders) {
  Hasher hasher;
  for (const fs::path& folder : folders.sources) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      hasher.text(fs::relative(file, folder).generic_string());
      hasher.text(read_text_file(file));
    }
  }
  return hasher.value();
}

Dumps::Dumps(fs::path folder, const Json& index) : folder_(std::move(folder)), index_(index) {
  for (const Json& frame : index_.at("frames")) frames_.push_back(frame.at("frame").get<uint32_t>());
}

std::optional<fs::path> Dumps::file(uint32_t frame, const std::string& value) const {
  const auto at = std::find(frames_.begin(), frames_.end(), frame);
  if (at == frames_.end()) return std::nullopt;
  const Json& files = index_.at("frames").at(static_cast<size_t>(at - frames_.begin())).at("files");
  const auto found = files.find(value);
  if (found == files.end()) return std::nullopt;
  fs::path path = folder_ / found->get<std::string>();
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  return path;
}

Json Dumps::conditions(uint32_t frame) const {
  const auto at = std::find(frames_.begin(), frames_.end(), frame);
  if (at == frames_.end()) return {};
  const Json& entry = index_.at("frames").at(static_cast<size_t>(at - frames_.begin()));
  return read_json(folder_ / entry.at("conditions").get<std::string>());
}

RecordedRun read_run(const fs::path& folder) {
  const fs::path file = folder / "run.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Error(ExitCode::invalid_input, "'" + folder.string() + "' is no folder of a finished run: it has no run.json",
                "lightloom render GRAPH --scene FILE --dump '*' --out DIR makes one");
  const Json record = read_json(file);
  try {
    RecordedRun run = run_of(folder, record);
    const fs::path index = folder / "dumps" / "index.json";
    if (fs::exists(index, ignored)) run.dumps = Dumps(folder, read_json(index));
    return run;
  } catch (const nlohmann::json::exception& exception) {
    throw Error(ExitCode::invalid_input,
                "'" + file.string() + "' does not say all that the run was made from: " + exception.what(),
                "runs of earlier versions of Lightloom do not; render it again");
  }
}

}  // namespace lightloom::run
