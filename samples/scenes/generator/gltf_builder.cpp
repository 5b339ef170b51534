#include "samples/scenes/generator/gltf_builder.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace lightloom::samples {

namespace {

constexpr int kFloat = 5126, kUnsignedShort = 5123, kArrayBuffer = 34962, kElementArrayBuffer = 34963;

/// Nearest multiple of 2^-18 (4 micrometres), never -0.
float rounded(double value) {
  return static_cast<float>(std::round(value * 262144) / 262144 + 0.0);
}

/// For numbers that stand in the text: six decimals, never -0.
double decimal(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

void put(std::vector<uint8_t>& bytes, uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<uint8_t>(value >> (8 * i)));
}

size_t component_count(const std::string& type) {
  if (type == "SCALAR") return 1;
  return static_cast<size_t>(type.back() - '0');
}

void write_file(const std::filesystem::path& file, const char* data, size_t size) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(data, static_cast<std::streamsize>(size));
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

}  // namespace

size_t GltfBuilder::add_accessor(Stream stream, std::span<const double> values, const char* type, bool bounds) {
  const size_t width = component_count(type);
  std::vector<float> low(width, std::numeric_limits<float>::max()), high(width, std::numeric_limits<float>::lowest());
  auto& bytes = streams_[stream];
  Json accessor{{"bufferView", stream},
                {"byteOffset", bytes.size()},
                {"componentType", kFloat},
                {"count", values.size() / width},
                {"type", type}};
  for (size_t i = 0; i < values.size(); ++i) {
    const float value = rounded(values[i]);
    low[i % width] = std::min(low[i % width], value);
    high[i % width] = std::max(high[i % width], value);
    put(bytes, std::bit_cast<uint32_t>(value), 4);
  }
  if (bounds) {
    accessor["min"] = low;
    accessor["max"] = high;
  }
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

size_t GltfBuilder::add_indices(std::span<const uint32_t> indices) {
  auto& bytes = streams_[kIndices];
  accessors_.push_back({{"bufferView", kIndices},
                        {"byteOffset", bytes.size()},
                        {"componentType", kUnsignedShort},
                        {"count", indices.size()},
                        {"type", "SCALAR"}});
  for (const uint32_t index : indices) {
    if (index >= 0xFFFFu) throw std::runtime_error("a primitive has more than 65535 vertices; split it");
    put(bytes, index, 2);
  }
  return accessors_.size() - 1;
}

size_t GltfBuilder::add_texture(const std::string& uri, bool repeat) {
  textures_.push_back({{"sampler", repeat ? 0 : 1}, {"source", images_.size()}});
  images_.push_back({{"uri", uri}});
  return textures_.size() - 1;
}

size_t GltfBuilder::add_material(Json material) {
  materials_.push_back(std::move(material));
  return materials_.size() - 1;
}

size_t GltfBuilder::add_mesh(const std::string& name, std::span<const Primitive> primitives) {
  Json list = Json::array();
  for (const Primitive& primitive : primitives) {
    std::vector<double> positions, normals, tangents, texcoords;
    for (const MeshVertex& v : primitive.mesh.vertices) {
      positions.insert(positions.end(), {v.position.x, v.position.y, v.position.z});
      normals.insert(normals.end(), {v.normal.x, v.normal.y, v.normal.z});
      tangents.insert(tangents.end(), {v.tangent.x, v.tangent.y, v.tangent.z, v.tangent.w});
      texcoords.insert(texcoords.end(), {v.uv.x, v.uv.y});
    }
    Json attributes;
    attributes["POSITION"] = add_accessor(kPositions, positions, "VEC3", true);
    attributes["NORMAL"] = add_accessor(kNormals, normals, "VEC3", false);
    attributes["TANGENT"] = add_accessor(kTangents, tangents, "VEC4", false);
    attributes["TEXCOORD_0"] = add_accessor(kTexcoords, texcoords, "VEC2", false);
    list.push_back({{"attributes", std::move(attributes)},
                    {"indices", add_indices(primitive.mesh.indices)},
                    {"material", primitive.material}});
  }
  meshes_.push_back({{"name", name}, {"primitives", std::move(list)}});
  return meshes_.size() - 1;
}

size_t GltfBuilder::add_camera(const std::string& name, double vertical_fov) {
  cameras_.push_back({{"name", name},
                      {"type", "perspective"},
                      {"perspective", {{"yfov", decimal(vertical_fov)}, {"znear", 0.05}, {"zfar", 50}}}});
  return cameras_.size() - 1;
}

size_t GltfBuilder::add_node(const Node& node) {
  Json entry{{"name", node.name}};
  if (node.mesh) entry["mesh"] = *node.mesh;
  if (node.camera) entry["camera"] = *node.camera;
  if (node.translation != glm::dvec3(0)) {
    entry["translation"] = {decimal(node.translation.x), decimal(node.translation.y), decimal(node.translation.z)};
  }
  if (node.rotation != std::array<double, 4>{0, 0, 0, 1}) {
    entry["rotation"] = {decimal(node.rotation[0]), decimal(node.rotation[1]), decimal(node.rotation[2]),
                         decimal(node.rotation[3])};
  }
  if (!node.children.empty()) entry["children"] = node.children;
  nodes_.push_back(std::move(entry));
  return nodes_.size() - 1;
}

void GltfBuilder::add_animation(const std::string& name, std::span<const double> times,
                                std::span<const Channel> channels) {
  const size_t input = add_accessor(kKeys, times, "SCALAR", true);
  Json samplers = Json::array(), list = Json::array();
  for (const Channel& channel : channels) {
    const bool rotation = channel.path == "rotation";
    list.push_back({{"sampler", samplers.size()}, {"target", {{"node", channel.node}, {"path", channel.path}}}});
    samplers.push_back({{"input", input},
                        {"interpolation", "LINEAR"},
                        {"output", add_accessor(kKeys, channel.values, rotation ? "VEC4" : "VEC3", false)}});
  }
  animations_.push_back({{"name", name}, {"channels", std::move(list)}, {"samplers", std::move(samplers)}});
}

void GltfBuilder::write(const std::filesystem::path& folder, const std::string& name) const {
  constexpr std::array<int, kStreamCount> kStride{0, 12, 12, 16, 8, 0};
  constexpr std::array<int, kStreamCount> kTarget{kElementArrayBuffer, kArrayBuffer, kArrayBuffer,
                                                  kArrayBuffer,        kArrayBuffer, 0};
  std::vector<uint8_t> bytes;
  Json views = Json::array();
  for (size_t stream = 0; stream < kStreamCount; ++stream) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    Json view{{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", streams_[stream].size()}};
    if (kStride[stream] != 0) view["byteStride"] = kStride[stream];
    if (kTarget[stream] != 0) view["target"] = kTarget[stream];
    views.push_back(std::move(view));
    bytes.insert(bytes.end(), streams_[stream].begin(), streams_[stream].end());
  }
  const auto sampler = [](int wrap) {
    return Json{{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", wrap}, {"wrapT", wrap}};
  };
  Json root{{"asset", {{"version", "2.0"}, {"generator", "samples/scenes/make_atrium.cpp"}}},
            {"extensionsUsed", extensions_},
            {"scene", 0},
            {"scenes", Json::array({Json{{"name", name}, {"nodes", roots_}}})},
            {"nodes", nodes_},
            {"meshes", meshes_},
            {"cameras", cameras_},
            {"animations", animations_},
            {"materials", materials_},
            {"textures", textures_},
            {"samplers", {sampler(10497), sampler(33071)}},
            {"images", images_},
            {"accessors", accessors_},
            {"bufferViews", std::move(views)},
            {"buffers", Json::array({Json{{"uri", name + ".bin"}, {"byteLength", bytes.size()}}})}};
  const std::string text = root.dump(1) + "\n";
  write_file(folder / (name + ".bin"), std::bit_cast<const char*>(bytes.data()), bytes.size());
  write_file(folder / (name + ".gltf"), text.data(), text.size());
}

}  // namespace lightloom::samples
