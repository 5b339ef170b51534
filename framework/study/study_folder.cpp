#include "framework/study/study_folder.hpp"

#include <atomic>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/image/exr.hpp"
#include "framework/image/png.hpp"
#include "framework/run/run_folder.hpp"

namespace lightloom::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const std::vector<std::string> kColors = {"R", "G", "B", "A"};

/// Fills a folder aside, then gives it its name: whoever looks sees all of it or nothing.
template <typename Fill>
void make_whole(const fs::path& folder, const Fill& fill) {
  static std::atomic<uint32_t> counter{0};
  const fs::path aside = folder.parent_path() / (".aside-" + std::to_string(counter++));
  std::error_code error;
  fs::remove_all(aside, error);
  make_folder(aside);
  try {
    fill(aside);
    fs::remove_all(folder, error);
    fs::rename(aside, folder);
  } catch (const fs::filesystem_error& failure) {
    fs::remove_all(aside, error);
    throw Error(ExitCode::run_failed, "cannot write '" + folder.string() + "': " + failure.code().message());
  } catch (...) {
    fs::remove_all(aside, error);
    throw;
  }
}

std::optional<Json> read_json(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  Json json = Json::parse(read_text_file(file), nullptr, false);
  return json.is_object() ? std::optional(std::move(json)) : std::nullopt;
}

/// JSON has no infinities.
Json number_json(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

double number_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const auto text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return text == "inf" ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
}

fs::path frame_file(uint32_t frame) {
  return "radiance." + run::frame_text(frame) + ".exr";
}

Json to_json(const CellRecord& record) {
  Json once = Json::array();
  for (const auto& [pass, milliseconds] : record.times.once) once.push_back({{"pass", pass}, {"ms", milliseconds}});
  return {{"frame_numbers", record.frame_numbers},
          {"passes", record.times.passes},
          {"frames_ms", record.times.frames},
          {"once", once},
          {"wall_ms", record.times.wall},
          {"memory_bytes", record.times.memory_bytes},
          {"jobs", record.jobs},
          {"seconds", record.seconds},
          {"warnings", record.warnings}};
}

CellRecord cell_of(const Json& json) {
  CellRecord record;
  record.frame_numbers = json.at("frame_numbers").get<std::vector<uint32_t>>();
  record.times.passes = json.at("passes").get<std::vector<std::string>>();
  record.times.frames = json.at("frames_ms").get<std::vector<std::vector<double>>>();
  for (const Json& entry : json.at("once")) record.times.once.emplace_back(entry.at("pass"), entry.at("ms"));
  record.times.wall = json.at("wall_ms").get<std::vector<double>>();
  record.times.memory_bytes = json.at("memory_bytes");
  record.jobs = json.at("jobs");
  record.seconds = json.at("seconds");
  record.warnings = json.at("warnings").get<std::vector<std::string>>();
  return record;
}

}  // namespace

StudyFolder::StudyFolder(fs::path folder) : folder_(std::move(folder)), lock_(folder_, "study") {
  for (const char* part : {"cells", "references"}) make_folder(folder_ / part);
  remove_leftovers();
}

void StudyFolder::remove_leftovers() const {
  std::error_code ignored;
  for (const char* part : {"cells", "references"})
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / part, ignored))
      if (entry.path().filename().string().starts_with(".aside-")) fs::remove_all(entry.path(), ignored);
}

void StudyFolder::clear() const {
  for (const char* part : {"cells", "references"}) {
    std::error_code ignored;
    fs::remove_all(folder_ / part, ignored);
    make_folder(folder_ / part);
  }
}

bool StudyFolder::has_cell(const std::string& key) const {
  return load_cell(key).has_value();
}

void StudyFolder::save_cell(const std::string& key, const Rendering& rendering, const CellRecord& record,
                            const ToneMap& how) const {
  make_whole(folder_ / "cells" / key, [&](const fs::path& aside) {
    for (size_t i = 0; i < rendering.radiance.size(); ++i)
      image::write_exr(aside / frame_file(rendering.frame_numbers[i]), rendering.radiance[i], kColors);
    image::write_png(aside / "image.png",
                     rendering.picture ? *rendering.picture : tone_map(rendering.radiance.back(), how));
    write_file_atomically(aside / "cell.json", to_json(record).dump(1) + "\n");
  });
}

std::optional<CellRecord> StudyFolder::load_cell(const std::string& key) const {
  const auto json = read_json(folder_ / "cells" / key / "cell.json");
  if (!json) return std::nullopt;
  try {
    return cell_of(*json);
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

image::HostImage StudyFolder::load_radiance(const std::string& key, uint32_t frame) const {
  return read_radiance(folder_ / "cells" / key / frame_file(frame));
}

fs::path StudyFolder::picture(const std::string& key) const {
  return folder_ / "cells" / key / "image.png";
}

fs::path StudyFolder::heat_map(const std::string& key, const std::string& reference) const {
  return folder_ / "cells" / key / ("flip." + reference + ".png");
}

void StudyFolder::save_metrics(const std::string& key, const std::string& reference, const MetricValues& values) const {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = number_json(value);
  write_file_atomically(folder_ / "cells" / key / ("metrics." + reference + ".json"), json.dump(1) + "\n");
}

std::optional<MetricValues> StudyFolder::load_metrics(const std::string& key, const std::string& reference) const {
  const auto json = read_json(folder_ / "cells" / key / ("metrics." + reference + ".json"));
  if (!json) return std::nullopt;
  MetricValues values;
  for (const auto& [name, value] : json->items()) values[name] = number_of(value);
  return values;
}

void StudyFolder::save_reference(const std::string& key, const std::vector<image::HostImage>& radiance,
                                 const ReferenceRecord& record) const {
  make_whole(folder_ / "references" / key, [&](const fs::path& aside) {
    for (size_t i = 0; i < radiance.size(); ++i)
      image::write_exr(aside / frame_file(record.frame_numbers[i]), radiance[i], kColors);
    const Json json = {{"frame_numbers", record.frame_numbers},
                       {"relmse", number_json(record.relmse)},
                       {"noise_known", record.noise_known},
                       {"note", record.note}};
    write_file_atomically(aside / "reference.json", json.dump(1) + "\n");
  });
}

std::optional<ReferenceRecord> StudyFolder::load_reference(const std::string& key) const {
  const auto json = read_json(folder_ / "references" / key / "reference.json");
  if (!json) return std::nullopt;
  try {
    return ReferenceRecord{json->at("frame_numbers").get<std::vector<uint32_t>>(), number_of(json->at("relmse")),
                           json->at("noise_known").get<bool>(), json->at("note").get<std::string>()};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

image::HostImage StudyFolder::load_reference_radiance(const std::string& key, uint32_t frame) const {
  return read_radiance(folder_ / "references" / key / frame_file(frame));
}

image::HostImage read_radiance(const fs::path& file) {
  const image::ExrImage exr = image::read_exr(file);
  if (exr.channels.size() != 1 && exr.channels.size() < 3)
    throw Error(ExitCode::invalid_input, "'" + file.string() + "' has " + std::to_string(exr.channels.size()) +
                                             " channels, not red, green and blue");
  image::HostImage image{{Format::rgba32_sfloat, Dimension::d2, {exr.width, exr.height, 1}}, {}};
  std::vector<float> samples;
  samples.reserve(size_t{4} * exr.width * exr.height);
  const size_t colors = exr.channels.size();
  for (uint32_t y = 0; y < exr.height; ++y)
    for (uint32_t x = 0; x < exr.width; ++x)
      for (size_t c = 0; c < 4; ++c)
        samples.push_back(c == 3 ? 1.0F : static_cast<float>(exr.at(x, y, exr.channels[colors == 1 ? 0 : c])));
  image.texels.resize(samples.size() * sizeof(float));
  std::memcpy(image.texels.data(), samples.data(), image.texels.size());
  return image;
}

}  // namespace lightloom::study
