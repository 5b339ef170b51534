#include "framework/gpu/glslang_compile.hpp"

#include <glslang/MachineIndependent/iomapper.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <memory>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/interface_resolver.hpp"

namespace lightloom::gpu {
namespace {

constexpr int kDefaultVersion = 460;
constexpr auto kMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules | EShMsgCascadingErrors);

/// Keeps the tables of glslang's built-in functions, which take a third of a second to make.
struct GlslangProcess {
  GlslangProcess() { glslang::InitializeProcess(); }
  ~GlslangProcess() { glslang::FinalizeProcess(); }
  GlslangProcess(const GlslangProcess&) = delete;
  GlslangProcess& operator=(const GlslangProcess&) = delete;
};

class Includer final : public glslang::TShader::Includer {
 public:
  Includer(const IncludeTexts& texts, std::span<const std::filesystem::path> directories) : texts_(texts) {
    missing_ = "not found in the shader folders";
    for (const auto& directory : directories) missing_ += " " + in_quotes(directory.string());
  }
  IncludeResult* includeLocal(const char* header, const char*, size_t) override {
    const auto found = texts_.find(header);
    if (found == texts_.end()) return nullptr;
    // A few files that include each other twice over, without a cycle, would never come to an end.
    if (++files_ > kMostFiles || found->second.size() > kMostShaderBytes - bytes_) {
      too_many_ = true;
      return nullptr;
    }
    bytes_ += found->second.size();
    const std::string_view text = without_mark(found->second);
    return new IncludeResult(found->first, text.data(), text.size(), nullptr);
  }
  /// Tried where includeLocal finds nothing; its result carries the reason.
  IncludeResult* includeSystem(const char*, const char*, size_t) override {
    const std::string& reason = too_many_ ? endless_ : missing_;
    return new IncludeResult("", reason.data(), reason.size(), nullptr);
  }
  void releaseInclude(IncludeResult* result) override { delete result; }

 private:
  static constexpr uint32_t kMostFiles = 10'000;
  const std::string endless_ = "more is included than " + std::to_string(kMostFiles) + " files or " +
                               std::to_string(kMostShaderBytes) + " bytes: do these include each other over and over?";
  const IncludeTexts& texts_;
  std::string missing_;
  uint64_t files_ = 0;
  uint64_t bytes_ = 0;
  bool too_many_ = false;
};

EShLanguage language_of(Stage stage) {
  switch (stage) {
    case Stage::vertex:
      return EShLangVertex;
    case Stage::fragment:
      return EShLangFragment;
    case Stage::compute:
      break;
  }
  return EShLangCompute;
}

/// The errors of a glslang log, without its prefix and its closing count.
std::vector<std::string> errors_of(const std::string& log) {
  constexpr std::string_view kPrefix = "ERROR: ";
  std::vector<std::string> errors;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(kPrefix)) continue;
    line.erase(0, kPrefix.size());
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (line.find("compilation errors.  No code generated") == std::string::npos) errors.push_back(std::move(line));
  }
  return errors;
}

std::string names_of(std::span<const ShaderSource> stages) {
  std::string names;
  for (const ShaderSource& stage : stages) names += (names.empty() ? "" : " + ") + stage.name;
  return names;
}

[[noreturn]] void fail(const std::string& what, const std::string& log) {
  std::vector<std::string> errors = errors_of(log);
  const std::string first = errors.empty() ? "no reason given" : errors.front();
  if (!errors.empty()) errors.erase(errors.begin());
  throw Error(ExitCode::invalid_input, "shader " + what + ": " + first,
              errors.empty() ? "" : "further errors:\n" + join(errors, "\n"));
}

/// One stage, with what its parser points into.
struct ParsedStage {
  std::unique_ptr<glslang::TShader> shader;
  const char* text = nullptr;
  const char* name = nullptr;
  int length = 0;
};

void parse(ParsedStage& parsed, const ShaderSource& source, const std::string& preamble, Includer& includer) {
  const EShLanguage language = language_of(source.stage);
  parsed.shader = std::make_unique<glslang::TShader>(language);
  const std::string_view text = without_mark(source.text);
  parsed.text = text.data();
  parsed.length = static_cast<int>(text.size());
  parsed.name = source.name.c_str();
  glslang::TShader& shader = *parsed.shader;
  shader.setStringsWithLengthsAndNames(&parsed.text, &parsed.length, &parsed.name, 1);
  shader.setPreamble(preamble.c_str());
  shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 100);
  shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_3);
  shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_6);
  shader.setAutoMapBindings(true);
  shader.setAutoMapLocations(true);
  if (!shader.parse(GetDefaultResources(), kDefaultVersion, ECoreProfile, false, false, kMessages, includer)) {
    fail(source.name + " does not compile", shader.getInfoLog());
  }
}

SpirvModule generate(const glslang::TIntermediate& intermediate, const ShaderSource& source) {
  glslang::SpvOptions options;
  options.disableOptimizer = false;
  options.validate = true;
  spv::SpvBuildLogger logger;
  SpirvModule module{.name = source.name, .stage = source.stage, .words = {}};
  glslang::GlslangToSpv(intermediate, module.words, &logger, &options);
  const std::string log = logger.getAllMessages();
  if (module.words.empty() || log.find("error") != std::string::npos) {
    throw Error(ExitCode::invalid_input, "shader " + source.name + " gives no valid SPIR-V: " + log);
  }
  return module;
}

std::string preamble_of(const ShaderDefines& defines) {
  std::string preamble =
      "#extension GL_GOOGLE_include_directive : require\n"
      "#extension GL_EXT_samplerless_texture_functions : require\n";
  for (const auto& [name, value] : defines) preamble += "#define " + name + " " + value + "\n";
  return preamble;
}

}  // namespace

std::string compiler_identity() {
  const glslang::Version version = glslang::GetVersion();
  return "glslang " + std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.patch) + version.flavor + ", generator " +
         std::to_string(glslang::GetSpirvGeneratorVersion()) + ", Vulkan 1.3, SPIR-V 1.6, bindings by name, optimised";
}

std::vector<SpirvModule> compile_glsl(std::span<const ShaderSource> stages, const ShaderDefines& defines,
                                      const IncludeTexts& includes,
                                      std::span<const std::filesystem::path> include_directories) {
  static const GlslangProcess process;
  const std::string preamble = preamble_of(defines);
  std::vector<ParsedStage> parsed(stages.size());
  // Declared after the shaders: glslang wants the program gone before them.
  glslang::TProgram program;
  for (size_t i = 0; i < stages.size(); ++i) {
    Includer includer(includes, include_directories);
    parse(parsed[i], stages[i], preamble, includer);
    program.addShader(parsed[i].shader.get());
  }
  if (!program.link(kMessages)) fail(names_of(stages) + " does not link", program.getInfoLog());
  InterfaceResolver resolver;
  glslang::TIoMapper mapper;
  if (!program.mapIO(&resolver, &mapper)) {
    fail(names_of(stages) + " has an interface that cannot be mapped", program.getInfoLog());
  }
  if (!resolver.unwritten_inputs().empty()) {
    throw Error(ExitCode::invalid_input, "shader " + names_of(stages) + ": the fragment stage reads " +
                                             in_quotes(resolver.unwritten_inputs().front()) +
                                             ", which the vertex stage does not write");
  }
  std::vector<SpirvModule> modules;
  for (const ShaderSource& source : stages) {
    modules.push_back(generate(*program.getIntermediate(language_of(source.stage)), source));
  }
  return modules;
}

}  // namespace lightloom::gpu
