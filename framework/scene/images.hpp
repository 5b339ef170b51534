#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "framework/scene/gltf_file.hpp"
#include "framework/scene/load_options.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// Runs `task(0) … task(count-1)` on all cores; the exception of the lowest failing task is rethrown.
void run_parallel(size_t count, const std::function<void(size_t)>& task);

/// Decodes PNG or JPEG to RGBA8: 16-bit samples are rounded, grey is spread, missing alpha is 255, alpha is not
/// premultiplied. Throws Error naming `file` and `name`; nothing is allocated for an image beyond the limits. Whoever
/// decodes in several threads gives them one mutex for the part of it that OpenImageIO can do only once at a time.
[[nodiscard]] Image decode_image(const std::vector<uint8_t>& bytes, const std::string& file, const std::string& name,
                                 const Limits& limits = {}, std::mutex* opening = nullptr);

/// Decodes the listed images of a file, in parallel. Throws Error for the first that is missing or broken; nothing is
/// decoded unless all of them together are within the limits.
[[nodiscard]] std::vector<Image> load_images(const GltfFile& file, const std::vector<int>& indices);

/// Equirectangular environment image (Radiance HDR, OpenEXR, PNG or JPEG by its content), as linear floats. Throws
/// Error.
void load_environment(const std::filesystem::path& path, const std::string& wanted_by, Environment& environment,
                      const LoadOptions& options = {});

}  // namespace lightloom::scene
