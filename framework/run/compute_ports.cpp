#include "framework/run/compute_ports.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/run/scene_reads.hpp"

namespace lightloom::run {
namespace {

constexpr Format kDefaultFormat = Format::rgba32_sfloat;

Dimension dimension_of(const gpu::Binding& binding) {
  return binding.shape == gpu::ImageShape::d3 ? Dimension::d3 : Dimension::d2;
}

std::string class_name(NumericClass numeric) {
  return numeric == NumericClass::unsigned_integer ? "unsigned integers" : "floating-point numbers";
}

const ComputeOutputSpec* find_spec(const PassSpec& pass, const std::string& output) {
  for (const ComputeOutputSpec& spec : pass.compute->outputs)
    if (spec.name == output) return &spec;
  return nullptr;
}

}  // namespace

std::vector<Port> ComputePorts::run() {
  for (const gpu::Binding& binding : shader_.reflection.bindings)
    if (!is_scene_binding(binding.name) && usable(binding) && !binding.name.starts_with(kOutputPrefix))
      add_input(binding);
  // After all inputs, whose sizes and kinds they may have.
  for (const gpu::Binding& binding : shader_.reflection.bindings)
    if (!is_scene_binding(binding.name) && binding.kind == gpu::BindingKind::storage_image &&
        binding.name.starts_with(kOutputPrefix))
      add_output(binding);
  check_outputs();
  return std::move(ports_);
}

void ComputePorts::error(std::string_view code, const SourceLocation& where, const std::string& what,
                         const std::string& hint) {
  diagnostics_.error(code, where, "pass '" + node_.pass.name + "': " + what, hint);
}

void ComputePorts::shader_error(const gpu::Binding& binding, const std::string& what, const std::string& hint) {
  error("shader-interface", node_.pass.compute->shader.where,
        shader_.place(binding.name) + ": " + in_quotes(binding.name) + " " + what, hint);
}

Port* ComputePorts::find_input(std::string_view name) {
  const auto found = std::find_if(ports_.begin(), ports_.end(), [&](const Port& port) {
    return port.direction == Direction::in && port.name == name;
  });
  return found == ports_.end() ? nullptr : &*found;
}

std::vector<std::string> ComputePorts::names(Direction direction) const {
  std::vector<std::string> result;
  for (const Port& port : ports_)
    if (port.direction == direction) result.push_back(port.name);
  return result;
}

bool ComputePorts::usable(const gpu::Binding& binding) {
  using enum gpu::BindingKind;
  const bool image = binding.kind == sampled_image || binding.kind == storage_image;
  if (!image) {
    const bool sampler = binding.kind == combined_sampler || binding.kind == gpu::BindingKind::sampler;
    const std::string kind(gpu::to_string(binding.kind));
    const bool vowel = std::string_view("aeiou").find(kind.front()) != std::string_view::npos;
    shader_error(binding, (vowel ? "is an " : "is a ") + kind + ", which no port can be",
                 sampler ? "declare an input texture2D or texture3D and read it by texelFetch"
                         : "values are images; the blocks of scene and frame are those of lib/scene.glsl");
    return false;
  }
  const bool output = binding.name.starts_with(kOutputPrefix);
  if (binding.count != 1 || binding.shape == gpu::ImageShape::other ||
      (binding.kind == storage_image && binding.shape == gpu::ImageShape::d2_array)) {
    shader_error(binding, "has a shape that no port can have",
                 "texture2D, texture2DArray (a history range), texture3D, image2D, image3D and their unsigned kin");
  } else if (binding.kind == sampled_image && output) {
    shader_error(binding, "has the name of an output, but is read as a texture", "an output is an image2D or image3D");
  } else if (binding.kind == storage_image && !output && (binding.writable || binding.writes)) {
    shader_error(binding, "may be written, so that it is neither an input nor an output",
                 "call what is written out_" + binding.name + ", or declare what is read 'readonly'");
  } else if (output && binding.reads) {
    shader_error(binding, "is read as well as written, but what an output holds before its pass is undefined",
                 "declare it 'writeonly', and read an input");
  } else if (output && !binding.writes) {
    shader_error(binding, "is never written", "store to it, or remove it");
  } else {
    return true;
  }
  return false;
}

void ComputePorts::add_input(const gpu::Binding& binding) {
  Port port;
  port.name = binding.name;
  PortPart part{"", binding.numeric == NumericClass::unsigned_integer ? Format::rgba32_uint : kDefaultFormat, ""};
  for (const auto& [input, bundle] : node_.bundles) {
    if (!binding.name.starts_with(input + "_")) continue;
    port.name = input;
    port.bundle = bundle;
    part.name = binding.name.substr(input.size() + 1);
  }
  if (Port* known = find_input(port.name); known != nullptr && !port.bundle.empty()) {
    known->parts.push_back(std::move(part));
    return;
  }
  port.parts = {std::move(part)};
  port.dimension = dimension_of(binding);
  port.access =
      binding.kind == gpu::BindingKind::storage_image ? Access::compute_storage_read : Access::compute_sampled_read;
  port.array = binding.shape == gpu::ImageShape::d2_array;
  const std::string bound = port.name + "_bound";
  port.optional =
      shader_.reflection.find_constant(bound) != nullptr || shader_.reflection.find_push_constant(bound) != nullptr;
  ports_.push_back(std::move(port));
}

void ComputePorts::add_output(const gpu::Binding& binding) {
  Port port;
  port.name = binding.name.substr(kOutputPrefix.size());
  port.direction = Direction::out;
  port.dimension = dimension_of(binding);
  port.access = Access::compute_storage_write;
  const ComputeOutputSpec* spec = find_spec(node_.pass, port.name);
  const std::optional<Format> format = output_format(binding, spec);
  port.parts = {{"", format.value_or(kDefaultFormat), ""}};
  if (binding.format) port.exact_format = "its shader names the format";
  set_size(port, spec);
  if (spec != nullptr) set_bypass(port, *spec);
  ports_.push_back(std::move(port));
}

std::optional<Format> ComputePorts::output_format(const gpu::Binding& binding, const ComputeOutputSpec* spec) {
  if (spec == nullptr || !spec->format) {
    if (binding.format) return binding.format;
    if (binding.numeric == NumericClass::floating) return kDefaultFormat;
    shader_error(binding, "stores unsigned integers of a format that nobody names",
                 "layout(r32ui) in the shader, or 'format' in the graph");
    return std::nullopt;
  }
  const SourceLocation& where = spec->format->where;
  const std::optional<Format> format = find_format(spec->format->text);
  if (!format) {
    error("unknown-format", where,
          "output '" + spec->name + "' cannot have the format " + in_quotes(spec->format->text),
          did_you_mean(spec->format->text, format_names(), "formats"));
  } else if (format_info(*format).numeric != binding.numeric) {
    error("format-mismatch", where,
          "output '" + spec->name + "' has the format " + spec->format->text + " here, but " +
              shader_.place(binding.name) + " stores " + class_name(binding.numeric));
  } else if (binding.format && *binding.format != *format) {
    error("format-mismatch", where,
          "output '" + spec->name + "' has the format " + spec->format->text + " here, but " +
              std::string(format_info(*binding.format).name) + " at " + shader_.place(binding.name),
          "name it in one place");
  }
  return format;
}

void ComputePorts::set_size(Port& port, const ComputeOutputSpec* spec) {
  if (spec == nullptr || !spec->size) return set_default_size(port);
  constexpr std::array<std::pair<std::string_view, ExtentRule>, 3> kRules{
      {{"view", ExtentRule::view}, {"trace", ExtentRule::trace}, {"grid", ExtentRule::grid}}};
  const std::string& text = spec->size->text;
  const SourceLocation& where = spec->size->where;
  for (const auto& [name, rule] : kRules)
    if (text == name) port.extent = rule;
  constexpr std::string_view kLike = "like ";
  if (text.starts_with(kLike)) {
    port.extent = ExtentRule::like;
    port.like = text.substr(kLike.size());
    if (find_input(port.like) == nullptr)
      error("unknown-input", where,
            "output '" + port.name + "' is like " + in_quotes(port.like) + ", which is no input",
            did_you_mean(port.like, names(Direction::in), "its inputs"));
  } else if (port.extent == ExtentRule::any && !set_fixed_size(port, text)) {
    error("bad-size", where, "output '" + port.name + "' cannot have the size " + in_quotes(text),
          "sizes: \"view\", \"trace\", \"grid\", \"like INPUT\", \"640x480\", \"64x64x64\"");
  }
}

bool ComputePorts::set_fixed_size(Port& port, const std::string& text) {
  std::array<uint32_t, 3> lengths{1, 1, 1};
  const std::vector<std::string> numbers = split(text, 'x');
  if (numbers.size() != (port.dimension == Dimension::d3 ? 3U : 2U)) return false;
  for (size_t i = 0; i < numbers.size(); ++i) {
    const char* end = numbers[i].data() + numbers[i].size();
    const auto [rest, failed] = std::from_chars(numbers[i].data(), end, lengths.at(i));
    if (failed != std::errc{} || rest != end || lengths.at(i) < 1 || lengths.at(i) > kMaximumImageSize) return false;
  }
  port.extent = ExtentRule::fixed;
  port.fixed_extent = {lengths[0], lengths[1], lengths[2]};
  return true;
}

void ComputePorts::set_default_size(Port& port) {
  std::vector<std::string> candidates = {port.name};
  for (const ConnectionSpec& connection : node_.pass.inputs) candidates.push_back(connection.name);
  port.extent = port.dimension == Dimension::d3 ? ExtentRule::grid : ExtentRule::view;
  for (const std::string& candidate : candidates) {
    const Port* input = find_input(candidate);
    if (input == nullptr || input->dimension != port.dimension) continue;
    port.extent = ExtentRule::like;
    port.like = candidate;
    return;
  }
}

void ComputePorts::set_bypass(Port& port, const ComputeOutputSpec& spec) {
  if (spec.bypass_constant) port.bypass = Bypass{"", *spec.bypass_constant};
  if (!spec.bypass) return;
  const Port* input = find_input(spec.bypass->text);
  if (input == nullptr)
    return error("unknown-input", spec.bypass->where,
                 "output '" + port.name + "' is bypassed by " + in_quotes(spec.bypass->text) + ", which is no input",
                 did_you_mean(spec.bypass->text, names(Direction::in), "its inputs"));
  const bool same = input->bundle.empty() && input->dimension == port.dimension && !input->array &&
                    format_info(input->parts.front().format).numeric == format_info(port.parts.front().format).numeric;
  if (!same)
    return error("bypass-mismatch", spec.bypass->where,
                 "output '" + port.name + "' and its bypass '" + input->name + "' are of different kinds",
                 "both must be one image of the same dimension that holds the same kind of numbers");
  port.bypass = Bypass{spec.bypass->text, {}};
}

void ComputePorts::check_outputs() {
  const std::vector<std::string> outputs = names(Direction::out);
  for (const ComputeOutputSpec& spec : node_.pass.compute->outputs)
    if (std::find(outputs.begin(), outputs.end(), spec.name) == outputs.end())
      error("unknown-output", spec.name_where,
            shader_.place("") + " has no output " + in_quotes(spec.name) + ", an image 'out_" + spec.name +
                "' that it writes",
            did_you_mean(spec.name, outputs, "its outputs"));
  if (outputs.empty())
    error("shader-interface", node_.pass.compute->shader.where, shader_.place("") + " writes no output",
          "an output is an image2D or image3D whose name begins with out_");
}

}  // namespace lightloom::run
