#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "framework/graph/desc.hpp"
#include "framework/graph/param.hpp"

namespace lightloom {

/// A value for a push constant member or a specialization constant of the same name in the shader.
struct ShaderValue {
  std::string name;
  std::variant<bool, int32_t, uint32_t, float> value;
};

/// A compute dispatch. `threads` is the number of invocations wanted; the context divides by the shader's local size,
/// rounding up, so shaders check bounds.
///
/// Push constant members and specialization constants are filled by name, from (first match): `values`; the pass's
/// params (choice as index, boolean as bool/uint); scene features as `has_<feature>` and the rest of
/// shaders/lib/features.glsl; for a history-range port P: `P_count` (number of ages bound), `P_first_age`, `P_ring`
/// (layers), `P_newest_layer` (layer of age 0), so that age a lies in layer (P_newest_layer + P_ring - a) % P_ring;
/// where an optional one is unconnected, the count is 0; for an optional input P: `P_bound` (bool); for an output P:
/// `P_wanted` (bool); for an image NAME of the shader, by the graph's choice of formats: `NAME_largest` (float, the
/// largest finite number that a channel holds), `NAME_bits` (uint, of a channel). A name that nothing provides is an
/// error.
struct Dispatch {
  std::string shader;  ///< file under shaders/, e.g. "box_blur.comp"
  Extent3 threads;
  std::vector<ShaderValue> values;
};

struct TriangleRange {
  uint32_t first = 0;
  uint32_t count = 0;
  bool operator==(const TriangleRange&) const = default;
};

/// Does the triangle's material have holes, by the alpha of its texture?
enum class TriangleKind : uint8_t { opaque, masked };

/// A draw of scene triangles by vertex pulling: gl_VertexIndex / 3 is the index of the triangle.
struct Draw {
  std::string vertex_shader;
  std::string fragment_shader;
  std::vector<TriangleRange> triangles;
  /// Fragment outputs are named `out_<port>_<part>` after the output port whose parts are the attachments. A fragment
  /// shader without outputs only stores to images.
  std::string depth_port;  ///< scratch port, d32_sfloat; cleared to 1, less-or-equal test; empty: no depth test
  Extent3 area;            ///< viewport [pixels] without a depth port; else the depth port's extent is taken
  std::vector<ShaderValue> values;
  bool keep_depth = false;  ///< go on with the depth of an earlier draw of this pass instead of clearing it
};

/// Voxels from `low` to `high`, both ends included.
struct VoxelBox {
  std::array<int32_t, 3> low{0, 0, 0};
  std::array<int32_t, 3> high{-1, -1, -1};
  bool operator==(const VoxelBox&) const = default;
};

/// All that a pass can see. Commands recorded one after another see each other's writes: the context separates them.
class PassContext {
 public:
  virtual ~PassContext() = default;

  [[nodiscard]] virtual const ParamSet& params() const = 0;
  /// Extent of a connected port. Throws Error for a port that the pass type does not declare.
  [[nodiscard]] virtual Extent3 input_extent(std::string_view port) const = 0;
  [[nodiscard]] virtual Extent3 output_extent(std::string_view port) const = 0;
  [[nodiscard]] virtual bool connected(std::string_view input_port) const = 0;
  [[nodiscard]] virtual TriangleRange static_triangles() const = 0;
  [[nodiscard]] virtual TriangleRange dynamic_triangles() const = 0;
  /// Disjoint ranges, in order, that hold all triangles of this kind, static and dynamic, and some of the other where
  /// the two take turns too often. Empty if there are none of this kind.
  [[nodiscard]] virtual std::vector<TriangleRange> triangles(TriangleKind kind) const = 0;
  /// Does a persistent port still hold what this pass left in it in the frame before? If not (the first frame, a
  /// history of the value is kept), all of it must be written.
  [[nodiscard]] virtual bool kept(std::string_view port) const = 0;
  /// Does anything read an output: a pass, an output of the graph, an observer? What nobody wants need not be written.
  [[nodiscard]] virtual bool wanted(std::string_view output_port) const = 0;
  /// Disjoint boxes of a grid of `grid` voxels around the scene, at most 16, that hold every voxel in which dynamic
  /// triangles look different from the frame before: where what moves or deforms is, and where it was. Empty where
  /// nothing moves within the grid. The whole grid for a pass that depends on older voxels (`@1`), if anything may
  /// move.
  [[nodiscard]] virtual std::vector<VoxelBox> moved_boxes(const Extent3& grid) const = 0;

  /// Fills every part of an output or scratch port with one colour (unsigned formats: cast to unsigned).
  virtual void clear(std::string_view port, const ClearColor& color) = 0;
  virtual void dispatch(const Dispatch& dispatch) = 0;
  virtual void draw(const Draw& draw) = 0;
};

}  // namespace lightloom
