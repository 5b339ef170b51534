#include "framework/scene/primitive.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/scene/basis.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/tangents.hpp"

namespace lightloom::scene {
namespace {

constexpr AccessorRule kPositionRule{"VEC3", "float i8? u8? i16? u16?"};
constexpr AccessorRule kNormalRule{"VEC3", "float i8n i16n"};
constexpr AccessorRule kTangentRule{"VEC4", "float i8n i16n"};
constexpr AccessorRule kTexcoordRule{"VEC2", "float u8? u16? i8? i16?"};
constexpr AccessorRule kColorRule{"VEC3 VEC4", "float u8n u16n"};
constexpr AccessorRule kWeightsRule{"VEC4", "float u8n u16n"};
constexpr AccessorRule kJointsRule{"VEC4", "u8 u16"};
constexpr AccessorRule kIndexRule{"SCALAR", "u8 u16 u32"};
constexpr AccessorRule kPositionDeltaRule{"VEC3", "float i8? u8? i16? u16?"};
constexpr AccessorRule kDirectionDeltaRule{"VEC3", "float i8n i16n"};

/// Reads the attributes of one glTF primitive into a Primitive.
class PrimitiveReader {
 public:
  PrimitiveReader(const AccessorReader& reader, const GltfFile& file, const tinygltf::Primitive& source,
                  const std::string& path, std::vector<std::string>& warnings)
      : reader_(reader), file_(file), source_(source), path_(path), warnings_(warnings) {}

  Primitive read() {
    primitive_.material = source_.material;
    read_positions();
    read_indices();
    read_texcoords();
    read_colors();
    read_influences();
    read_targets();
    read_normals();
    return std::move(primitive_);
  }

  /// True if the file gave tangents. To be called on the primitive with its final normals.
  bool read_tangents(Primitive& primitive) const {
    if (!source_.attributes.contains("TANGENT")) return false;
    const AccessorValues values = attribute(source_.attributes, "TANGENT", kTangentRule, path_ + ".attributes.");
    for (size_t i = 0; i < primitive.vertices.size(); ++i) {
      const float* value = &values.values[i * 4];
      const glm::vec3 unit = orthonormal_tangent(primitive.vertices[i].normal, {value[0], value[1], value[2]});
      primitive.vertices[i].tangent = glm::vec4(unit, value[3] < 0 ? -1.0f : 1.0f);
    }
    return true;
  }

 private:
  AccessorValues attribute(const std::map<std::string, int>& attributes, const std::string& name,
                           const AccessorRule& rule, const std::string& prefix) const {
    const int accessor = attributes.at(name);
    check_count(accessor, prefix + name);
    return reader_.floats(accessor, rule, prefix + name);
  }

  void check_count(int accessor, const std::string& use) const {
    const size_t expected = reader_.count(source_.attributes.at("POSITION"));
    if (reader_.count(accessor) != expected) {
      fail(file_.name, use,
           "has " + std::to_string(reader_.count(accessor)) + " elements, expected " + std::to_string(expected) +
               " as POSITION has");
    }
  }

  void read_positions() {
    const AccessorValues values = attribute(source_.attributes, "POSITION", kPositionRule, path_ + ".attributes.");
    primitive_.vertices.resize(values.count);
    for (size_t i = 0; i < values.count; ++i) {
      const float* value = &values.values[i * 3];
      primitive_.vertices[i].position = {value[0], value[1], value[2]};
    }
  }

  std::vector<uint32_t> corner_list() const {
    std::vector<uint32_t> corners;
    if (source_.indices >= 0) {
      corners = reader_.integers(source_.indices, kIndexRule, path_ + ".indices");
    } else {
      corners.resize(primitive_.vertices.size());
      for (size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<uint32_t>(i);
    }
    for (size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] >= primitive_.vertices.size()) {
        fail(file_.name, path_ + ".indices",
             "has " + std::to_string(corners[i]) + " at place " + std::to_string(i) +
                 ", expected a value below the vertex count " + std::to_string(primitive_.vertices.size()));
      }
    }
    return corners;
  }

  void read_indices() {
    const std::vector<uint32_t> corners = corner_list();
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
    };
    const size_t count = corners.size();
    if (source_.mode == TINYGLTF_MODE_TRIANGLES) {
      if (count % 3 != 0) {
        warnings_.push_back(file_.name + ": " + path_ + " has " + std::to_string(count) +
                            " corners, not a multiple of 3; the last ones are ignored");
      }
      for (size_t i = 0; i + 2 < count; i += 3) add(corners[i], corners[i + 1], corners[i + 2]);
    } else if (source_.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      for (size_t i = 0; i + 2 < count; ++i) add(corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]);
    } else {
      for (size_t i = 1; i + 1 < count; ++i) add(corners[i], corners[i + 1], corners[0]);
    }
  }

  void read_texcoords() {
    for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"}) {
      if (!source_.attributes.contains(name)) continue;
      const AccessorValues values = attribute(source_.attributes, name, kTexcoordRule, path_ + ".attributes.");
      const bool first = name[9] == '0';
      for (size_t i = 0; i < values.count; ++i) {
        Vertex& vertex = primitive_.vertices[i];
        (first ? vertex.u0 : vertex.uv1.x) = values.values[i * 2];
        (first ? vertex.v0 : vertex.uv1.y) = values.values[i * 2 + 1];
      }
    }
  }

  void read_colors() {
    if (!source_.attributes.contains("COLOR_0")) return;
    const AccessorValues values = attribute(source_.attributes, "COLOR_0", kColorRule, path_ + ".attributes.");
    for (size_t i = 0; i < values.count; ++i) {
      uint32_t packed = 0;
      for (size_t k = 0; k < 4; ++k) {
        const float channel = k < values.width ? std::clamp(values.values[i * values.width + k], 0.0f, 1.0f) : 1.0f;
        packed |= static_cast<uint32_t>(std::lround(channel * 255.0f)) << (8 * k);
      }
      primitive_.vertices[i].color = packed;
    }
  }

  void read_influences() {
    for (size_t set = 0; set < 2; ++set) {
      const std::string joints_name = "JOINTS_" + std::to_string(set), weights_name = "WEIGHTS_" + std::to_string(set);
      const bool has_joints = source_.attributes.contains(joints_name),
                 has_weights = source_.attributes.contains(weights_name);
      if (has_joints != has_weights) {
        fail(file_.name, path_ + ".attributes",
             "has " +
                 (has_joints ? joints_name + " without " + weights_name : weights_name + " without " + joints_name) +
                 ", expected both or neither");
      }
      if (!has_joints) return;
      if (set == 0) primitive_.influences.resize(primitive_.vertices.size());
      const std::string prefix = path_ + ".attributes.";
      check_count(source_.attributes.at(joints_name), prefix + joints_name);
      const std::vector<uint32_t> joints =
          reader_.integers(source_.attributes.at(joints_name), kJointsRule, prefix + joints_name);
      const AccessorValues weights = attribute(source_.attributes, weights_name, kWeightsRule, prefix);
      for (size_t i = 0; i < primitive_.influences.size(); ++i) {
        for (size_t k = 0; k < 4; ++k) {
          const float weight = weights.values[i * 4 + k];
          if (weight < 0)
            fail(file_.name, prefix + weights_name,
                 "is negative in element " + std::to_string(i) + ", expected weights of at least 0");
          primitive_.influences[i].joints[set * 4 + k] = static_cast<uint16_t>(joints[i * 4 + k]);
          primitive_.influences[i].weights[set * 4 + k] = weight;
          if (weight > 0) primitive_.joint_limit = std::max(primitive_.joint_limit, joints[i * 4 + k] + 1);
        }
      }
    }
  }

  static std::vector<glm::vec3> vectors(const AccessorValues& values) {
    std::vector<glm::vec3> result(values.count);
    for (size_t i = 0; i < values.count; ++i) {
      result[i] = {values.values[i * 3], values.values[i * 3 + 1], values.values[i * 3 + 2]};
    }
    return result;
  }

  void read_targets() {
    for (size_t t = 0; t < source_.targets.size(); ++t) {
      const std::map<std::string, int>& target = source_.targets[t];
      const std::string prefix = path_ + ".targets[" + std::to_string(t) + "].";
      MorphTarget morph;
      if (target.contains("POSITION"))
        morph.positions = vectors(attribute(target, "POSITION", kPositionDeltaRule, prefix));
      if (target.contains("NORMAL")) morph.normals = vectors(attribute(target, "NORMAL", kDirectionDeltaRule, prefix));
      if (target.contains("TANGENT"))
        morph.tangents = vectors(attribute(target, "TANGENT", kDirectionDeltaRule, prefix));
      primitive_.targets.push_back(std::move(morph));
    }
  }

  void read_normals() {
    if (!source_.attributes.contains("NORMAL")) {
      primitive_.flat = true;
      return;
    }
    const AccessorValues values = attribute(source_.attributes, "NORMAL", kNormalRule, path_ + ".attributes.");
    bool some_missing = false;
    for (size_t i = 0; i < values.count; ++i) {
      const float* value = &values.values[i * 3];
      primitive_.vertices[i].normal = unit_or({value[0], value[1], value[2]}, glm::vec3(0));
      some_missing = some_missing || primitive_.vertices[i].normal == glm::vec3(0);
    }
    if (some_missing) replace_zero_normals();
  }

  void replace_zero_normals() {
    std::vector<glm::dvec3> sums(primitive_.vertices.size(), glm::dvec3(0));
    for (size_t i = 0; i < primitive_.indices.size(); i += 3) {
      const auto vertex = [&](size_t k) -> const Vertex& { return primitive_.vertices[primitive_.indices[i + k]]; };
      const glm::dvec3 area = double_area(vertex(0).position, vertex(1).position, vertex(2).position);
      for (size_t k = 0; k < 3; ++k) sums[primitive_.indices[i + k]] += area;
    }
    size_t replaced = 0;
    for (size_t i = 0; i < sums.size(); ++i) {
      Vertex& vertex = primitive_.vertices[i];
      if (vertex.normal != glm::vec3(0)) continue;
      const double length = glm::length(sums[i]);
      vertex.normal = length > 0 ? glm::vec3(sums[i] / length) : glm::vec3(0, 1, 0);
      ++replaced;
    }
    warnings_.push_back(file_.name + ": " + path_ + ".attributes.NORMAL has " + std::to_string(replaced) +
                        " zero vectors; normals of the faces around are used");
  }

  const AccessorReader& reader_;
  const GltfFile& file_;
  const tinygltf::Primitive& source_;
  const std::string& path_;
  std::vector<std::string>& warnings_;
  Primitive primitive_;
};

void normalise_influences(Primitive& primitive, const GltfFile& file, const std::string& path,
                          std::vector<std::string>& warnings) {
  size_t unbound = 0;
  for (Influence& influence : primitive.influences) {
    float sum = 0;
    for (const float weight : influence.weights) sum += weight;
    if (sum > 0 && std::isfinite(sum)) {
      for (float& weight : influence.weights) weight /= sum;
    } else {
      influence.weights = {1};
      primitive.joint_limit = std::max(primitive.joint_limit, influence.joints[0] + 1u);
      ++unbound;
    }
  }
  if (unbound > 0) {
    warnings.push_back(file.name + ": " + path + " has " + std::to_string(unbound) +
                       " vertices without skin weights; they follow their first joint");
  }
}

// A deforming mesh may open triangles that are closed at rest, so there only those with equal corners go.
void drop_degenerate(Primitive& primitive) {
  const bool deforms = !primitive.targets.empty() || !primitive.influences.empty();
  std::vector<uint32_t> kept;
  kept.reserve(primitive.indices.size());
  for (size_t i = 0; i < primitive.indices.size(); i += 3) {
    const uint32_t a = primitive.indices[i], b = primitive.indices[i + 1], c = primitive.indices[i + 2];
    const bool equal = a == b || b == c || c == a;
    const auto position = [&](uint32_t vertex) { return primitive.vertices[vertex].position; };
    if (equal || (!deforms && is_degenerate(position(a), position(b), position(c)))) {
      ++primitive.dropped_triangles;
    } else {
      kept.insert(kept.end(), {a, b, c});
    }
  }
  primitive.indices = std::move(kept);
}

}  // namespace

void remap_vertices(Primitive& primitive, const std::vector<uint32_t>& sources) {
  const auto remap = [&](auto& values) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> mapped;
    mapped.reserve(sources.size());
    for (const uint32_t source : sources) mapped.push_back(values[source]);
    values = std::move(mapped);
  };
  remap(primitive.vertices);
  remap(primitive.influences);
  for (MorphTarget& target : primitive.targets) {
    remap(target.positions);
    remap(target.normals);
    remap(target.tangents);
  }
}

Primitive load_primitive(const AccessorReader& reader, const GltfFile& file, const tinygltf::Primitive& source,
                         TangentTexcoord tangent_texcoord, const std::string& path,
                         std::vector<std::string>& warnings) {
  if (source.mode < TINYGLTF_MODE_TRIANGLES) {
    warnings.push_back(file.name + ": " + path + " is made of points or lines and is skipped");
    return {};
  }
  if (!source.attributes.contains("POSITION")) {
    warnings.push_back(file.name + ": " + path + " has no POSITION and is skipped");
    return {};
  }
  PrimitiveReader primitive_reader(reader, file, source, path, warnings);
  Primitive primitive = primitive_reader.read();
  normalise_influences(primitive, file, path, warnings);
  drop_degenerate(primitive);
  if (primitive.flat) {
    make_flat_normals(primitive);
    generate_tangents(primitive, tangent_texcoord);
  } else if (!primitive_reader.read_tangents(primitive)) {
    generate_tangents(primitive, tangent_texcoord);
  }
  return primitive;
}

}  // namespace lightloom::scene
