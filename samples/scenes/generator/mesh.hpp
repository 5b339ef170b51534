#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace lightloom::samples {

/// Metres, right-handed, y up. The bitangent cross(normal, tangent) * tangent.w points towards falling uv.y, as glTF's
/// normal maps expect.
struct MeshVertex {
  glm::dvec3 position{0};
  glm::dvec3 normal{0, 1, 0};
  glm::dvec4 tangent{1, 0, 0, 1};
  glm::dvec2 uv{0};
};

/// Triangles wind counter-clockwise seen from outside.
struct Mesh {
  std::vector<MeshVertex> vertices;
  std::vector<uint32_t> indices;
};

struct UvRect {
  glm::dvec2 min{0};  ///< upper left corner of the quad, glTF's v runs down
  glm::dvec2 max{1};
};

/// A flat parallelogram: `corner`, `right` and `up` as seen from its front, which is where cross(right, up) points.
void add_quad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up, const UvRect& uv);

/// The same; the texture lies in world space and repeats every `period` metres, so that neighbours continue it.
void add_quad(Mesh& mesh, glm::dvec3 corner, glm::dvec3 right, glm::dvec3 up, double period);

/// Faces of a box; combine with |.
enum BoxFace : uint32_t {
  kLeft = 1,    ///< -x
  kRight = 2,   ///< +x
  kBottom = 4,  ///< -y
  kTop = 8,     ///< +y
  kBack = 16,   ///< -z
  kFront = 32,  ///< +z
  kAllFaces = 63,
};

/// Axis-aligned box; faces that lie on another solid are best left out.
void add_box(Mesh& mesh, glm::dvec3 low, glm::dvec3 high, double period, uint32_t faces = kAllFaces);

/// Surface of revolution about the y axis through `base`. `profile` holds (radius, height) from bottom to top with the
/// solid on the axis' side; it is shaded smoothly, a hard edge is a second call. Tangents run around the axis, uv.x
/// makes `turns` periods around it and uv.y falls with the length along the profile, one period a metre.
void add_revolution(Mesh& mesh, std::span<const glm::dvec2> profile, glm::dvec3 base, uint32_t segments, double turns);

/// Two triangles between two pairs of given corners, in the order lower left, lower right, upper right, upper left.
void add_patch(Mesh& mesh, const MeshVertex& a, const MeshVertex& b, const MeshVertex& c, const MeshVertex& d);

/// A triangle with its flat normal; corners counter-clockwise from outside.
void add_facet(Mesh& mesh, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// Points on a Catmull-Rom spline through `points`, `steps` a span, ends included.
[[nodiscard]] std::vector<glm::dvec2> smooth_profile(std::span<const glm::dvec2> points, uint32_t steps);

}  // namespace lightloom::samples
