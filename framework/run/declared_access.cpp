#include "framework/run/declared_access.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace lightloom::run {
namespace {

std::string class_name(NumericClass numeric) {
  return numeric == NumericClass::unsigned_integer ? "unsigned integers" : "floating-point numbers";
}

std::string_view direction_name(Direction direction) {
  if (direction == Direction::in) return "input";
  return direction == Direction::out ? "output" : "scratch";
}

std::string shader_name(const Port& port, const PortPart& part) {
  return (port.direction == Direction::out ? "out_" : "") + port.name + (part.name.empty() ? "" : "_" + part.name);
}

/// What a name of a shader stands for in a port table.
struct Declared {
  const Port& port;
  const PortPart& part;
};

std::optional<Declared> find_declared(const PassType& type, std::string_view name) {
  for (const Port& port : type.ports)
    for (const PortPart& part : port.parts)
      if (shader_name(port, part) == name) return Declared{port, part};
  return std::nullopt;
}

bool is_image(gpu::BindingKind kind) {
  return kind == gpu::BindingKind::sampled_image || kind == gpu::BindingKind::combined_sampler ||
         kind == gpu::BindingKind::storage_image;
}

/// Stages of shaders as stages of pipelines, those that read or write values.
VkPipelineStageFlags2 pipeline_stages(VkShaderStageFlags stages) {
  VkPipelineStageFlags2 result = 0;
  if ((stages & VK_SHADER_STAGE_COMPUTE_BIT) != 0) result |= VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  if ((stages & VK_SHADER_STAGE_FRAGMENT_BIT) != 0) result |= VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  if ((stages & VK_SHADER_STAGE_VERTEX_BIT) != 0) result |= VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT;
  return result;
}

/// One image of a shader against its port.
class ImageCheck {
 public:
  ImageCheck(const PassType& type, const Declared& declared, const gpu::Binding& binding, const PlaceOf& place)
      : type_(type),
        port_(declared.port),
        part_(declared.part),
        access_(access_info(port_.access)),
        binding_(binding),
        place_(place) {}

  void run() const {
    check_shape();
    port_.direction == Direction::in ? check_read() : check_written();
    // What a pass keeps to itself its own commands may touch in any stage, and any may read what one of them wrote.
    const VkPipelineStageFlags2 outside = pipeline_stages(binding_.stages) & ~access_.stages;
    const bool seen_outside = port_.direction == Direction::in    ? binding_.reads
                              : port_.direction == Direction::out ? binding_.writes
                                                                  : false;
    if (outside != 0 && seen_outside)
      fail("is used in another stage of the pipeline", "declare an access of the stage that uses it");
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
    throw Error(ExitCode::run_failed,
                "pass type '" + type_.name + "': " + std::string(direction_name(port_.direction)) + " '" + port_.name +
                    (part_.name.empty() ? "" : "." + part_.name) + "' is declared " + std::string(access_.name) + ", " +
                    (port_.dimension == Dimension::d3 ? "3D" : "2D") + (port_.array ? ", a history range" : "") + ", " +
                    std::string(format_info(part_.format).name) + ", but " + place_(binding_.name) + ": " +
                    in_quotes(binding_.name) + " " + what,
                hint);
  }

  void check_shape() const {
    using enum gpu::ImageShape;
    const gpu::ImageShape wanted = port_.dimension == Dimension::d3 ? d3 : port_.array ? d2_array : d2;
    if (binding_.shape != wanted)
      fail(binding_.shape == d3         ? "is 3D"
           : binding_.shape == d2       ? "is a single 2D image"
           : binding_.shape == d2_array ? "is an array of images"
                                        : "has a shape that no port can have",
           "the two must agree");
    if (binding_.numeric != format_info(part_.format).numeric)
      fail("holds " + class_name(binding_.numeric),
           "texture2D, image2D: floating point; utexture2D, uimage2D: unsigned");
  }

  void check_read() const {
    const bool storage = binding_.kind == gpu::BindingKind::storage_image;
    if (storage && (binding_.writable || binding_.writes))
      fail("is a storage image that " + std::string(binding_.writes ? "is" : "may be") + " written",
           "an input is read: declare a texture, or with access compute_storage_read a 'readonly' image");
    const bool loaded = port_.access == Access::compute_storage_read;
    if (storage && !loaded) fail("is a storage image", "declare a texture, or the port's access compute_storage_read");
    if (!storage && loaded)
      fail("is a texture", "declare a 'readonly' image, or the port's access compute_sampled_read");
  }

  void check_written() const {
    // A later command of the pass may read as a texture what an earlier one wrote.
    if (binding_.kind != gpu::BindingKind::storage_image) return;
    const bool storage = port_.access == Access::compute_storage_write ||
                         port_.access == Access::compute_storage_read_write ||
                         port_.access == Access::fragment_storage_read_write;
    if (!storage) fail("is a storage image", "declare an access that stores");
    if (!access_.reads && binding_.reads)
      fail("is read as well", "declare it 'writeonly', or the port's access compute_storage_read_write");
    if (binding_.format && *binding_.format != part_.format)
      fail("has the format " + std::string(format_info(*binding_.format).name), "name the same format in both places");
  }

  const PassType& type_;
  const Port& port_;
  const PortPart& part_;
  const AccessInfo& access_;
  const gpu::Binding& binding_;
  const PlaceOf& place_;
};

bool can_hold(gpu::ScalarType type, const Param& param) {
  using enum gpu::ScalarType;
  switch (param.type) {
    case ParamType::boolean:
      return type == boolean || type == uint32;
    case ParamType::integer:
      return type == int32 || (type == uint32 && param.minimum && *param.minimum >= 0);
    case ParamType::real:
      return type == float32;
    case ParamType::choice:
      break;
  }
  return type == uint32 || type == int32;
}

std::string_view type_name(ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return "a boolean";
    case ParamType::integer:
      return "an integer";
    case ParamType::real:
      return "a real number";
    case ParamType::choice:
      break;
  }
  return "a choice";
}

void check_constant(const PassType& type, const std::string& name, gpu::ScalarType given, const PlaceOf& place) {
  const Param* param = type.find_param(name);
  if (param == nullptr || can_hold(given, *param)) return;
  const bool negative = param->type == ParamType::integer && given == gpu::ScalarType::uint32;
  throw Error(ExitCode::run_failed,
              "pass type '" + type.name + "': param '" + name + "' is " + std::string(type_name(param->type)) +
                  (negative ? " that may be negative" : "") + ", but " + place(name) + ": " + in_quotes(name) +
                  " is of type " + std::string(gpu::to_string(given)),
              "booleans are bool (as push constants uint), integers int or uint, choices uint, real numbers float");
}

void check_fragment_output(const PassType& type, const gpu::FragmentOutput& output, const PlaceOf& place) {
  const auto declared = find_declared(type, output.name);
  if (!declared) return;  // drawing reports it
  const bool attachment = declared->port.access == Access::color_attachment_write;
  const NumericClass wanted = format_info(declared->part.format).numeric;
  if (attachment && wanted == output.numeric) return;
  throw Error(ExitCode::run_failed,
              "pass type '" + type.name + "': output '" + declared->port.name + "' is declared " +
                  std::string(access_info(declared->port.access).name) + " of " + class_name(wanted) + ", but " +
                  place(output.name) + ": " + in_quotes(output.name) + " is an attachment of " +
                  class_name(output.numeric),
              "what a fragment shader puts out is drawn into a port with access color_attachment_write");
}

std::vector<std::string> written_images(const gpu::Reflection& shader) {
  std::vector<std::string> names;
  for (const gpu::Binding& binding : shader.bindings)
    if (binding.writes) names.push_back(binding.name);
  for (const gpu::FragmentOutput& output : shader.outputs) names.push_back(output.name);
  return names;
}

}  // namespace

void require_declared_access(const PassType& type, const gpu::Reflection& shader, const PlaceOf& place) {
  for (const gpu::Binding& binding : shader.bindings) {
    if (!is_image(binding.kind)) continue;
    if (const auto declared = find_declared(type, binding.name)) ImageCheck(type, *declared, binding, place).run();
  }
  for (const gpu::FragmentOutput& output : shader.outputs) check_fragment_output(type, output, place);
  for (const gpu::BlockMember& member : shader.push_constants) check_constant(type, member.name, member.type, place);
  for (const gpu::SpecializationConstant& constant : shader.constants)
    check_constant(type, constant.name, constant.type, place);
}

void AccessWatch::runs(const GraphPass& pass, const gpu::Reflection& shader, const PlaceOf& place) {
  if (checked_.insert({pass.type, &shader}).second) require_declared_access(*pass.type, shader, place);
  if (ended_.contains(&pass)) return;
  for (const gpu::Binding& binding : shader.bindings) bound_[pass.name].insert(binding.name);
  for (std::string& name : written_images(shader)) written_.insert(std::move(name));
}

void AccessWatch::clears(const GraphPass& pass, std::string_view port) {
  if (ended_.contains(&pass)) return;
  for (const Use& use : pass.outputs)
    if (use.port == port) written_.insert(use.shader_name);
}

void AccessWatch::ends(const Graph& graph, const GraphPass& pass) {
  if (!ended_.insert(&pass).second) return;
  const std::set<std::string> written = std::exchange(written_, {});
  for (const Use& use : pass.outputs) {
    // What a persistent one holds already may be all that it needs.
    if (written.contains(use.shader_name) || graph.values[use.value].persistent || !graph.values[use.value].read)
      continue;
    throw Error(ExitCode::run_failed,
                "pass '" + pass.name + "' (" + pass.type->name + ") recorded nothing that writes its output '" +
                    use.port + (use.part.empty() ? "" : "." + use.part) + "'",
                "store to an image '" + use.shader_name + "' in a shader that it dispatches, or clear the port");
  }
}

}  // namespace lightloom::run
