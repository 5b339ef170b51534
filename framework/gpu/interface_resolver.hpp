#pragma once

#include <glslang/Public/ShaderLang.h>

#include <map>
#include <string>
#include <vector>

namespace lightloom::gpu {

/// Gives every resource of a program a binding in set 0 and every varying a location, by name: one resolver serves all
/// stages of a program, in the order of the pipeline, so that a name means the same thing in each.
class InterfaceResolver final : public glslang::TIoMapResolver {
 public:
  /// Inputs of the fragment stage that the vertex stage does not write.
  [[nodiscard]] const std::vector<std::string>& unwritten_inputs() const { return unwritten_inputs_; }

  bool validateBinding(EShLanguage, glslang::TVarEntryInfo&) override { return true; }
  int resolveBinding(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  int resolveSet(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  int resolveUniformLocation(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  bool validateInOut(EShLanguage, glslang::TVarEntryInfo&) override { return true; }
  int resolveInOutLocation(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  int resolveInOutComponent(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  int resolveInOutIndex(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  void notifyBinding(EShLanguage, glslang::TVarEntryInfo&) override {}
  void notifyInOut(EShLanguage stage, glslang::TVarEntryInfo& entry) override;
  void beginNotifications(EShLanguage) override {}
  void endNotifications(EShLanguage) override {}
  void beginResolve(EShLanguage) override {}
  void endResolve(EShLanguage) override {}
  void beginCollect(EShLanguage) override {}
  void endCollect(EShLanguage) override {}
  void reserverStorageSlot(glslang::TVarEntryInfo&, TInfoSink&) override {}
  void reserverResourceSlot(glslang::TVarEntryInfo&, TInfoSink&) override {}
  void addStage(EShLanguage, glslang::TIntermediate&) override {}

 private:
  using Locations = std::map<std::string, int>;
  static constexpr int kMaxLocations = 128;

  /// First run of `size` free slots.
  static int first_free(std::vector<bool>& used, int size);
  static void occupy(std::vector<bool>& used, int location, int size);

  std::map<std::string, int> bindings_;
  Locations varyings_;
  std::vector<bool> used_varyings_ = std::vector<bool>(kMaxLocations);
  std::vector<bool> used_outputs_ = std::vector<bool>(kMaxLocations);
  std::vector<std::string> unwritten_inputs_;
};

}  // namespace lightloom::gpu
