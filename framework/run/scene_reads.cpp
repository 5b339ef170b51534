#include "framework/run/scene_reads.hpp"

#include <algorithm>
#include <array>

#include "framework/base/error.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {
namespace {

/// What a shader reads by naming a binding, or a member of a block. A pass type must declare a part of `any_of`; where
/// nobody declares anything, it is `all_of`.
struct ReadRow {
  std::string_view name;
  FrameState any_of = FrameState::none;
  FrameState all_of = FrameState::none;
};

constexpr FrameState kGeometry = FrameState::static_geometry | FrameState::dynamic_geometry;
constexpr FrameState kFrame = FrameState::time | FrameState::seed | FrameState::camera;
constexpr std::array kBindings = {
    ReadRow{"VertexBlock", kGeometry, kGeometry},
    ReadRow{"TriangleBlock", kGeometry, kGeometry},
    ReadRow{"PrimitiveBlock", kGeometry, kGeometry},
    ReadRow{"scene_tlas", kGeometry, kGeometry},
    ReadRow{"PastPositionBlock", FrameState::dynamic_geometry, FrameState::dynamic_geometry},
    ReadRow{"MaterialBlock", FrameState::materials, FrameState::materials},
    ReadRow{"texture_pages", FrameState::materials, FrameState::materials},
    // Its members say which.
    ReadRow{"LightBlock", FrameState::lights | FrameState::materials, FrameState::none},
    ReadRow{"environment_map", FrameState::lights, FrameState::lights},
    ReadRow{"environment_table", FrameState::lights, FrameState::lights},
};
/// The rest of the frame block is the same in every frame.
constexpr std::array kFrameMembers = {
    ReadRow{"view_projection", FrameState::camera, FrameState::camera},
    ReadRow{"eye", FrameState::camera, FrameState::camera},
    ReadRow{"inverse_view_projection", FrameState::camera, FrameState::camera},
    ReadRow{"motion", FrameState::dynamic_geometry, FrameState::dynamic_geometry},
    // Which frame it is, the seed, and how many frames the histories hold, which goes with the cameras of the past.
    ReadRow{"ids", kFrame, kFrame},
};
/// What materials emit stays; where the emitters and other lights are need not.
constexpr std::array kLightMembers = {
    ReadRow{"emissions", FrameState::lights | FrameState::materials, FrameState::materials},
    ReadRow{"emitters", FrameState::lights, FrameState::lights},
    ReadRow{"hints", FrameState::lights, FrameState::lights},
    ReadRow{"punctual", FrameState::lights, FrameState::lights},
};
constexpr std::string_view kFrameBlock = "FrameBlock";
constexpr std::string_view kLightBlock = "LightBlock";
/// Beside `has_` and the name of a feature.
constexpr std::array<std::string_view, 11> kSceneConstants = {
    "base_color_pages",   "metallic_roughness_pages", "normal_pages",         "emissive_pages",
    "anisotropy_pages",   "specular_pages",           "specular_color_pages", "vertex_piece_bits",
    "vertex_piece_count", "triangle_piece_bits",      "triangle_piece_count"};

template <size_t N>
const ReadRow* find_row(const std::array<ReadRow, N>& rows, std::string_view name) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const ReadRow& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

const ReadRow* member_row(const gpu::Binding& binding, const gpu::BlockMember& member) {
  if (!member.used) return nullptr;
  if (binding.name == kFrameBlock) return find_row(kFrameMembers, member.name);
  return binding.name == kLightBlock ? find_row(kLightMembers, member.name) : nullptr;
}

bool declared(const ReadRow* row, FrameState reads) {
  return row == nullptr || (row->any_of & reads) != FrameState::none;
}

}  // namespace

bool is_scene_binding(std::string_view name) {
  return name == kFrameBlock || find_row(kBindings, name) != nullptr;
}

bool is_scene_constant(std::string_view name) {
  if (std::find(kSceneConstants.begin(), kSceneConstants.end(), name) != kSceneConstants.end()) return true;
  const auto features = scene::Features{}.named();
  return std::any_of(features.begin(), features.end(),
                     [&](const auto& feature) { return name == "has_" + feature.first; });
}

FrameState scene_reads(const gpu::Reflection& reflection) {
  FrameState reads = FrameState::none;
  const auto add = [&reads](const ReadRow* row) {
    if (row != nullptr) reads = reads | row->all_of;
  };
  for (const gpu::Binding& binding : reflection.bindings) {
    add(find_row(kBindings, binding.name));
    for (const gpu::BlockMember& member : binding.members) add(member_row(binding, member));
  }
  return reads;
}

void require_declared_read(const GraphPass& pass, const gpu::Binding& binding, std::string_view shader) {
  std::string undeclared;
  if (!declared(find_row(kBindings, binding.name), pass.type->reads_of(pass.params))) undeclared = binding.name;
  // A member may stand in a branch that these params do not take; the block is bound in any case.
  for (const gpu::BlockMember& member : binding.members)
    if (!declared(member_row(binding, member), pass.type->reads)) undeclared = binding.name + "." + member.name;
  if (undeclared.empty()) return;
  throw Error(ExitCode::run_failed,
              "pass '" + pass.name + "' (" + pass.type->name + "): shader '" + std::string(shader) + "' reads '" +
                  undeclared + "', which the pass type does not declare among what it reads with its params",
              "add the frame state to PassType::reads or reads_with");
}

}  // namespace lightloom::run
