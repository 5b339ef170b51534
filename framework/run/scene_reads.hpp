#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/gpu/reflection.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom::run {

/// Is it the name of a block, image or structure that the scene or the frame offers to shaders?
[[nodiscard]] bool is_scene_binding(std::string_view name);

/// Is it the name of a constant that tells shaders what the scene has (shaders/lib/features.glsl)?
[[nodiscard]] bool is_scene_constant(std::string_view name);

/// What a shader reads of the scene and the frame: all state that what it binds and names depends on.
[[nodiscard]] FrameState scene_reads(const gpu::Reflection& reflection);

/// Throws Error(run_failed) where a shader reads a scene binding that its pass type does not declare to read with the
/// pass's params, or names a member of the frame or light block that the type does not declare to read at all: what a
/// pass reads decides when it must run again, so it may not read in silence.
void require_declared_read(const GraphPass& pass, const gpu::Binding& binding, std::string_view shader);

}  // namespace lightloom::run
