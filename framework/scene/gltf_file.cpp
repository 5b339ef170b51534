#include "framework/scene/gltf_file.hpp"

#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "framework/scene/fail.hpp"
#include "framework/scene/gltf_schema.hpp"
#include "framework/scene/gltf_structure.hpp"
#include "framework/scene/gltf_uri.hpp"
#include "framework/scene/input_context.hpp"
#include "framework/scene/json_scan.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;

constexpr uint32_t kGlbMagic = 0x46546C67u;
constexpr uint32_t kGlbJsonChunk = 0x4E4F534Au;
constexpr uint32_t kGlbBinaryChunk = 0x004E4942u;

struct Container {
  std::string json_text;
  std::vector<uint8_t> binary;
  bool has_binary = false;
};

uint32_t read_u32(std::span<const uint8_t> bytes, size_t offset) {
  return static_cast<uint32_t>(bytes[offset]) | static_cast<uint32_t>(bytes[offset + 1]) << 8 |
         static_cast<uint32_t>(bytes[offset + 2]) << 16 | static_cast<uint32_t>(bytes[offset + 3]) << 24;
}

uint32_t check_glb_header(std::span<const uint8_t> bytes, const std::string& file) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  if (bytes.size() < kHeader)
    fail(file, "the GLB header", "ends after " + std::to_string(bytes.size()) + " bytes, expected at least 20");
  if (read_u32(bytes, 4) != 2)
    fail(file, "the GLB header", "says version " + std::to_string(read_u32(bytes, 4)) + ", expected 2");
  const uint32_t length = read_u32(bytes, 8);
  if (length > bytes.size()) {
    fail(file, "the GLB header",
         "says " + std::to_string(length) + " bytes, but the file has " + std::to_string(bytes.size()),
         "the file may be truncated");
  }
  if (length < kHeader + kChunkHeader)
    fail(file, "the GLB header",
         "says " + std::to_string(length) + " bytes, and ends after " + std::to_string(bytes.size()) +
             " bytes, expected at least 20");
  return length;
}

void take_chunk(std::span<const uint8_t> content, uint32_t type, size_t chunk, const std::string& file,
                Container& container) {
  const std::string name = "GLB chunk " + std::to_string(chunk);
  if (chunk == 0 && type != kGlbJsonChunk) fail(file, name, "is not JSON, expected the JSON chunk first");
  if (chunk == 0 && content.empty()) fail(file, name, "is empty, expected JSON");
  if (content.size() % 4 != 0)
    fail(file, name, "has " + std::to_string(content.size()) + " bytes, expected a multiple of 4");
  if (chunk == 0) {
    container.json_text.assign(content.begin(), content.end());
  } else if (type == kGlbJsonChunk || (type == kGlbBinaryChunk && container.has_binary)) {
    fail(file, name, "is a second one of its type, expected one JSON and at most one BIN chunk");
  } else if (type == kGlbBinaryChunk && chunk != 1) {
    fail(file, name, "is the BIN chunk, expected it right behind the JSON chunk");
  } else if (type == kGlbBinaryChunk) {
    container.binary.assign(content.begin(), content.end());
    container.has_binary = true;
  }
}

Container split_glb(std::span<const uint8_t> bytes, const std::string& file) {
  const size_t length = check_glb_header(bytes, file);
  Container container;
  size_t offset = 12;
  for (size_t chunk = 0; offset < length; ++chunk) {
    const std::string name = "GLB chunk " + std::to_string(chunk);
    if (length - offset < 8) fail(file, name, "ends within its header of 8 bytes", "the file may be truncated");
    const size_t size = read_u32(bytes, offset);
    const uint32_t type = read_u32(bytes, offset + 4);
    offset += 8;
    if (size > length - offset) {
      fail(file, name, "says " + std::to_string(size) + " bytes, but " + std::to_string(length - offset) + " are left");
    }
    take_chunk(bytes.subspan(offset, size), type, chunk, file, container);
    offset += size;
  }
  return container;
}

Container split(std::vector<uint8_t> bytes, const std::string& file) {
  if (bytes.empty()) fail(file, "the file", "is empty, expected glTF");
  if (bytes.size() >= 4 && read_u32(bytes, 0) == kGlbMagic) return split_glb(bytes, file);
  if (bytes[0] < '\t') fail(file, "the file", "begins neither with 'glTF' nor as JSON, expected glTF");
  Container container;
  container.json_text.assign(bytes.begin(), bytes.end());
  return container;
}

json parse_json(const std::string& text, const Limits& limits, const std::string& file) {
  require_json_within(text, limits, file);
  try {
    return json::parse(text);
  } catch (const json::exception& error) {
    const std::string what = error.what();
    const size_t detail = what.find("] ");
    fail(file, "the JSON", "is not readable: " + (detail == std::string::npos ? what : what.substr(detail + 2)),
         "the file may be truncated");
  }
}

void check_version(const json& document, const std::string& file) {
  const json& asset = document["asset"];
  const std::string version = asset["version"].get<std::string>();
  if (version.rfind("2.", 0) != 0) fail(file, "asset.version", "is '" + version + "', expected 2.x");
  const std::string min_version = asset.value("minVersion", "2.0");
  if (min_version != "2.0") fail(file, "asset.minVersion", "is '" + min_version + "', expected 2.0");
}

void check_extensions(const json& document, GltfFile& file) {
  static const std::set<std::string> supported = {"KHR_materials_anisotropy", "KHR_materials_emissive_strength",
                                                  "KHR_materials_specular",   "KHR_materials_ior",
                                                  "KHR_materials_unlit",      "KHR_lights_punctual",
                                                  "KHR_texture_transform",    "KHR_mesh_quantization"};
  for (const json& name : document.value("extensionsRequired", json::array())) {
    if (!supported.contains(name.get<std::string>())) {
      fail(file.name, "extensionsRequired", "lists " + name.get<std::string>() + ", which is not supported",
           "export the file without it, or with an uncompressed fallback");
    }
  }
  for (const json& name : document.value("extensionsUsed", json::array())) {
    // Only approximated, hence good enough where a file can do without, but not where it is required.
    const bool approximated = name == "KHR_materials_transmission";
    if (!supported.contains(name.get<std::string>()) && !approximated) {
      file.warnings.push_back(file.name + ": extension " + name.get<std::string>() + " is not supported and ignored");
    }
  }
}

void read_buffers(const json& document, Container container, GltfFile& file) {
  static const json none = json::array();
  const json& buffers = document.contains("buffers") ? document["buffers"] : none;
  file.model.buffers.resize(buffers.size());
  for (size_t i = 0; i < buffers.size(); ++i) {
    const std::string element = "buffers[" + std::to_string(i) + "]";
    const auto length = static_cast<uint64_t>(buffers[i]["byteLength"].get<double>());
    std::vector<uint8_t>& data = file.model.buffers[i].data;
    if (buffers[i].contains("uri")) {
      data = read_uri(file, buffers[i]["uri"].get_ref<const std::string&>(), element + ".uri", length);
    } else if (i == 0 && container.has_binary) {
      data = std::move(container.binary);
    } else {
      fail(file.name, element + ".uri", "is missing, expected one, as there is no GLB binary chunk for it");
    }
    if (data.size() < length) {
      fail(file.name, element,
           "has " + std::to_string(data.size()) + " bytes, expected byteLength " + std::to_string(length),
           "the file may be truncated");
    }
    data.resize(length);
  }
}

void list_images(const json& document, GltfFile& file) {
  const json images = document.value("images", json::array());
  for (size_t i = 0; i < images.size(); ++i) {
    EncodedImage image;
    image.uri = images[i].value("uri", "");
    image.buffer_view = images[i].value("bufferView", -1);
    const std::string shown =
        is_data_uri(image.uri) ? images[i].value("name", "embedded") : images[i].value("name", image.uri);
    image.name = "images[" + std::to_string(i) + "]" + (shown.empty() ? "" : " (" + shown + ")");
    file.images.push_back(image);
  }
}

// tinygltf turns the checked JSON into structures. Buffers and images are taken out first: it would read past the end
// of a buffer for a bad image range, and would go on without images that are missing.
void parse_model(json document, GltfFile& file) {
  document.erase("buffers");
  document.erase("images");
  const std::string text = document.dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > std::numeric_limits<unsigned int>::max()) fail(file.name, "the JSON", "is larger than 4 GiB");
  std::vector<tinygltf::Buffer> buffers = std::move(file.model.buffers);
  tinygltf::TinyGLTF loader;
  std::string error, warning;
  if (!loader.LoadASCIIFromString(&file.model, &error, &warning, text.c_str(), static_cast<unsigned int>(text.size()),
                                  "")) {
    while (!error.empty() && (error.back() == '\n' || error.back() == '.')) error.pop_back();
    fail(file.name, "the document", "is not valid glTF: " + error);
  }
  file.model.buffers = std::move(buffers);
}

}  // namespace

GltfFile read_gltf_file(const std::filesystem::path& path, InputContext& context) {
  GltfFile file;
  file.path = path;
  file.name = path.string();
  file.context = &context;
  context.begin_asset();
  Container container = split(context.read(path, ""), file.name);
  json document = parse_json(container.json_text, context.limits(), file.name);
  container.json_text = {};
  normalise_numbers(document);
  check_gltf_json(document, context.limits(), file.name);
  check_gltf_structure(document, file.name);
  check_version(document, file.name);
  check_extensions(document, file);
  read_buffers(document, std::move(container), file);
  list_images(document, file);
  parse_model(std::move(document), file);
  return file;
}

std::vector<uint8_t> read_encoded_image(const GltfFile& file, const EncodedImage& image) {
  if (image.buffer_view < 0) {
    if (image.uri.empty()) fail(file.name, image.name, "has neither uri nor bufferView, expected one of them");
    return read_uri(file, image.uri, image.name);
  }
  const tinygltf::BufferView& view = file.model.bufferViews[static_cast<size_t>(image.buffer_view)];
  const std::vector<unsigned char>& data = file.model.buffers[static_cast<size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    fail(file.name, "bufferViews[" + std::to_string(image.buffer_view) + "]",
         "reaches past the end of its buffer of " + std::to_string(data.size()) + " bytes");
  }
  file.context->spend_bytes(view.byteLength, file.name + ": " + image.name);
  const auto begin = data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
  return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
}

}  // namespace lightloom::scene
