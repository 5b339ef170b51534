#include "framework/scene/accessor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "framework/scene/fail.hpp"
#include "framework/scene/input_context.hpp"

namespace lightloom::scene {
namespace {

struct ComponentType {
  int gltf;
  std::string_view name;
  size_t size;
  float scale;  ///< of the largest value of a normalised integer
};
constexpr std::array<ComponentType, 6> kComponentTypes{{{5120, "i8", 1, 127.0f},
                                                        {5121, "u8", 1, 255.0f},
                                                        {5122, "i16", 2, 32767.0f},
                                                        {5123, "u16", 2, 65535.0f},
                                                        {5125, "u32", 4, 1.0f},
                                                        {5126, "float", 4, 1.0f}}};

const ComponentType& component(int gltf) {
  return *std::find_if(kComponentTypes.begin(), kComponentTypes.end(), [&](const auto& c) { return c.gltf == gltf; });
}

struct ElementType {
  int tinygltf_type;
  std::string_view name;
  size_t width;
};
constexpr std::array<ElementType, 7> kElementTypes{{{TINYGLTF_TYPE_SCALAR, "SCALAR", 1},
                                                    {TINYGLTF_TYPE_VEC2, "VEC2", 2},
                                                    {TINYGLTF_TYPE_VEC3, "VEC3", 3},
                                                    {TINYGLTF_TYPE_VEC4, "VEC4", 4},
                                                    {TINYGLTF_TYPE_MAT2, "MAT2", 4},
                                                    {TINYGLTF_TYPE_MAT3, "MAT3", 9},
                                                    {TINYGLTF_TYPE_MAT4, "MAT4", 16}}};

const ElementType& element(int type) {
  return *std::find_if(kElementTypes.begin(), kElementTypes.end(),
                       [&](const auto& e) { return e.tinygltf_type == type; });
}

bool lists(std::string_view words, const std::string& word) {
  return (" " + std::string(words) + " ").find(" " + word + " ") != std::string::npos;
}

template <typename T>
T load(const uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

float decode(const uint8_t* bytes, int type, bool normalized) {
  const float scale = normalized ? component(type).scale : 1.0f;
  switch (type) {
    case 5120:
      return std::max(static_cast<float>(load<int8_t>(bytes)) / scale, normalized ? -1.0f : -128.0f);
    case 5121:
      return static_cast<float>(load<uint8_t>(bytes)) / scale;
    case 5122:
      return std::max(static_cast<float>(load<int16_t>(bytes)) / scale, normalized ? -1.0f : -32768.0f);
    case 5123:
      return static_cast<float>(load<uint16_t>(bytes)) / scale;
    case 5125:
      return static_cast<float>(load<uint32_t>(bytes));
    default:
      return load<float>(bytes);
  }
}

uint32_t decode_integer(const uint8_t* bytes, int type) {
  return type == 5121 ? load<uint8_t>(bytes) : type == 5123 ? load<uint16_t>(bytes) : load<uint32_t>(bytes);
}

}  // namespace

size_t AccessorReader::count(int accessor) const {
  return file_.model.accessors[static_cast<size_t>(accessor)].count;
}

std::span<const uint8_t> AccessorReader::view_bytes(int buffer_view, uint64_t offset, size_t element_size,
                                                    size_t stride, size_t count, const std::string& use) const {
  const tinygltf::BufferView& view = file_.model.bufferViews[static_cast<size_t>(buffer_view)];
  const std::vector<unsigned char>& data = file_.model.buffers[static_cast<size_t>(view.buffer)].data;
  const std::string name = "bufferViews[" + std::to_string(buffer_view) + "]";
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    fail(file_.name, name,
         "(bytes " + std::to_string(view.byteOffset) + " to " + std::to_string(view.byteOffset + view.byteLength) +
             ") reaches past the end of its buffer of " + std::to_string(data.size()) + " bytes");
  }
  const bool fits = offset <= view.byteLength && element_size <= view.byteLength - offset &&
                    (count - 1) <= (view.byteLength - offset - element_size) / stride;
  if (!fits) {
    fail(file_.name, use,
         "needs " + std::to_string(count) + " elements of " + std::to_string(element_size) + " bytes from byte " +
             std::to_string(offset) + ", which reach past the end of " + name + " of " +
             std::to_string(view.byteLength) + " bytes");
  }
  return std::span(data).subspan(view.byteOffset + offset, (count - 1) * stride + element_size);
}

AccessorReader::Layout AccessorReader::layout(int accessor, const AccessorRule& rule, const std::string& use) const {
  const tinygltf::Accessor& source = file_.model.accessors[static_cast<size_t>(accessor)];
  const ElementType& type = element(source.type);
  const ComponentType& parts = component(source.componentType);
  const std::string name(parts.name);
  const bool allowed =
      lists(rule.components, name + "?") || lists(rule.components, source.normalized ? name + "n" : name);
  const std::string element_name = use + " (accessors[" + std::to_string(accessor) + "])";
  if (!lists(rule.types, std::string(type.name)) || !allowed) {
    fail(file_.name, element_name,
         "is " + std::string(type.name) + " of " + name + (source.normalized ? " normalised" : "") + ", expected " +
             std::string(rule.types) + " of " + std::string(rule.components),
         "n: normalised, ?: normalised or not");
  }
  Layout result;
  result.count = source.count;
  result.width = type.width;
  result.component_type = source.componentType;
  result.normalized = source.normalized;
  const size_t element_size = type.width * parts.size;
  result.stride = element_size;
  if (source.bufferView < 0) {
    spend(result, element_name);
    return result;
  }
  const size_t stride = file_.model.bufferViews[static_cast<size_t>(source.bufferView)].byteStride;
  if (stride != 0 && stride < element_size) {
    fail(file_.name, "bufferViews[" + std::to_string(source.bufferView) + "].byteStride",
         "is " + std::to_string(stride) + ", expected at least the " + std::to_string(element_size) +
             " bytes of an element of " + element_name);
  }
  if (stride != 0) result.stride = stride;
  result.bytes =
      view_bytes(source.bufferView, source.byteOffset, element_size, result.stride, source.count, element_name);
  spend(result, element_name);
  return result;
}

void AccessorReader::spend(const Layout& layout, const std::string& use) const {
  file_.context->spend_accessor_values(multiply_saturated(layout.count, layout.width), file_.name + ": " + use);
}

AccessorReader::Sparse AccessorReader::sparse(int accessor, const Layout& base, const std::string& use) const {
  const auto& source = file_.model.accessors[static_cast<size_t>(accessor)].sparse;
  Sparse result;
  if (!source.isSparse) return result;
  const std::string name = use + " (accessors[" + std::to_string(accessor) + "].sparse)";
  const auto count = static_cast<size_t>(source.count);
  if (count > base.count) {
    fail(file_.name, name,
         "replaces " + std::to_string(count) + " elements, expected at most the accessor's " +
             std::to_string(base.count));
  }
  const size_t index_size = component(source.indices.componentType).size;
  const auto indices = view_bytes(source.indices.bufferView, static_cast<uint64_t>(source.indices.byteOffset),
                                  index_size, index_size, count, name + ".indices");
  const size_t value_size = base.width * component(base.component_type).size;
  result.values = base;
  result.values.count = count;
  result.values.stride = value_size;
  result.values.bytes = view_bytes(source.values.bufferView, static_cast<uint64_t>(source.values.byteOffset),
                                   value_size, value_size, count, name + ".values");
  for (size_t i = 0; i < count; ++i) {
    const uint32_t index = decode_integer(indices.data() + i * index_size, source.indices.componentType);
    if (index >= base.count || (i > 0 && index <= result.indices.back())) {
      fail(file_.name, name + ".indices",
           "has " + std::to_string(index) + " at place " + std::to_string(i) + ", expected increasing indices below " +
               std::to_string(base.count));
    }
    result.indices.push_back(index);
  }
  return result;
}

AccessorValues AccessorReader::floats(int accessor, const AccessorRule& rule, const std::string& use) const {
  const Layout base = layout(accessor, rule, use);
  const Sparse replaced = sparse(accessor, base, use);
  AccessorValues result{std::vector<float>(base.count * base.width, 0.0f), base.count, base.width};
  const size_t size = component(base.component_type).size;
  const auto decode_element = [&](const Layout& from, size_t i, size_t to) {
    for (size_t k = 0; k < base.width; ++k) {
      const float value = decode(from.bytes.data() + i * from.stride + k * size, base.component_type, base.normalized);
      if (!std::isfinite(value)) {
        fail(file_.name, use,
             "holds a value that is not finite in element " + std::to_string(to) + ", expected finite numbers");
      }
      result.values[to * base.width + k] = value;
    }
  };
  for (size_t i = 0; !base.bytes.empty() && i < base.count; ++i) decode_element(base, i, i);
  for (size_t i = 0; i < replaced.indices.size(); ++i) decode_element(replaced.values, i, replaced.indices[i]);
  return result;
}

std::vector<uint32_t> AccessorReader::integers(int accessor, const AccessorRule& rule, const std::string& use) const {
  const Layout base = layout(accessor, rule, use);
  const Sparse replaced = sparse(accessor, base, use);
  std::vector<uint32_t> result(base.count * base.width, 0u);
  const size_t size = component(base.component_type).size;
  const auto decode_element = [&](const Layout& from, size_t i, size_t to) {
    for (size_t k = 0; k < base.width; ++k) {
      result[to * base.width + k] = decode_integer(from.bytes.data() + i * from.stride + k * size, base.component_type);
    }
  };
  for (size_t i = 0; !base.bytes.empty() && i < base.count; ++i) decode_element(base, i, i);
  for (size_t i = 0; i < replaced.indices.size(); ++i) decode_element(replaced.values, i, replaced.indices[i]);
  return result;
}

}  // namespace lightloom::scene
