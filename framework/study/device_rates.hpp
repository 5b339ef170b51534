#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/desc.hpp"
#include "framework/run/shader_library.hpp"

namespace lightloom::study {

/// Bytes that are read and as many that are written, both counted [1/s].
struct CopyRates {
  double in_cache = 0;   ///< by a shader, 256 KiB to 256 KiB
  double in_memory = 0;  ///< by a shader, 48 MiB to 48 MiB
  double transfer = 0;   ///< by the device's own copy, 48 MiB to 48 MiB
  /// The best that large copies reach.
  [[nodiscard]] double best() const;
};

/// Fetches from an R8 volume that wait for each other in each invocation, those of all invocations together [1/s].
struct FetchRates {
  uint32_t side = 0;     ///< of the volume [texels]
  double marching = 0;   ///< neighbours go side by side, a few texels at a time, as rays do
  double scattered = 0;  ///< each one anywhere
};

/// What a device does at best, each measured by a kernel that does little else.
struct DeviceRates {
  CopyRates copy;
  std::map<Format, double> loads;   ///< texels of a 2D image read by texelFetch, in order [1/s]
  std::map<Format, double> stores;  ///< texels written by imageStore, in order [1/s]
  std::vector<FetchRates> fetches;  ///< by side, ascending; what the device has no room for is left out
  double flops = 0;                 ///< 32-bit multiplications and additions [1/s]
  double invocations = 0;           ///< that do nothing [1/s]
  double dispatch = 0;              ///< of one group, with full barriers around it [s]
};

/// `picture`: size of the images that are loaded from and stored to, so that they lie in the caches that the graph's
/// do. `formats`: of those images; depth formats are left out. Takes a few seconds. Throws Error(run_failed) for a
/// device without timestamps.
[[nodiscard]] DeviceRates measure_rates(gpu::Device& device, run::ShaderLibrary& library, const Extent3& picture,
                                        const std::set<Format>& formats);

[[nodiscard]] nlohmann::ordered_json rates_json(const DeviceRates& rates);

}  // namespace lightloom::study
