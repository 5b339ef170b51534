#include "passes/pack_surface.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_pack_surface() {
  PassType type;
  type.name = "pack_surface";
  type.doc =
      "Object, material, normal and position of each pixel in one texel of 128 bits, for `temporal_accumulate_packed`. "
      "Positions are kept to 2^-15 of the distance from the viewer, normals to 0.001, of ids 24 bits.";
  type.ports = {
      surface_input("surface", "G-buffer"),
      image_output_like("point", Format::rgba32_uint, "surface", "packed by shaders/lib/packed_surface.glsl"),
  };
  type.reads = FrameState::camera;
  type.record = one_dispatch("pack_surface.comp", "point");
  return type;
}

}  // namespace lightloom::passes
