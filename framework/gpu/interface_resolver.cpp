#include "framework/gpu/interface_resolver.hpp"

#include <glslang/MachineIndependent/iomapper.h>

#include <algorithm>

namespace lightloom::gpu {
namespace {

std::string name_of(const glslang::TVarEntryInfo& entry) {
  return entry.symbol->getAccessName().c_str();
}

/// gl_Position and the like: blocks of built-ins count as built-in by their first member.
bool is_built_in(const glslang::TType& type) {
  if (type.isBuiltIn()) return true;
  return type.isStruct() && (type.getStruct()->empty() || (*type.getStruct())[0].type->isBuiltIn());
}

bool is_fragment_output(EShLanguage stage, const glslang::TType& type) {
  return stage == EShLangFragment && type.getQualifier().isPipeOutput();
}

bool is_fragment_input(EShLanguage stage, const glslang::TType& type) {
  return stage == EShLangFragment && type.getQualifier().isPipeInput();
}

}  // namespace

void InterfaceResolver::occupy(std::vector<bool>& used, int location, int size) {
  for (int i = location; i < std::min(location + size, kMaxLocations); ++i) used[static_cast<size_t>(i)] = true;
}

int InterfaceResolver::first_free(std::vector<bool>& used, int size) {
  int run = 0;
  for (int i = 0; i < kMaxLocations; ++i) {
    run = used[static_cast<size_t>(i)] ? 0 : run + 1;
    if (run < size) continue;
    occupy(used, i + 1 - size, size);
    return i + 1 - size;
  }
  return -1;
}

int InterfaceResolver::resolveBinding(EShLanguage, glslang::TVarEntryInfo& entry) {
  if (entry.symbol->getQualifier().isPushConstant()) return entry.newBinding = -1;
  const auto next = static_cast<int>(bindings_.size());
  return entry.newBinding = bindings_.emplace(name_of(entry), next).first->second;
}

int InterfaceResolver::resolveSet(EShLanguage, glslang::TVarEntryInfo& entry) {
  return entry.newSet = entry.symbol->getQualifier().isPushConstant() ? -1 : 0;
}

int InterfaceResolver::resolveUniformLocation(EShLanguage, glslang::TVarEntryInfo& entry) {
  return entry.newLocation = -1;
}

int InterfaceResolver::resolveInOutComponent(EShLanguage, glslang::TVarEntryInfo& entry) {
  return entry.newComponent = -1;
}

int InterfaceResolver::resolveInOutIndex(EShLanguage, glslang::TVarEntryInfo& entry) {
  return entry.newIndex = -1;
}

void InterfaceResolver::notifyInOut(EShLanguage stage, glslang::TVarEntryInfo& entry) {
  const glslang::TType& type = entry.symbol->getType();
  if (is_built_in(type) || !type.getQualifier().hasLocation()) return;
  const int location = static_cast<int>(type.getQualifier().layoutLocation);
  const int size = glslang::TIntermediate::computeTypeLocationSize(type, stage);
  if (is_fragment_output(stage, type)) {
    occupy(used_outputs_, location, size);
  } else {
    occupy(used_varyings_, location, size);
    if (!is_fragment_input(stage, type)) varyings_.emplace(name_of(entry), location);
  }
}

int InterfaceResolver::resolveInOutLocation(EShLanguage stage, glslang::TVarEntryInfo& entry) {
  const glslang::TType& type = entry.symbol->getType();
  entry.newLocation = -1;
  if (is_built_in(type)) return -1;
  const std::string name = name_of(entry);
  if (is_fragment_input(stage, type)) {
    const auto written = varyings_.find(name);
    if (written != varyings_.end()) return entry.newLocation = written->second;
    if (!type.getQualifier().hasLocation()) unwritten_inputs_.push_back(name);
    return -1;
  }
  if (type.getQualifier().hasLocation()) return -1;
  std::vector<bool>& used = is_fragment_output(stage, type) ? used_outputs_ : used_varyings_;
  entry.newLocation = first_free(used, glslang::TIntermediate::computeTypeLocationSize(type, stage));
  if (!is_fragment_output(stage, type)) varyings_.emplace(name, entry.newLocation);
  return entry.newLocation;
}

}  // namespace lightloom::gpu
