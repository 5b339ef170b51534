#include "framework/run/run_folder.hpp"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <set>
#include <span>
#include <system_error>
#include <utility>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/npy.hpp"
#include "framework/image/png.hpp"
#include "framework/run/value_doc.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* kConditions = "/frame.json";
constexpr const char* kPositions = "/moving_positions.npy";

std::string dimension_text(const ImageDesc& desc) {
  return desc.dimension == Dimension::d3 ? "3d" : "2d";
}

const Value& find_value(const Graph& graph, const std::string& name) {
  const auto found = std::find_if(graph.values.begin(), graph.values.end(),
                                  [&](const Value& value) { return value_name(value) == name; });
  if (found == graph.values.end()) throw Error(ExitCode::run_failed, "the graph has no value '" + name + "'");
  return *found;
}

/// Volumes do not fit into EXR.
std::string data_extension(const ImageDesc& desc, DumpFormat format) {
  return desc.dimension == Dimension::d3 || format == DumpFormat::npy ? ".npy" : ".exr";
}

std::string samples_text(ImageDesc desc) {
  switch (image::channel_type(desc.format)) {
    case image::ChannelType::unorm8:
      return "uint8, 0..255 stands for 0..1";
    case image::ChannelType::unorm16:
      return "uint16, 0..65535 stands for 0..1";
    case image::ChannelType::half:
      return "float16";
    case image::ChannelType::float32:
      return "float32";
    case image::ChannelType::uint32:
      return "uint32";
  }
  return {};
}

nlohmann::ordered_json describe(const Graph& graph, const Value& value) {
  return {{"doc", value_doc(graph, value)},
          {"channels", image::default_channel_names(value.desc, value.port, value.part)},
          {"format", format_info(value.desc.format).name},
          {"samples", samples_text(value.desc)},
          {"dimension", dimension_text(value.desc)},
          {"width", value.desc.extent.width},
          {"height", value.desc.extent.height},
          {"depth", value.desc.extent.depth},
          {"scratch", value.scratch}};
}

/// Rows of `width` numbers as an image of one channel, for NumPy.
image::HostImage table(Format format, uint32_t width, std::span<const std::byte> numbers) {
  const auto rows = static_cast<uint32_t>(numbers.size() / (width * 4));
  return {.desc = {format, Dimension::d2, {width, rows, 1}},
          .texels = std::vector<std::byte>(numbers.begin(), numbers.end())};
}

/// The hidden file ".NAME.PID" of an atomic write (base/atomic_file.cpp) whose process was killed.
bool is_half_written(const fs::path& name) {
  constexpr std::array<std::string_view, 5> kExtensions{".png", ".exr", ".npy", ".json", ".bin"};
  const std::string kind = name.stem().extension().string();
  const std::string process = name.extension().string();
  if (!name.string().starts_with('.') || process.size() < 2 || process.size() > 11 ||
      process.find_first_not_of("0123456789", 1) != std::string::npos ||
      std::find(kExtensions.begin(), kExtensions.end(), kind) == kExtensions.end())
    return false;
  return ::kill(static_cast<pid_t>(std::stol(process.substr(1))), 0) != 0 && errno == ESRCH;
}

fs::path made(fs::path folder) {
  make_folder(folder);
  return folder;
}

/// A relative path that stays inside its folder.
bool stays_inside(const fs::path& relative) {
  return relative.is_relative() && std::find(relative.begin(), relative.end(), "..") == relative.end();
}

}  // namespace

std::string to_string(DumpFormat format) {
  return format == DumpFormat::npy ? "npy" : "exr";
}

RunFolder::RunFolder(fs::path folder, DumpFormat dump_format)
    : folder_(made(std::move(folder))), journal_(folder_), dump_format_(dump_format) {
  find_earlier_run();
  remove_half_written();
}

RunFolder::RunFolder(fs::path folder, DumpFormat dump_format, const nlohmann::ordered_json& state)
    : folder_(made(std::move(folder))),
      journal_(folder_),
      files_(state.at("files")),
      dump_format_(dump_format),
      dumped_values_(state.at("dumped_values")),
      moving_(state.at("moving")),
      has_positions_(state.at("has_positions").get<bool>()),
      dumped_frames_(state.at("dumped_frames")) {
  replaces_run_ = fs::exists(folder_ / "run.json");  // of the interrupted run
  remove_half_written();
}

nlohmann::ordered_json RunFolder::state() const {
  return {{"files", files_.json()},
          {"dumped_values", dumped_values_},
          {"moving", moving_},
          {"has_positions", has_positions_},
          {"dumped_frames", dumped_frames_.json()}};
}

void RunFolder::remove_half_written() const {
  std::error_code ignored;
  std::vector<fs::path> found;
  const auto look_at = [&](const fs::directory_entry& entry) {
    if (is_half_written(entry.path().filename()) && entry.is_regular_file(ignored)) found.push_back(entry.path());
  };
  for (const fs::path& folder : {folder_, folder_ / "checkpoint"})
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) look_at(entry);
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_ / "dumps", ignored)) look_at(entry);
  for (const fs::path& file : found) fs::remove(file, ignored);
}

void RunFolder::find_earlier_run() {
  std::ifstream stream(folder_ / "run.json");
  if (!stream) return;
  const nlohmann::json record = nlohmann::json::parse(stream, nullptr, false);
  if (!record.is_object() || !record.contains("lightloom") || !record.contains("files")) return;
  replaces_run_ = true;
  for (const nlohmann::json& entry : record["files"])
    if (entry.is_string() && stays_inside(entry.get<std::string>())) earlier_.emplace_back(entry.get<std::string>());
}

void RunFolder::begin_writing() {
  if (!replaces_run_) return;
  journal_.set_aside("run.json");  // first: without it the folder does not claim to be a finished run
  replaces_run_ = false;
}

void RunFolder::remove_earlier_run() {
  std::error_code ignored;
  if (earlier_.empty()) return;
  const std::vector<fs::path> names = files_.all();
  const std::set<fs::path> written(names.begin(), names.end());
  for (const fs::path& file : earlier_) {
    if (written.contains(file)) continue;
    fs::remove(folder_ / file, ignored);
    fs::remove((folder_ / file).parent_path(), ignored);  // goes only when it is empty
  }
  earlier_.clear();
}

void RunFolder::replace(const std::vector<fs::path>& broken_off) {
  earlier_.insert(earlier_.end(), broken_off.begin(), broken_off.end());
}

std::vector<fs::path> RunFolder::leftovers() const {
  std::vector<fs::path> files = earlier_;
  const std::vector<fs::path> written = files_.all();
  files.insert(files.end(), written.begin(), written.end());
  return files;
}

void RunFolder::write_image(const fs::path& relative, const image::HostImage& image,
                            const std::vector<std::string>& channel_names) {
  const fs::path file = folder_ / relative;
  begin_writing();
  journal_.prepare(relative);
  if (relative.extension() == ".npy")
    image::write_npy(file, image);
  else if (relative.extension() == ".png")
    image::write_png(file, image);
  else
    image::write_exr(file, image, channel_names);
}

void RunFolder::write_json(const fs::path& relative, const nlohmann::ordered_json& json) {
  begin_writing();
  journal_.prepare(relative);
  write_file_atomically(folder_ / relative, json.dump(2) + "\n");
}

void RunFolder::write_moving_triangles(const scene::Scene& scene) {
  const std::span<const scene::Triangle> moving = std::span(scene.triangles).subspan(scene.static_triangle_count);
  if (moving.empty()) return;
  const fs::path file = fs::path("dumps") / "moving_triangles.npy";
  write_image(file, table(Format::r32_uint, 5, std::as_bytes(moving)), {});
  files_.add(file);
  moving_ = {{"triangles", file.generic_string()},
             {"first_triangle", scene.static_triangle_count},
             {"first_vertex", scene.static_vertex_count}};
}

void RunFolder::write_plan(const nlohmann::ordered_json& plan) {
  write_json("plan.json", plan);
  files_.add("plan.json");
}

void RunFolder::write_frame_image(const std::string& before, uint32_t frame, const std::string& after,
                                  const image::HostImage& image, const std::vector<std::string>& channel_names) {
  write_image(before + frame_text(frame) + after, image, channel_names);
  files_.add(before, frame, after);
}

void RunFolder::write_frame(const Graph& graph, const FrameResult& result, const nlohmann::ordered_json& conditions) {
  for (const NamedImage& output : result.outputs) {
    const ImageDesc& desc = output.image.desc;
    const bool display = desc.dimension == Dimension::d2 && desc.format == Format::rgba8_unorm;
    write_frame_image(output.name + ".", result.frame, display ? ".png" : data_extension(desc, DumpFormat::exr),
                      output.image, image::default_channel_names(desc, output.name, {}));
  }
  if (!result.captures.empty()) write_dumps(graph, result, conditions);
  journal_.commit();
  remove_earlier_run();
}

void RunFolder::write_dumps(const Graph& graph, const FrameResult& result, const nlohmann::ordered_json& conditions) {
  for (const NamedImage& capture : result.captures) {
    const Value& value = find_value(graph, capture.name);
    write_frame_image("dumps/", result.frame, "/" + capture.name + data_extension(value.desc, dump_format_),
                      capture.image, image::default_channel_names(value.desc, value.port, value.part));
    if (!dumped_values_.contains(capture.name)) dumped_values_[capture.name] = describe(graph, value);
  }
  write_json("dumps/" + frame_text(result.frame) + kConditions, conditions);
  files_.add("dumps/", result.frame, kConditions);
  if (const std::vector<glm::vec3>& positions = result.conditions.moving_positions; !positions.empty()) {
    write_frame_image("dumps/", result.frame, kPositions,
                      table(Format::r32_sfloat, 3, std::as_bytes(std::span(positions))), {});
    has_positions_ = true;
  }
  dumped_frames_.add(result.frame);
}

nlohmann::ordered_json RunFolder::dump_index() const {
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  dumped_frames_.for_each([&](uint32_t frame) {
    const std::string folder = "dumps/" + frame_text(frame);
    nlohmann::ordered_json files = nlohmann::ordered_json::object();
    for (const auto& [name, value] : dumped_values_.items()) {
      const bool array = value["dimension"] == "3d" || dump_format_ == DumpFormat::npy;
      files[name] = folder + "/" + name + (array ? ".npy" : ".exr");
    }
    frames.push_back({{"frame", frame}, {"conditions", folder + kConditions}, {"files", files}});
    if (has_positions_) frames.back()["moving_positions"] = folder + kPositions;
  });
  return {{"values", dumped_values_}, {"moving", moving_}, {"frames", frames}};
}

void RunFolder::finish(nlohmann::ordered_json record) {
  begin_writing();
  remove_earlier_run();
  if (!dumped_frames_.ranges().empty()) {
    write_json("dumps/index.json", dump_index());
    files_.add("dumps/index.json");
  }
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const fs::path& file : files_.all()) files.push_back(file.generic_string());
  record["files"] = files;
  journal_.prepare("run.json");
  write_file_atomically(folder_ / "run.json", record.dump(2) + "\n");
  journal_.commit();
}

}  // namespace lightloom::run
