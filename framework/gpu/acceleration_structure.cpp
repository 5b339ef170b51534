#include "framework/gpu/acceleration_structure.hpp"

#include "framework/base/error.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

/// The loader does not export functions of this extension.
template <class Function>
Function load(VkDevice device, const char* name) {
  const auto function = reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
  if (function == nullptr)
    throw Error(ExitCode::no_device, std::string("the device has no ") + name + ", so it cannot do ray queries");
  return function;
}

VkDeviceSize round_up(VkDeviceSize value, VkDeviceSize step) {
  return (value + step - 1) / step * step;
}

VkAccelerationStructureGeometryKHR triangles_of(const Device& device, const TriangleGeometry& list) {
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
  // A shader that decides by alpha may be asked twice: its answer is the same.
  geometry.flags = list.opaque ? VK_GEOMETRY_OPAQUE_BIT_KHR : 0;
  VkAccelerationStructureGeometryTrianglesDataKHR& triangles = geometry.geometry.triangles;
  triangles.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
  triangles.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
  triangles.vertexData.deviceAddress = list.vertices->address(device);
  triangles.vertexStride = list.vertex_stride;
  triangles.maxVertex = list.vertex_count - 1;
  triangles.indexType = VK_INDEX_TYPE_UINT32;
  triangles.indexData.deviceAddress = list.indices->address(device);
  return geometry;
}

VkAccelerationStructureGeometryKHR instances_of(const Device& device, const Buffer& instances) {
  VkAccelerationStructureGeometryKHR geometry{};
  geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
  geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
  VkAccelerationStructureGeometryInstancesDataKHR& data = geometry.geometry.instances;
  data.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
  data.data.deviceAddress = instances.address(device);
  return geometry;
}

}  // namespace

AccelerationStructure::AccelerationStructure(const Device& device, std::span<const TriangleGeometry> geometries,
                                             Rebuilding rebuilding, const std::string& name)
    : device_(device.get()), hangs_(device.ref().hangs), rebuilding_(rebuilding) {
  uint64_t triangles = 0;
  for (const TriangleGeometry& list : geometries) {
    geometries_.push_back(triangles_of(device, list));
    const auto offset = static_cast<uint32_t>(list.first_triangle * 3 * sizeof(uint32_t));
    ranges_.push_back({list.triangle_count, offset, 0, 0});
    triangles += list.triangle_count;
  }
  const uint64_t limit = device.info().ray_query.most_primitives;
  if (triangles > limit)
    throw Error(ExitCode::invalid_input, name + " have " + std::to_string(triangles) + " triangles, more than the " +
                                             std::to_string(limit) + " that device '" + device.info().name +
                                             "' takes for ray queries");
  create(device, name);
}

AccelerationStructure::AccelerationStructure(const Device& device, const Buffer& instances, uint32_t count,
                                             Rebuilding rebuilding, const std::string& name)
    : device_(device.get()),
      hangs_(device.ref().hangs),
      type_(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR),
      rebuilding_(rebuilding),
      geometries_{instances_of(device, instances)},
      ranges_{{count, 0, 0, 0}} {
  create(device, name);
}

AccelerationStructure::~AccelerationStructure() {
  if (*hangs_) return;
  load<PFN_vkDestroyAccelerationStructureKHR>(device_, "vkDestroyAccelerationStructureKHR")(device_, structure_,
                                                                                            nullptr);
}

VkAccelerationStructureBuildGeometryInfoKHR AccelerationStructure::build_info() const {
  VkAccelerationStructureBuildGeometryInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
  info.type = type_;
  info.flags = rebuilding_ == Rebuilding::often ? VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_BUILD_BIT_KHR
                                                : VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
  info.mode = VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
  info.geometryCount = static_cast<uint32_t>(geometries_.size());
  info.pGeometries = geometries_.data();
  return info;
}

void AccelerationStructure::create(const Device& device, const std::string& name) {
  std::vector<uint32_t> counts;
  for (const VkAccelerationStructureBuildRangeInfoKHR& range : ranges_) counts.push_back(range.primitiveCount);
  const VkAccelerationStructureBuildGeometryInfoKHR build = build_info();
  VkAccelerationStructureBuildSizesInfoKHR sizes{};
  sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
  load<PFN_vkGetAccelerationStructureBuildSizesKHR>(device_, "vkGetAccelerationStructureBuildSizesKHR")(
      device_, VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &build, counts.data(), &sizes);

  storage_.emplace(device, sizes.accelerationStructureSize,
                   VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                   MemoryKind::device, "acceleration structure of " + name);
  const VkDeviceSize alignment = device.info().ray_query.scratch_alignment;
  scratch_.emplace(device, sizes.buildScratchSize + alignment,
                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, MemoryKind::device,
                   "scratch memory of " + name);
  scratch_address_ = round_up(scratch_->address(device), alignment);

  VkAccelerationStructureCreateInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
  info.buffer = storage_->get();
  info.size = sizes.accelerationStructureSize;
  info.type = type_;
  check(load<PFN_vkCreateAccelerationStructureKHR>(device_, "vkCreateAccelerationStructureKHR")(device_, &info, nullptr,
                                                                                                &structure_),
        "vkCreateAccelerationStructureKHR for " + name);
  device.set_name(VK_OBJECT_TYPE_ACCELERATION_STRUCTURE_KHR, reinterpret_cast<uint64_t>(structure_), name);
}

VkDeviceAddress AccelerationStructure::address() const {
  VkAccelerationStructureDeviceAddressInfoKHR info{};
  info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
  info.accelerationStructure = structure_;
  return load<PFN_vkGetAccelerationStructureDeviceAddressKHR>(device_, "vkGetAccelerationStructureDeviceAddressKHR")(
      device_, &info);
}

VkDeviceSize AccelerationStructure::bytes() const {
  return storage_->size() + (scratch_ ? scratch_->size() : 0);
}

void AccelerationStructure::record_build(VkCommandBuffer commands) const {
  if (!scratch_) throw Error(ExitCode::run_failed, "an acceleration structure was to be built again, against its plan");
  VkAccelerationStructureBuildGeometryInfoKHR info = build_info();
  info.dstAccelerationStructure = structure_;
  info.scratchData.deviceAddress = scratch_address_;
  const VkAccelerationStructureBuildRangeInfoKHR* ranges = ranges_.data();
  load<PFN_vkCmdBuildAccelerationStructuresKHR>(device_, "vkCmdBuildAccelerationStructuresKHR")(commands, 1, &info,
                                                                                                &ranges);
}

VkAccelerationStructureInstanceKHR make_instance(const AccelerationStructure& structure, uint32_t custom_index) {
  VkAccelerationStructureInstanceKHR instance{};
  instance.transform.matrix[0][0] = instance.transform.matrix[1][1] = instance.transform.matrix[2][2] = 1;
  instance.instanceCustomIndex = custom_index & 0xFFFFFFu;
  instance.mask = 0xFF;
  // Winding never hides a triangle: shaders look at the side themselves.
  instance.flags = VK_GEOMETRY_INSTANCE_TRIANGLE_FACING_CULL_DISABLE_BIT_KHR;
  instance.accelerationStructureReference = structure.address();
  return instance;
}

}  // namespace lightloom::gpu
