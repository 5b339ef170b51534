#include "framework/run/compute_type.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/run/compute_ports.hpp"
#include "framework/run/scene_reads.hpp"

namespace lightloom::run {
namespace {

/// What the node gives a param, through a param of the graph as well; null if nothing, or what is no scalar.
const ParamValue* given_value(const ComputeNode& node, std::string_view name) {
  const auto find = [](const std::vector<ScalarSpec>& list, std::string_view wanted) -> const ParamValue* {
    for (const ScalarSpec& scalar : list)
      if (scalar.name == wanted && !scalar.broken) return &scalar.value;
    return nullptr;
  };
  const ParamValue* value = find(node.pass.params, name);
  const std::string* text = value == nullptr ? nullptr : std::get_if<std::string>(value);
  if (text == nullptr || !text->starts_with('$')) return value;
  return find(node.graph_params, std::string_view(*text).substr(1));
}

bool is_given(const ComputeNode& node, std::string_view name) {
  return std::any_of(node.pass.params.begin(), node.pass.params.end(),
                     [&](const ScalarSpec& scalar) { return scalar.name == name; });
}

/// The constants of a shader as rows of a param table.
class ComputeParams {
 public:
  ComputeParams(const ComputeNode& node, const ComputeShader& shader, const std::vector<Port>& ports,
                Diagnostics& diagnostics)
      : node_(node), shader_(shader), ports_(ports), diagnostics_(diagnostics) {}

  std::vector<Param> run() {
    for (const gpu::BlockMember& member : shader_.reflection.push_constants) {
      if (is_provided(member.name)) continue;
      const bool scalar = member.components == 1 && member.columns == 1 && !member.array;
      add(member.name, scalar ? member.type : gpu::ScalarType::other, "push constant", std::nullopt);
    }
    for (const gpu::SpecializationConstant& constant : shader_.reflection.constants)
      if (!is_provided(constant.name))
        add(constant.name, constant.type, "specialization constant", constant.default_bits);
    const bool on_grid =
        std::any_of(ports_.begin(), ports_.end(), [](const Port& port) { return port.extent == ExtentRule::grid; });
    if (on_grid) add_resolution();
    return std::move(params_);
  }

 private:
  /// pass_context.hpp lists what is.
  bool is_provided(const std::string& name) const {
    if (is_scene_constant(name) || tells_storage(name)) return true;
    return std::any_of(ports_.begin(), ports_.end(), [&](const Port& port) {
      if (port.direction == Direction::out) return name == port.name + "_wanted";
      if (port.optional && name == port.name + "_bound") return true;
      return port.array && (name == port.name + "_count" || name == port.name + "_first_age" ||
                            name == port.name + "_ring" || name == port.name + "_newest_layer");
    });
  }

  /// IMAGE_largest, IMAGE_bits.
  bool tells_storage(const std::string& name) const {
    return std::any_of(
        shader_.reflection.bindings.begin(), shader_.reflection.bindings.end(),
        [&](const gpu::Binding& image) { return name == image.name + "_largest" || name == image.name + "_bits"; });
  }

  void add(const std::string& name, gpu::ScalarType type, const std::string& kind,
           const std::optional<uint32_t>& default_bits) {
    if (type == gpu::ScalarType::other)
      return error(shader_.place(name) + ": " + kind + " " + in_quotes(name) + " cannot be a param",
                   "params are single bools, ints, uints and floats");
    Param param;
    param.name = name;
    param.doc = kind + " of the shader";
    set_type(param, type, default_bits.value_or(0));
    const bool given = is_given(node_, name);
    if (!default_bits && !given)
      diagnostics_.error("missing-param", node_.pass.where,
                         "pass '" + node_.pass.name + "' needs a value for param " + in_quotes(name) + ", a " +
                             std::string(gpu::to_string(type)) + " at " + shader_.place(name),
                         "\"params\": {\"" + name + "\": …}");
    params_.push_back(std::move(param));
  }

  void set_type(Param& param, gpu::ScalarType type, uint32_t bits) const {
    const ParamValue* given = given_value(node_, param.name);
    // A bool of a push constant is a uint in SPIR-V, so who writes true or false means one.
    const bool boolean = type == gpu::ScalarType::boolean ||
                         (type == gpu::ScalarType::uint32 && given != nullptr && std::holds_alternative<bool>(*given));
    if (boolean) {
      param.type = ParamType::boolean;
      param.default_value = bits != 0;
    } else if (type == gpu::ScalarType::float32) {
      param.type = ParamType::real;
      param.default_value = static_cast<double>(std::bit_cast<float>(bits));
    } else {
      param.type = ParamType::integer;
      param.default_value = int64_t{static_cast<int32_t>(bits)};
      param.minimum = type == gpu::ScalarType::uint32 ? 0.0 : std::numeric_limits<int32_t>::lowest();
      param.maximum = std::numeric_limits<int32_t>::max();
    }
  }

  /// The grid's size is that of the param `resolution`, whether or not the shader asks for it.
  void add_resolution() {
    const std::string name = "resolution";
    auto found = std::find_if(params_.begin(), params_.end(), [&](const Param& param) { return param.name == name; });
    if (found == params_.end()) {
      add(name, gpu::ScalarType::uint32, "size of the grid", std::nullopt);
      found = params_.end() - 1;
    }
    if (found->type != ParamType::integer)
      return error(shader_.place(name) + ": 'resolution' must be an int or uint, since an output has the grid's size",
                   "");
    found->minimum = 1;
    found->maximum = 1024;
    found->unit = "voxels";
    if (std::get<int64_t>(found->default_value) < 1) found->default_value = int64_t{1};
  }

  void error(const std::string& what, const std::string& hint) {
    diagnostics_.error("shader-interface", node_.pass.compute->shader.where, "pass '" + node_.pass.name + "': " + what,
                       hint);
  }

  const ComputeNode& node_;
  const ComputeShader& shader_;
  const std::vector<Port>& ports_;
  Diagnostics& diagnostics_;
  std::vector<Param> params_;
};

/// The output that has a thread for each texel: the one that the node names, else the first that it lists, else the
/// shader's first.
std::string thread_output(const PassSpec& pass, const PassType& type, Diagnostics& diagnostics) {
  std::vector<std::string> outputs;
  for (const Port& port : type.ports)
    if (port.direction == Direction::out) outputs.push_back(port.name);
  const auto has = [&](const std::string& name) {
    return std::find(outputs.begin(), outputs.end(), name) != outputs.end();
  };
  if (const auto& threads = pass.compute->threads) {
    if (!has(threads->text))
      diagnostics.error(
          "unknown-output", threads->where,
          "pass '" + pass.name + "': 'threads' names " + in_quotes(threads->text) + ", which is no output",
          did_you_mean(threads->text, outputs, "its outputs"));
    return threads->text;
  }
  for (const ComputeOutputSpec& spec : pass.compute->outputs)
    if (has(spec.name)) return spec.name;
  return outputs.empty() ? "" : outputs.front();
}

}  // namespace

std::optional<PassType> make_compute_type(const ComputeNode& node, const ComputeShader& shader,
                                          Diagnostics& diagnostics) {
  const size_t before = diagnostics.all().size();
  PassType type;
  type.name = kComputeType;
  type.version = static_cast<uint32_t>(shader.identity ^ (shader.identity >> 32));
  type.doc = node.pass.doc;
  type.ports = ComputePorts(node, shader, diagnostics).run();
  type.params = ComputeParams(node, shader, type.ports, diagnostics).run();
  type.reads = scene_reads(shader.reflection);
  type.needs.ray_query =
      std::any_of(shader.reflection.bindings.begin(), shader.reflection.bindings.end(),
                  [](const gpu::Binding& binding) { return binding.kind == gpu::BindingKind::acceleration_structure; });
  type.record = [file = shader.file, threads = thread_output(node.pass, type, diagnostics)](PassContext& context) {
    context.dispatch({file, context.output_extent(threads), {}});
  };
  if (diagnostics.all().size() > before) return std::nullopt;
  return type;
}

}  // namespace lightloom::run
