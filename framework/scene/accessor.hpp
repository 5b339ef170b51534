#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/scene/gltf_file.hpp"

namespace lightloom::scene {

/// What a use of an accessor may look like: "VEC3" and the component types as glTF writes them, with 'n' behind those
/// that must be normalised and '?' behind those that may be: {"VEC2", "float u8n u16n"}.
struct AccessorRule {
  std::string_view types;       ///< space-separated: "VEC3 VEC4"
  std::string_view components;  ///< space-separated out of i8 u8 i16 u16 u32 float, each with n or ? if integer
};

/// Values of an accessor, converted; element-major.
struct AccessorValues {
  std::vector<float> values;
  size_t count = 0;
  size_t width = 0;  ///< components of an element
};

/// Reads accessors of one file with every byte range checked before anything is allocated. Errors name `use`, e.g.
/// "meshes[0].primitives[1].attributes.POSITION".
class AccessorReader {
 public:
  explicit AccessorReader(const GltfFile& file) : file_(file) {}

  /// As floats; normalised integers become [0,1] or [-1,1]. NaN and infinities are an Error.
  [[nodiscard]] AccessorValues floats(int accessor, const AccessorRule& rule, const std::string& use) const;

  /// As unsigned integers; `rule.components` must list unsigned types only.
  [[nodiscard]] std::vector<uint32_t> integers(int accessor, const AccessorRule& rule, const std::string& use) const;

  [[nodiscard]] size_t count(int accessor) const;

 private:
  struct Layout {
    std::span<const uint8_t> bytes;  ///< from the first element on; empty: all zero
    size_t stride = 0;
    size_t count = 0;
    size_t width = 0;
    int component_type = 0;
    bool normalized = false;
  };
  struct Sparse {
    std::vector<uint32_t> indices;
    Layout values;
  };

  [[nodiscard]] Layout layout(int accessor, const AccessorRule& rule, const std::string& use) const;
  /// Counts what is about to be allocated.
  void spend(const Layout& layout, const std::string& use) const;
  [[nodiscard]] Sparse sparse(int accessor, const Layout& base, const std::string& use) const;
  [[nodiscard]] std::span<const uint8_t> view_bytes(int buffer_view, uint64_t offset, size_t element, size_t stride,
                                                    size_t count, const std::string& use) const;

  const GltfFile& file_;
};

}  // namespace lightloom::scene
