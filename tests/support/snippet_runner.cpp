#include "tests/support/snippet_runner.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/transfer.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

constexpr uint32_t kLocalSize = 64;

/// `#line` makes the line numbers of messages those of the body.
std::string wrap(const std::string& body) {
  return "layout(local_size_x = " + std::to_string(kLocalSize) +
         ") in;\n"
         "layout(std430) readonly buffer SnippetInputs { float inputs[]; };\n"
         "layout(std430) buffer SnippetOutputs { float outputs[]; };\n"
         "layout(push_constant) uniform SnippetCount { uint snippet_invocations; };\n"
         "#line 1\n" +
         body +
         "\nvoid main() {\n"
         "  if (gl_GlobalInvocationID.x < snippet_invocations) evaluate(gl_GlobalInvocationID.x);\n"
         "}\n";
}

/// A storage buffer has at least one element.
gpu::Buffer make_buffer(gpu::Device& device, std::vector<float> values, const char* name) {
  if (values.empty()) values.push_back(0);
  gpu::Buffer buffer(device, values.size() * sizeof(float), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device,
                     name);
  gpu::upload_buffer(device, buffer, std::as_bytes(std::span<const float>(values)));
  return buffer;
}

}  // namespace

std::vector<float> run_snippet(gpu::Device& device, const std::string& body_glsl, std::span<const float> inputs,
                               size_t output_count, uint32_t invocations, std::span<const ShaderValue> constants) {
  const std::filesystem::path source = source_dir();
  gpu::ShaderCompiler compiler({.include_directories = {source / "shaders"}, .cache_directory = {}});
  const std::array stages{gpu::ShaderSource{.name = "snippet", .text = wrap(body_glsl), .stage = gpu::Stage::compute}};
  const gpu::Pipeline pipeline(device, gpu::make_program(compiler.compile(stages)), constants);
  const gpu::Buffer input = make_buffer(device, {inputs.begin(), inputs.end()}, "inputs");
  const gpu::Buffer output = make_buffer(device, std::vector<float>(output_count), "outputs");
  gpu::DescriptorAllocator descriptors(device);
  const VkDescriptorSet set = descriptors.allocate(
      pipeline, {{"SnippetInputs", gpu::resource(input)}, {"SnippetOutputs", gpu::resource(output)}});
  const std::array values{ShaderValue{.name = "snippet_invocations", .value = invocations}};
  const std::vector<std::byte> push_constants = gpu::encode_push_constants(pipeline.reflection(), values);
  device.run_commands([&](VkCommandBuffer commands) {
    gpu::record_full_barrier(commands);
    pipeline.bind(commands, set, push_constants);
    vkCmdDispatch(commands, (invocations + kLocalSize - 1) / kLocalSize, 1, 1);
  });
  const std::vector<std::byte> bytes = gpu::read_buffer(device, output);
  std::vector<float> outputs(output_count);
  if (output_count > 0) std::memcpy(outputs.data(), bytes.data(), output_count * sizeof(float));
  return outputs;
}

}  // namespace lightloom::test
