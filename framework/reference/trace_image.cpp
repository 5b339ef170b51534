#include "framework/reference/trace_image.hpp"

#include <string>

#include "framework/base/error.hpp"

namespace lightloom::reference {

void require_finite(uint64_t not_finite, const ImageSettings& settings) {
  if (not_finite == 0) return;
  const uint64_t paths = uint64_t{settings.width} * settings.height * settings.paths;
  throw Error(ExitCode::run_failed,
              "reference_path_trace: " + std::to_string(not_finite) + " of " + std::to_string(paths) +
                  " paths gave infinite light or no number",
              "the scene's lights or sizes may leave the range of 32-bit floats");
}

}  // namespace lightloom::reference
