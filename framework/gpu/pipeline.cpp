#include "framework/gpu/pipeline.hpp"

#include <array>

#include "framework/base/error.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/descriptor_type.hpp"
#include "framework/gpu/format.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

void require_known_names(const Reflection& reflection, std::span<const ShaderValue> constants) {
  std::vector<std::string> names;
  for (const SpecializationConstant& constant : reflection.constants) names.push_back(constant.name);
  for (const ShaderValue& value : constants) {
    if (reflection.find_constant(value.name) != nullptr) continue;
    throw Error(ExitCode::invalid_input,
                "shader " + reflection.name + " has no specialization constant " + in_quotes(value.name),
                did_you_mean(value.name, names, "it has"));
  }
}

/// One shader stage of a pipeline, with all that its create info points to.
struct StageInfo {
  ShaderModuleHandle module;
  std::vector<VkSpecializationMapEntry> entries;
  std::vector<uint32_t> data;
  VkSpecializationInfo specialization{};
  VkPipelineShaderStageCreateInfo create{};

  StageInfo(const Device& device, const SpirvModule& spirv, const Reflection& reflection,
            std::span<const ShaderValue> constants) {
    VkShaderModuleCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    info.codeSize = spirv.words.size() * sizeof(uint32_t);
    info.pCode = spirv.words.data();
    VkShaderModule created = VK_NULL_HANDLE;
    check(vkCreateShaderModule(device.get(), &info, nullptr, &created), "vkCreateShaderModule for " + spirv.name);
    module = ShaderModuleHandle(device.ref(), created);

    create.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    create.stage = stage_flag(spirv.stage);
    create.module = created;
    create.pName = "main";
    specialize(reflection, constants);
  }
  StageInfo(const StageInfo&) = delete;
  StageInfo& operator=(const StageInfo&) = delete;

 private:
  void specialize(const Reflection& reflection, std::span<const ShaderValue> constants) {
    for (const SpecializationConstant& constant : reflection.constants) {
      if ((constant.stages & static_cast<VkShaderStageFlags>(create.stage)) == 0) continue;
      for (const ShaderValue& value : constants) {
        if (value.name != constant.name) continue;
        entries.push_back({constant.id, static_cast<uint32_t>(data.size() * sizeof(uint32_t)), sizeof(uint32_t)});
        data.push_back(encode_value(value, constant.type, reflection.name));
        break;
      }
    }
    if (entries.empty()) return;
    specialization.mapEntryCount = static_cast<uint32_t>(entries.size());
    specialization.pMapEntries = entries.data();
    specialization.dataSize = data.size() * sizeof(uint32_t);
    specialization.pData = data.data();
    create.pSpecializationInfo = &specialization;
  }
};

/// A shader output without attachment, or of the wrong kind, would be lost without a word.
void check_outputs(const Reflection& reflection, const AttachmentFormats& formats) {
  for (const FragmentOutput& output : reflection.outputs) {
    const std::string place = "shader " + reflection.name + ": output " + in_quotes(output.name);
    if (output.location >= formats.colors.size()) {
      throw Error(ExitCode::invalid_input, place + " at location " + std::to_string(output.location) +
                                               " has no attachment; there are " +
                                               std::to_string(formats.colors.size()));
    }
    const VkFormat format = formats.colors[output.location];
    if (format != VK_FORMAT_UNDEFINED && numeric_class(format) != output.numeric) {
      throw Error(ExitCode::invalid_input, place + " and its attachment are not both float or both uint");
    }
  }
}

/// The fixed state of our graphics pipelines, with all that its create info points to.
struct GraphicsState {
  VkPipelineVertexInputStateCreateInfo vertex_input{};
  VkPipelineInputAssemblyStateCreateInfo assembly{};
  VkPipelineViewportStateCreateInfo viewport{};
  VkPipelineRasterizationStateCreateInfo raster{};
  VkPipelineMultisampleStateCreateInfo samples{};
  VkPipelineDepthStencilStateCreateInfo depth{};
  std::vector<VkPipelineColorBlendAttachmentState> blend_attachments;
  VkPipelineColorBlendStateCreateInfo blend{};
  std::array<VkDynamicState, 2> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
  VkPipelineDynamicStateCreateInfo dynamic{};
  VkPipelineRenderingCreateInfo rendering{};
  VkGraphicsPipelineCreateInfo create{};

  explicit GraphicsState(const AttachmentFormats& formats) {
    vertex_input.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    raster.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    raster.cullMode = VK_CULL_MODE_NONE;
    raster.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    raster.lineWidth = 1;
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    const bool has_depth = formats.depth != VK_FORMAT_UNDEFINED;
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = has_depth ? VK_TRUE : VK_FALSE;
    depth.depthWriteEnable = depth.depthTestEnable;
    depth.depthCompareOp = VK_COMPARE_OP_LESS_OR_EQUAL;
    VkPipelineColorBlendAttachmentState write_all{};
    write_all.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    blend_attachments.assign(formats.colors.size(), write_all);
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = static_cast<uint32_t>(blend_attachments.size());
    blend.pAttachments = blend_attachments.data();
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
    rendering.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO;
    rendering.colorAttachmentCount = static_cast<uint32_t>(formats.colors.size());
    rendering.pColorAttachmentFormats = formats.colors.data();
    rendering.depthAttachmentFormat = formats.depth;
    connect();
  }
  GraphicsState(const GraphicsState&) = delete;
  GraphicsState& operator=(const GraphicsState&) = delete;

 private:
  void connect() {
    create.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    create.pNext = &rendering;
    create.pVertexInputState = &vertex_input;
    create.pInputAssemblyState = &assembly;
    create.pViewportState = &viewport;
    create.pRasterizationState = &raster;
    create.pMultisampleState = &samples;
    create.pDepthStencilState = &depth;
    create.pColorBlendState = &blend;
    create.pDynamicState = &dynamic;
  }
};

DescriptorSetLayoutHandle make_set_layout(const Device& device, const Reflection& reflection) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const Binding& binding : reflection.bindings) {
    bindings.push_back({binding.binding, descriptor_type(binding.kind), binding.count, binding.stages, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.bindingCount = static_cast<uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  check(vkCreateDescriptorSetLayout(device.get(), &info, nullptr, &layout),
        "vkCreateDescriptorSetLayout for " + reflection.name);
  return DescriptorSetLayoutHandle(device.ref(), layout);
}

}  // namespace

ShaderProgram make_program(std::vector<SpirvModule> modules) {
  ShaderProgram program;
  program.reflection = reflect(modules);
  Hasher hasher;
  for (const SpirvModule& module : modules) {
    hasher.number(static_cast<uint64_t>(module.stage));
    hasher.number(module.words.size());
    hasher.bytes(module.words.data(), module.words.size() * sizeof(uint32_t));
  }
  program.identity = hasher.value();
  program.modules = std::move(modules);
  return program;
}

Pipeline::Pipeline(const Device& device, const ShaderProgram& program, std::span<const ShaderValue> constants,
                   VkPipelineCache cache)
    : reflection_(program.reflection) {
  if (!program.compute()) throw Error(ExitCode::run_failed, "shader " + reflection_.name + " is no compute shader");
  require_known_names(reflection_, constants);
  create_layouts(device);
  const StageInfo stage(device, program.modules.front(), reflection_, constants);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage = stage.create;
  info.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateComputePipelines(device.get(), cache, 1, &info, nullptr, &pipeline),
        "vkCreateComputePipelines for " + reflection_.name);
  pipeline_ = PipelineHandle(device.ref(), pipeline);
}

Pipeline::Pipeline(const Device& device, const ShaderProgram& program, std::span<const ShaderValue> constants,
                   const AttachmentFormats& formats, VkPipelineCache cache)
    : reflection_(program.reflection), bind_point_(VK_PIPELINE_BIND_POINT_GRAPHICS) {
  if (program.modules.size() != 2) {
    throw Error(ExitCode::run_failed, "shader " + reflection_.name + " is no pair of vertex and fragment shader");
  }
  require_known_names(reflection_, constants);
  check_outputs(reflection_, formats);
  create_layouts(device);
  const StageInfo vertex(device, program.modules[0], reflection_, constants);
  const StageInfo fragment(device, program.modules[1], reflection_, constants);
  const std::array stages{vertex.create, fragment.create};
  GraphicsState state(formats);
  state.create.stageCount = static_cast<uint32_t>(stages.size());
  state.create.pStages = stages.data();
  state.create.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  check(vkCreateGraphicsPipelines(device.get(), cache, 1, &state.create, nullptr, &pipeline),
        "vkCreateGraphicsPipelines for " + reflection_.name);
  pipeline_ = PipelineHandle(device.ref(), pipeline);
}

void Pipeline::create_layouts(const Device& device) {
  const uint32_t push_limit = device.info().limits.maxPushConstantsSize;
  if (reflection_.push_constant_size > push_limit) {
    throw Error(ExitCode::invalid_input, "shader " + reflection_.name + " has " +
                                             std::to_string(reflection_.push_constant_size) +
                                             " bytes of push constants; device '" + device.info().name + "' allows " +
                                             std::to_string(push_limit));
  }
  set_layout_ = make_set_layout(device, reflection_);
  const VkDescriptorSetLayout set_layout = set_layout_.get();
  const VkPushConstantRange range{reflection_.push_constant_stages, 0, (reflection_.push_constant_size + 3) / 4 * 4};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set_layout;
  info.pushConstantRangeCount = range.size > 0 ? 1 : 0;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  check(vkCreatePipelineLayout(device.get(), &info, nullptr, &layout),
        "vkCreatePipelineLayout for " + reflection_.name);
  layout_ = PipelineLayoutHandle(device.ref(), layout);
}

void Pipeline::bind(VkCommandBuffer commands, VkDescriptorSet set, std::span<const std::byte> push_constants) const {
  if (push_constants.size() != reflection_.push_constant_size) {
    throw Error(ExitCode::run_failed, "shader " + reflection_.name + " takes " +
                                          std::to_string(reflection_.push_constant_size) +
                                          " bytes of push constants, not " + std::to_string(push_constants.size()));
  }
  vkCmdBindPipeline(commands, bind_point_, pipeline_.get());
  if (set != VK_NULL_HANDLE) vkCmdBindDescriptorSets(commands, bind_point_, layout_.get(), 0, 1, &set, 0, nullptr);
  if (push_constants.empty()) return;
  vkCmdPushConstants(commands, layout_.get(), reflection_.push_constant_stages, 0,
                     static_cast<uint32_t>(push_constants.size()), push_constants.data());
}

}  // namespace lightloom::gpu
