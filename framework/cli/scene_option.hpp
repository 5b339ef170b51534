#pragma once

#include <filesystem>
#include <optional>
#include <ostream>

#include "framework/scene/load_options.hpp"

namespace lightloom::cli {

/// The scene of an optional `--scene`; without one, says on `err` what stands in for it.
inline std::optional<scene::Scene> load_optional_scene(const std::filesystem::path& file,
                                                       const scene::LoadOptions& options, std::ostream& err) {
  if (!file.empty()) return scene::load_scene(file, options);
  err << "note: without --scene, a unit cube that has every scene feature stands in\n";
  return std::nullopt;
}

}  // namespace lightloom::cli
