#include "framework/scene/gltf_file.hpp"

#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string_view>

#include "framework/scene/fail.hpp"
#include "framework/scene/gltf_schema.hpp"

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

Container split_glb(std::span<const uint8_t> bytes, const std::string& file) {
  if (bytes.size() < 20)
    fail(file, "the GLB header", "ends after " + std::to_string(bytes.size()) + " bytes, expected at least 20");
  if (read_u32(bytes, 4) != 2) {
    fail(file, "the GLB header", "says version " + std::to_string(read_u32(bytes, 4)) + ", expected 2");
  }
  const size_t length = read_u32(bytes, 8);
  if (length > bytes.size()) {
    fail(file, "the GLB header",
         "says " + std::to_string(length) + " bytes, but the file has " + std::to_string(bytes.size()),
         "the file may be truncated");
  }
  Container container;
  size_t offset = 12;
  for (size_t chunk = 0; offset + 8 <= length; ++chunk) {
    const size_t size = read_u32(bytes, offset);
    const uint32_t type = read_u32(bytes, offset + 4);
    offset += 8;
    if (size > length - offset) {
      fail(file, "GLB chunk " + std::to_string(chunk),
           "says " + std::to_string(size) + " bytes, but " + std::to_string(length - offset) + " are left");
    }
    const auto content = bytes.subspan(offset, size);
    if (chunk == 0) {
      if (type != kGlbJsonChunk) fail(file, "GLB chunk 0", "is not JSON, expected the JSON chunk first");
      container.json_text.assign(content.begin(), content.end());
    } else if (chunk == 1 && type == kGlbBinaryChunk) {
      container.binary.assign(content.begin(), content.end());
      container.has_binary = true;
    }
    offset += size;
  }
  return container;
}

Container split(std::vector<uint8_t> bytes, const std::string& file) {
  if (bytes.empty()) fail(file, "the file", "is empty, expected glTF");
  if (bytes.size() >= 4 && read_u32(bytes, 0) == kGlbMagic) return split_glb(bytes, file);
  Container container;
  container.json_text.assign(bytes.begin(), bytes.end());
  return container;
}

bool is_data_uri(const std::string& uri) {
  return uri.rfind("data:", 0) == 0;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<uint8_t> decode_base64(std::string_view text, const std::string& file, const std::string& element) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0, count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) fail(file, element, "holds a character that is not base64, expected A-Z, a-z, 0-9, + and /");
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> count & 0xFFu));
  }
  return bytes;
}

std::vector<uint8_t> decode_data_uri(const std::string& uri, const std::string& file, const std::string& element) {
  const size_t comma = uri.find(',');
  const std::string header = uri.substr(0, comma);
  if (comma == std::string::npos || header.find(";base64") == std::string::npos) {
    fail(file, element, "is a data URI without base64 content, expected data:TYPE;base64,CONTENT");
  }
  return decode_base64(std::string_view(uri).substr(comma + 1), file, element);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decode(const std::string& uri) {
  std::string decoded;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
      decoded += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

std::vector<uint8_t> read_uri(const GltfFile& file, const std::string& uri, const std::string& element) {
  if (is_data_uri(uri)) return decode_data_uri(uri, file.name, element);
  if (uri.find("://") != std::string::npos) {
    fail(file.name, element, "is '" + uri + "', expected a path relative to the file or a data URI");
  }
  const std::filesystem::path folder = file.path.parent_path();
  // Exporters disagree on whether spaces and signs are percent-encoded; a file of the literal name wins.
  std::error_code error;
  const std::filesystem::path literal = folder / uri;
  const bool literal_exists = uri.size() < 4096 && std::filesystem::is_regular_file(literal, error);
  return read_bytes(literal_exists ? literal : folder / percent_decode(uri), file.name + ": " + element);
}

json parse_json(const std::string& text, const std::string& file) {
  check_json_depth(text, file);
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
  const json buffers = document.value("buffers", json::array());
  file.model.buffers.resize(buffers.size());
  for (size_t i = 0; i < buffers.size(); ++i) {
    const std::string element = "buffers[" + std::to_string(i) + "]";
    std::vector<uint8_t>& data = file.model.buffers[i].data;
    if (buffers[i].contains("uri")) {
      data = read_uri(file, buffers[i]["uri"].get<std::string>(), element + ".uri");
    } else if (i == 0 && container.has_binary) {
      data = std::move(container.binary);
    } else {
      fail(file.name, element + ".uri", "is missing, expected one, as there is no GLB binary chunk for it");
    }
    const auto length = static_cast<uint64_t>(buffers[i]["byteLength"].get<double>());
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

std::vector<uint8_t> read_bytes(const std::filesystem::path& path, const std::string& wanted_by) {
  std::error_code error;
  const std::string prefix = wanted_by.empty() ? "" : wanted_by + ": ";
  if (!std::filesystem::exists(path, error)) {
    throw Error(ExitCode::invalid_input, prefix + "the file " + path.string() + " does not exist");
  }
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Error(ExitCode::invalid_input, prefix + path.string() + " is not a regular file");
  }
  std::ifstream stream(path, std::ios::binary);
  std::vector<uint8_t> bytes(static_cast<size_t>(std::filesystem::file_size(path, error)));
  if (!stream || error ||
      !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw Error(ExitCode::invalid_input, prefix + "the file " + path.string() + " cannot be read");
  }
  return bytes;
}

GltfFile read_gltf_file(const std::filesystem::path& path) {
  GltfFile file;
  file.path = path;
  file.name = path.string();
  Container container = split(read_bytes(path, ""), file.name);
  json document = parse_json(container.json_text, file.name);
  normalise_numbers(document);
  check_gltf_json(document, file.name);
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
  const auto begin = data.begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
  return {begin, begin + static_cast<std::ptrdiff_t>(view.byteLength)};
}

}  // namespace lightloom::scene
