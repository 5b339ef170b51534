#include "passes/resample_surface.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {

PassType make_resample_surface() {
  PassType type;
  type.name = "resample_surface";
  type.doc =
      "Brings the G-buffer to trace size by taking the texel under each trace pixel's centre; nothing is averaged, so "
      "every value belongs to one surface. Bypassed, tracing happens at the size of the input.";
  Port resampled = surface_input("surface", "the same at trace size");
  resampled.direction = Direction::out;
  resampled.extent = ExtentRule::trace;
  resampled.access = Access::compute_storage_write;
  resampled.bypass = Bypass{"surface", {}};
  type.ports = {surface_input("surface", "the G-buffer, any size"), resampled};
  type.record = one_dispatch("resample_surface.comp", "surface");
  return type;
}

}  // namespace lightloom::passes
