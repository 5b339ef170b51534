#include "framework/run/checkpoint.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"

namespace lightloom::run {
namespace {

using Json = nlohmann::ordered_json;

// The file: magic, size of the header, header (JSON), texels of all layers in its order, hash of all before.
constexpr std::string_view kMagic = "lightloom checkpoint 2\n";

void append(std::vector<std::byte>& bytes, const void* data, size_t size) {
  const auto* begin = static_cast<const std::byte*>(data);
  bytes.insert(bytes.end(), begin, begin + size);
}

void append_number(std::vector<std::byte>& bytes, uint64_t number) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<std::byte>(number >> (8 * i)));
}

uint64_t number_at(std::span<const std::byte> bytes, size_t offset) {
  uint64_t number = 0;
  for (size_t i = 0; i < 8; ++i) number |= std::to_integer<uint64_t>(bytes[offset + i]) << (8 * i);
  return number;
}

Json layer_json(const SavedLayer& layer) {
  return {{"value", layer.value},
          {"age", layer.age},
          {"format", static_cast<uint32_t>(layer.desc.format)},
          {"volume", layer.desc.dimension == Dimension::d3},
          {"extent", {layer.desc.extent.width, layer.desc.extent.height, layer.desc.extent.depth}},
          {"bytes", layer.texels.size()}};
}

SavedLayer layer_from(const Json& json) {
  const auto extent = json.at("extent").get<std::vector<uint32_t>>();
  SavedLayer layer;
  layer.value = json.at("value").get<std::string>();
  layer.age = json.at("age").get<uint32_t>();
  layer.desc = {static_cast<Format>(json.at("format").get<uint32_t>()),
                json.at("volume").get<bool>() ? Dimension::d3 : Dimension::d2,
                {extent.at(0), extent.at(1), extent.at(2)}};
  return layer;
}

Json header_of(const Checkpoint& checkpoint) {
  Json layers = Json::array();
  for (const SavedLayer& layer : checkpoint.state.layers) layers.push_back(layer_json(layer));
  return {{"identity", checkpoint.identity},
          {"folder", checkpoint.folder},
          {"progress", to_json(checkpoint.progress)},
          {"frame_count", checkpoint.state.frame_count},
          {"recent_frames", checkpoint.state.recent_frames},
          {"layers", layers}};
}

[[noreturn]] void broken(const std::filesystem::path& file, const std::string& why) {
  throw Error(ExitCode::invalid_input, "the checkpoint '" + file.string() + "' cannot be used: " + why,
              "without --resume the run starts anew");
}

Checkpoint parse(std::span<const std::byte> bytes) {
  const uint64_t header_bytes = number_at(bytes, kMagic.size());
  const std::span<const std::byte> body = bytes.subspan(kMagic.size() + 8, bytes.size() - kMagic.size() - 16);
  std::string text(body.subspan(0, header_bytes).size(), ' ');
  std::memcpy(text.data(), body.data(), text.size());
  const Json header = Json::parse(text);
  Checkpoint checkpoint;
  checkpoint.identity = header.at("identity");
  checkpoint.folder = header.at("folder");
  checkpoint.progress = progress_from_json(header.at("progress"));
  checkpoint.state.frame_count = header.at("frame_count").get<uint64_t>();
  checkpoint.state.recent_frames = header.at("recent_frames").get<std::vector<uint32_t>>();
  size_t offset = header_bytes;
  for (const Json& entry : header.at("layers")) {
    SavedLayer layer = layer_from(entry);
    const std::span<const std::byte> texels = body.subspan(offset, entry.at("bytes").get<size_t>());
    layer.texels.assign(texels.begin(), texels.end());
    offset += texels.size();
    checkpoint.state.layers.push_back(std::move(layer));
  }
  return checkpoint;
}

}  // namespace

std::filesystem::path checkpoint_file() {
  return std::filesystem::path("checkpoint") / "state.bin";
}

void write_checkpoint(const std::filesystem::path& run_folder, const Checkpoint& checkpoint) {
  const std::string header = header_of(checkpoint).dump();
  std::vector<std::byte> bytes;
  append(bytes, kMagic.data(), kMagic.size());
  append_number(bytes, header.size());
  append(bytes, header.data(), header.size());
  for (const SavedLayer& layer : checkpoint.state.layers) append(bytes, layer.texels.data(), layer.texels.size());
  append_number(bytes, hash_bytes(bytes.data(), bytes.size()));
  const std::filesystem::path file = run_folder / checkpoint_file();
  std::error_code error;
  std::filesystem::create_directory(file.parent_path(), error);  // a run folder that has gone is not made anew
  if (error)
    throw Error(ExitCode::run_failed,
                "cannot make the folder '" + file.parent_path().string() + "': " + error.message());
  write_file_atomically(file, bytes, Durability::power_loss);
}

std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& run_folder) {
  const std::filesystem::path file = run_folder / checkpoint_file();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) broken(file, "it cannot be read");
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  if (bytes.size() < kMagic.size() + 16 || std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) != 0)
    broken(file, "it is no checkpoint of this version");
  const size_t content = bytes.size() - 8;
  if (number_at(bytes, content) != hash_bytes(bytes.data(), content)) broken(file, "it is damaged");
  try {
    return parse(bytes);
  } catch (const std::exception& exception) {
    broken(file, exception.what());
  }
}

void require_same_run(const std::filesystem::path& run_folder, const Json& saved, const Json& current) {
  std::vector<std::string> differences;
  for (const auto& [name, text] : current.items()) {
    const std::string now = text.get<std::string>();
    const std::string then = saved.contains(name) ? saved.at(name).get<std::string>() : "unknown";
    if (now != then) differences.push_back(name + " (" + then + " then, " + now + " now)");
  }
  if (differences.empty()) return;
  throw Error(
      ExitCode::invalid_input,
      "the checkpoint in '" + run_folder.string() + "' is of another run, which differs in " + join(differences, ", "),
      "resume with what that run was started with, or render without --resume, which starts anew");
}

}  // namespace lightloom::run
