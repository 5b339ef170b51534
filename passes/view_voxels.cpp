#include "passes/view_voxels.hpp"

#include "passes/param_rows.hpp"
#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

Port view_image(const std::string& doc) {
  Port port;
  port.name = "image";
  port.direction = Direction::out;
  port.parts = {{"", Format::rgba8_unorm, ""}};
  port.extent = ExtentRule::view;
  port.access = Access::compute_storage_write;
  port.doc = doc;
  return port;
}

}  // namespace

PassType make_view_voxels() {
  PassType type;
  type.name = "view_voxels";
  type.doc =
      "A picture of the voxel grid: each pixel's ray is followed voxel by voxel to the first that is occupied, or a "
      "slice of the grid is shown. What is empty is grey.";
  type.ports = {voxels_input("voxels", "what to show"),
                volume_input("distance", "distance to the nearest occupied voxel [voxels / 255], of the same grid"),
                view_image("sRGB-encoded colour; a: 1")};
  type.params = {
      choice_param(
          "show", "albedo", {"albedo", "normal", "tangent", "material", "emission", "distance"},
          "`albedo`: base colour; `normal`, `tangent`: direction / 2 + 1/2; `material`: square roots of the Ward "
          "alphas, 4 F0; `emission`: a colour for each index into the emission table; `distance`: in a slice the "
          "distance, from blue (1) to yellow (far), occupied voxels black; through the camera its mean along the ray"),
      choice_param("cut", "none", {"none", "x", "y", "z"},
                   "`none`: through the camera; else the slice of the grid across this axis, as large as fits: y (or, "
                   "across y, -z) is up, x (or, across x, z) to the right"),
      real_param("cut_position", 0.5, 0, 1, "grid lengths", "where along its axis the slice lies"),
      choice_param("march", "cube_exit", {"sphere", "cube_exit", "dda"},
                   "how rays find the first voxel (shaders/lib/march.glsl): `cube_exit` and `dda` exactly, `sphere` as "
                   "the paper's paths do, past corners of voxels"),
      boolean_param(
          "shade_faces", true,
          "through the camera, darken a voxel by which of its faces is seen, so that voxels can be told apart"),
  };
  type.reads = FrameState::camera;
  type.reads_with = [](const ParamSet& params) {
    return params.choice("cut") == "none" ? FrameState::camera : FrameState::none;
  };
  type.record = one_dispatch("view_voxels.comp", "image");
  return type;
}

}  // namespace lightloom::passes
