#include "framework/run/scene_resources.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/triangle_ranges.hpp"
#include "framework/scene/color.hpp"
#include "framework/scene/environment_sampler.hpp"
#include "framework/scene/gpu_material.hpp"
#include "framework/scene/texture_pages.hpp"

namespace lightloom::run {
namespace {

constexpr VkDeviceSize kLightOffset = sizeof(FrameBlock);
constexpr VkDeviceSize kVertexOffset = kLightOffset + sizeof(LightBlock);

template <class T>
std::span<const std::byte> bytes_of(const std::vector<T>& items) {
  return std::as_bytes(std::span(items));
}

/// Vulkan has no empty buffers.
VkDeviceSize at_least_one(VkDeviceSize size) {
  return std::max<VkDeviceSize>(size, 16);
}

VkDeviceSize dynamic_vertex_bytes(const scene::Scene& scene) {
  return (scene.vertices.size() - scene.static_vertex_count) * sizeof(scene::Vertex);
}

/// Of one slot of the past positions.
VkDeviceSize dynamic_position_bytes(const scene::Scene& scene) {
  return (scene.vertices.size() - scene.static_vertex_count) * sizeof(glm::vec4);
}

gpu::Buffer storage_buffer(gpu::Device& device, VkDeviceSize size, const char* name, VkBufferUsageFlags usage = 0) {
  const VkDeviceSize limit = device.info().limits.maxStorageBufferRange;
  if (size > limit)
    throw Error(ExitCode::invalid_input, std::string("the scene's ") + name + " take " + gpu::bytes_text(size) +
                                             ", more than the " + gpu::bytes_text(limit) +
                                             " that a buffer of this device may have");
  return {device, at_least_one(size), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage, gpu::MemoryKind::device, name};
}

/// How shaders see `count` elements of the scene's geometry (shaders/lib/scene.glsl).
gpu::BufferPieces geometry_pieces(const gpu::Device& device, uint64_t count, uint64_t element_bytes,
                                  const std::optional<uint64_t>& most_bytes, const char* name) {
  const uint64_t limit = most_bytes.value_or(device.info().limits.maxStorageBufferRange);
  const gpu::BufferPieces pieces = gpu::pieces_of(count, element_bytes, limit);
  if (pieces.count <= kGeometryPieces) return pieces;
  throw Error(ExitCode::invalid_input,
              std::string("the scene's ") + name + " take " + gpu::bytes_text(count * element_bytes) +
                  ", more than the " + std::to_string(kGeometryPieces) + " times " +
                  gpu::bytes_text(element_bytes << pieces.bits) + " that shaders can reach on this device");
}

gpu::Buffer geometry_buffer(gpu::Device& device, VkDeviceSize size, const char* name, VkBufferUsageFlags usage = 0) {
  return {device, at_least_one(size),        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | usage, gpu::MemoryKind::device,
          name,   gpu::BufferBinding::pieces};
}

gpu::Buffer uniform_buffer(gpu::Device& device, VkDeviceSize size, const char* name) {
  return {device, size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, gpu::MemoryKind::device, name};
}

/// Draws are cheap beside thousands of triangles, and a scene may have as many objects.
constexpr size_t kRangesOfAKind = 64;

/// The pages of each kind of texture, a bit for each, as shaders/lib/features.glsl names them.
std::vector<ShaderValue> texture_values(const std::vector<scene::GpuMaterial>& materials) {
  const auto pages = [&](const scene::GpuTextureSlot scene::GpuMaterial::*kind) {
    uint32_t bits = 0;
    for (const scene::GpuMaterial& material : materials)
      if (const uint32_t page = (material.*kind).page; page < scene::kTexturePageCount) bits |= 1U << page;
    return bits;
  };
  return {{"base_color_pages", pages(&scene::GpuMaterial::base_color_texture)},
          {"metallic_roughness_pages", pages(&scene::GpuMaterial::metallic_roughness_texture)},
          {"normal_pages", pages(&scene::GpuMaterial::normal_texture)},
          {"emissive_pages", pages(&scene::GpuMaterial::emissive_texture)},
          {"anisotropy_pages", pages(&scene::GpuMaterial::anisotropy_texture)},
          {"specular_pages", pages(&scene::GpuMaterial::specular_texture)},
          {"specular_color_pages", pages(&scene::GpuMaterial::specular_color_texture)}};
}

/// As if every page had textures of every kind.
std::vector<ShaderValue> any_texture_values() {
  std::vector<ShaderValue> values = texture_values({});
  for (ShaderValue& value : values) value.value = (1U << scene::kTexturePageCount) - 1;
  return values;
}

gpu::Image upload_page(gpu::Device& device, const scene::TexturePage& page) {
  gpu::Image image(device, {.format = page.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
                            .dimension = Dimension::d2,
                            .extent = {page.width, page.height, 1},
                            .layers = static_cast<uint32_t>(page.images.size()),
                            .mip_levels = static_cast<uint32_t>(page.mips.size()),
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                            .name = "texture page"});
  std::vector<gpu::SubimageData> subimages;
  for (uint32_t level = 0; level < page.mips.size(); ++level) {
    const std::span<const std::byte> texels = std::as_bytes(std::span(page.mips[level]));
    const size_t layer_bytes = texels.size() / page.images.size();
    for (uint32_t layer = 0; layer < page.images.size(); ++layer)
      subimages.push_back({layer, level, texels.subspan(layer * layer_bytes, layer_bytes)});
  }
  gpu::upload_image(device, image, subimages);
  return image;
}

gpu::Image upload_map(gpu::Device& device, VkFormat format, const Extent3& extent, std::span<const std::byte> texels,
                      const char* name) {
  gpu::Image image(device, {.format = format,
                            .dimension = Dimension::d2,
                            .extent = extent,
                            .layers = 1,
                            .mip_levels = 1,
                            .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                            .name = name});
  const gpu::SubimageData data{.layer = 0, .mip_level = 0, .texels = texels};
  gpu::upload_image(device, image, std::span(&data, 1));
  return image;
}

TriangleRange range(size_t first, size_t end) {
  return {static_cast<uint32_t>(first), static_cast<uint32_t>(end - first)};
}

}  // namespace

size_t find_camera(const scene::Scene& scene, const std::string& name) {
  if (name.empty()) return 0;
  std::string names;
  for (size_t index = 0; index < scene.cameras.size(); ++index) {
    if (scene.cameras[index].name == name) return index;
    names += (index == 0 ? "'" : ", '") + scene.cameras[index].name + "'";
  }
  throw Error(ExitCode::invalid_input, "scene '" + scene.file.string() + "' has no camera '" + name + "'",
              "its cameras are " + names);
}

namespace {

/// A path with a field of view needs a camera that has one.
void check_path(const SceneResourceOptions& options, const scene::Camera& camera) {
  if (options.camera_path && options.camera_path->keys.front().vertical_fov && !camera.perspective)
    throw Error(ExitCode::invalid_input, options.camera_path->file.string() +
                                             ": keyframes[0].vertical_fov_degrees is for perspective cameras, but '" +
                                             camera.name + "' is orthographic");
}

}  // namespace

SceneResources::SceneResources(gpu::Device& device, const scene::Scene& scene, SceneResourceOptions options)
    : scene_(scene),
      options_(std::move(options)),
      camera_(find_camera(scene, options_.camera)),
      moving_(scene),
      emission_(scene::build_emission_table(scene)),
      emitters_(scene, emission_),
      samplers_(device),
      vertex_pieces_(geometry_pieces(device, scene.vertices.size(), sizeof(scene::Vertex),
                                     options_.geometry_piece_bytes, "vertices")),
      triangle_pieces_(geometry_pieces(device, scene.triangles.size(), sizeof(scene::Triangle),
                                       options_.geometry_piece_bytes, "triangles")),
      vertices_(geometry_buffer(device, scene.vertices.size() * sizeof(scene::Vertex), "vertices",
                                options_.ray_queries ? gpu::kBuildInputUsage : 0)),
      triangles_(geometry_buffer(device, scene.triangles.size() * sizeof(scene::Triangle), "triangles")),
      past_positions_(storage_buffer(device, kHistoryLimit * dynamic_position_bytes(scene), "past positions")),
      frame_block_(uniform_buffer(device, sizeof(FrameBlock), "frame block")),
      light_block_(uniform_buffer(device, sizeof(LightBlock), "light block")),
      staging_(device, kVertexOffset + dynamic_vertex_bytes(scene) + dynamic_position_bytes(scene), 0,
               gpu::MemoryKind::upload, "frame inputs") {
  check_path(options_, scene.cameras[camera_]);
  upload_geometry(device);
  upload_materials(device);
  upload_environment(device);
  if (options_.ray_queries) accelerator_.emplace(device, scene_, vertices_);
  bind();
}

void SceneResources::upload_geometry(gpu::Device& device) {
  if (scene_.triangles.empty()) return;
  gpu::upload_buffer(device, vertices_, bytes_of(scene_.vertices));
  gpu::upload_buffer(device, triangles_, bytes_of(scene_.triangles));
}

void SceneResources::upload_materials(gpu::Device& device) {
  const scene::TexturePages pages = scene::build_texture_pages(scene_);
  warnings_ = pages.warnings;
  for (const scene::TexturePage& page : pages.pages) texture_pages_.push_back(upload_page(device, page));
  const scene::TexturePage white{.width = 1, .height = 1, .srgb = false, .images = {0}, .mips = {{255, 255, 255, 255}}};
  while (texture_pages_.size() < scene::kTexturePageCount) texture_pages_.push_back(upload_page(device, white));
  const std::vector<scene::GpuMaterial> packed = scene::pack_materials(scene_, pages, emission_);
  texture_values_ = options_.general ? any_texture_values() : texture_values(packed);
  materials_.push_back(storage_buffer(device, packed.size() * sizeof(scene::GpuMaterial), "materials"));
  gpu::upload_buffer(device, materials_.front(), bytes_of(packed));
}

void SceneResources::upload_environment(gpu::Device& device) {
  const scene::Environment& environment = scene_.environment;
  const bool constant = environment.rgb.empty();
  const Extent3 extent = constant ? Extent3{1, 1, 1} : Extent3{environment.width, environment.height, 1};
  std::vector<float> rgba;
  for (size_t texel = 0; texel < size_t{extent.width} * extent.height; ++texel) {
    for (size_t channel = 0; channel < 3; ++channel)
      rgba.push_back(constant ? 1.0f : scene::environment_texel(environment, texel * 3 + channel));
    rgba.push_back(1.0f);
  }
  environment_.push_back(upload_map(device, VK_FORMAT_R32G32B32A32_SFLOAT, extent, bytes_of(rgba), "environment map"));
  const scene::EnvironmentTable table = scene::build_environment_table(environment);
  environment_.push_back(upload_map(device, VK_FORMAT_R32G32_SFLOAT, {table.columns + 1, table.rows, 1},
                                    bytes_of(table.texels), "environment table"));
}

void SceneResources::bind() {
  std::vector<gpu::ImageResource> pages;
  for (const gpu::Image& page : texture_pages_)
    pages.push_back({page.array_view(), samplers_.repeat_trilinear(), VK_IMAGE_LAYOUT_GENERAL});
  gpu::ResourceMap& resources = bindings_.resources;
  resources.emplace("FrameBlock", gpu::resource(frame_block_));
  resources.emplace("LightBlock", gpu::resource(light_block_));
  resources.emplace("VertexBlock", gpu::resource(vertices_, vertex_pieces_, sizeof(scene::Vertex), kGeometryPieces));
  resources.emplace("TriangleBlock",
                    gpu::resource(triangles_, triangle_pieces_, sizeof(scene::Triangle), kGeometryPieces));
  resources.emplace("PastPositionBlock", gpu::resource(past_positions_));
  resources.emplace("MaterialBlock", gpu::resource(materials_.front()));
  resources.emplace("texture_pages", pages);
  if (accelerator_) {
    resources.emplace("scene_tlas", gpu::AccelerationResource{accelerator_->top_level()});
    resources.emplace("PrimitiveBlock", gpu::resource(accelerator_->primitives()));
  }
  resources.emplace("environment_map", gpu::resource(environment_.front(), samplers_.equirectangular()));
  resources.emplace("environment_table", gpu::resource(environment_.back(), samplers_.clamp_linear()));
  for (const auto& [name, present] : scene_.features.named())
    bindings_.values.push_back({"has_" + name, present || options_.general});
  bindings_.values.insert(bindings_.values.end(), texture_values_.begin(), texture_values_.end());
  bindings_.values.insert(bindings_.values.end(), {{"vertex_piece_bits", vertex_pieces_.bits},
                                                   {"vertex_piece_count", vertex_pieces_.count},
                                                   {"triangle_piece_bits", triangle_pieces_.bits},
                                                   {"triangle_piece_count", triangle_pieces_.count}});
  bindings_.static_triangles = range(0, scene_.static_triangle_count);
  bindings_.dynamic_triangles = range(scene_.static_triangle_count, scene_.triangles.size());
  const auto is_masked = [this](uint32_t triangle) {
    return scene_.materials[scene_.triangles[triangle].material].alpha_mode == scene::AlphaMode::mask;
  };
  const auto triangles = static_cast<uint32_t>(scene_.triangles.size());
  bindings_.masked_triangles = ranges_of(triangles, is_masked, kRangesOfAKind);
  bindings_.opaque_triangles = ranges_of(triangles, std::not_fn(is_masked), kRangesOfAKind);
  bindings_.bounds = scene_.bounds;
}

uint32_t SceneResources::fill_light_block(LightBlock& block, const scene::Pose& pose, uint32_t frame) {
  emitters_.update(scene_, pose.dynamic_vertices);
  float brightest = 0;
  for (const scene::EmissionEntry& emission : emission_.entries)
    brightest = std::max(brightest, scene::luminance(emission.radiance));
  for (uint32_t entry = 0; entry < emission_.entries.size(); ++entry) {
    const scene::EmissionEntry& emission = emission_.entries[entry];
    const float relative = brightest > 0 ? scene::luminance(emission.radiance) / brightest : 0;
    block.emissions[entry] = {.radiance = glm::vec4(emission.radiance, relative),
                              .sides = glm::vec4(emission.two_sided ? 1 : 0, 0, 0, 0)};
    block.emitters[entry] = {.surface = glm::vec4(emitters_.area_density(entry), emitters_.emitting_area(entry), 0, 0)};
  }
  const std::vector<scene::Hint> hints = emitters_.draw_hints(scene_, options_.seed, frame, kHintLimit);
  for (size_t index = 0; index < hints.size(); ++index)
    block.hints[index] = {.position = glm::vec4(hints[index].position, hints[index].entry),
                          .normal = glm::vec4(hints[index].normal, hints[index].triangle)};
  const std::vector<PunctualEntry> punctual = make_punctual_entries(pose.punctual);
  std::copy(punctual.begin(), punctual.end(), std::begin(block.punctual));
  return static_cast<uint32_t>(hints.size());
}

FrameConditions SceneResources::prepare(uint32_t frame) {
  const double time = options_.frozen_time.value_or(frame / options_.frames_per_second);
  pose_ = scene::pose(scene_, time);
  moving_.update(pose_.dynamic_vertices);
  bindings_.moved = moving_.moved();
  const uint32_t history_length = std::min(static_cast<uint32_t>(views_.size()), kHistoryLimit - 1);
  scene::Camera camera = pose_.cameras.at(camera_);
  if (options_.camera_path) camera = scene::camera_on_path(*options_.camera_path, time, camera, scene_.origin);
  frame_scene_ = {.scene = &scene_,
                  .pose = &pose_,
                  .camera = camera,
                  .view_width = options_.view.width,
                  .view_height = options_.view.height,
                  .time = time,
                  .frame = frame,
                  .seed = options_.seed};
  views_.push_front(view_of(camera, options_.view, scene_.bounds));
  if (views_.size() > kHistoryLimit) views_.pop_back();
  newest_slot_ = (newest_slot_ + 1) % kHistoryLimit;

  LightBlock lights{};
  const uint32_t hint_count = fill_light_block(lights, pose_, frame);
  const FrameBlock block = make_frame_block(scene_, {.frame = frame,
                                                     .seed = options_.seed,
                                                     .history_length = history_length,
                                                     .views = {views_.begin(), views_.end()},
                                                     .hint_count = hint_count,
                                                     .newest_slot = newest_slot_});
  const std::span<std::byte> staging = staging_.mapped();
  std::memcpy(staging.data(), &block, sizeof block);
  std::memcpy(staging.data() + kLightOffset, &lights, sizeof lights);
  stage_geometry(pose_.dynamic_vertices);
  FrameConditions conditions{
      .time = time, .history_length = history_length, .view = views_.front(), .moving_positions = {}};
  for (const scene::Vertex& vertex : pose_.dynamic_vertices) conditions.moving_positions.push_back(vertex.position);
  return conditions;
}

void SceneResources::stage_geometry(const std::vector<scene::Vertex>& moving) {
  if (moving.empty()) return;
  std::byte* target = staging_.mapped().data() + kVertexOffset;
  std::memcpy(target, moving.data(), moving.size() * sizeof(scene::Vertex));
  target += moving.size() * sizeof(scene::Vertex);
  for (const scene::Vertex& vertex : moving) {
    const glm::vec4 position(vertex.position, 1);
    std::memcpy(target, &position, sizeof position);
    target += sizeof position;
  }
}

void SceneResources::record_upload(VkCommandBuffer commands) const {
  const auto copy = [&](VkDeviceSize from, const gpu::Buffer& to, VkDeviceSize offset, VkDeviceSize size) {
    const VkBufferCopy region{from, offset, size};
    vkCmdCopyBuffer(commands, staging_.get(), to.get(), 1, &region);
  };
  copy(0, frame_block_, 0, sizeof(FrameBlock));
  copy(kLightOffset, light_block_, 0, sizeof(LightBlock));
  const VkDeviceSize moving = dynamic_vertex_bytes(scene_);
  if (moving == 0) return;
  copy(kVertexOffset, vertices_, VkDeviceSize{scene_.static_vertex_count} * sizeof(scene::Vertex), moving);
  const VkDeviceSize slot = dynamic_position_bytes(scene_);
  copy(kVertexOffset + moving, past_positions_, newest_slot_ * slot, slot);
  if (accelerator_) accelerator_->record_rebuild(commands);
}

}  // namespace lightloom::run
