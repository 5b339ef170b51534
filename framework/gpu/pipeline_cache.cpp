#include <chrono>
#include <map>
#include <string>

#include "framework/base/hash.hpp"
#include "framework/gpu/pipeline.hpp"

namespace lightloom::gpu {
namespace {

/// The same values in another order, or as another type that means the same, give the same key.
std::string key_of(const ShaderProgram& program, std::span<const ShaderValue> constants) {
  std::map<std::string, uint32_t> bits;
  for (const ShaderValue& value : constants) {
    const SpecializationConstant* constant = program.reflection.find_constant(value.name);
    // A name that the shader does not have is reported when the pipeline is made.
    bits.emplace(value.name, constant == nullptr ? 0 : encode_value(value, constant->type, program.reflection.name));
  }
  std::string key = hex(program.identity);
  for (const auto& [name, value] : bits) key += ";" + name + "=" + std::to_string(value);
  return key;
}

}  // namespace

const Pipeline& PipelineCache::compute(const ShaderProgram& program, std::span<const ShaderValue> constants) {
  const std::string key = key_of(program, constants);
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  return make(key, [&] { return std::make_unique<Pipeline>(device_, program, constants, file_.get()); });
}

const Pipeline& PipelineCache::graphics(const ShaderProgram& program, std::span<const ShaderValue> constants,
                                        const AttachmentFormats& formats) {
  std::string key = key_of(program, constants) + "|" + std::to_string(formats.depth);
  for (VkFormat format : formats.colors) key += "," + std::to_string(format);
  if (const auto found = pipelines_.find(key); found != pipelines_.end()) return *found->second;
  return make(key, [&] { return std::make_unique<Pipeline>(device_, program, constants, formats, file_.get()); });
}

const Pipeline& PipelineCache::make(const std::string& key,
                                    const std::function<std::unique_ptr<Pipeline>()>& pipeline) {
  const auto start = std::chrono::steady_clock::now();
  const Pipeline& made = *pipelines_.emplace(key, pipeline()).first->second;
  milliseconds_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return made;
}

void PipelineCache::save() noexcept {
  if (pipelines_.size() == saved_) return;
  saved_ = pipelines_.size();
  file_.save();
}

}  // namespace lightloom::gpu
