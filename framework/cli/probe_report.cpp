#include "framework/cli/probe_report.hpp"

#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>
#include <string>

#include "framework/base/text.hpp"

namespace lightloom::cli {
namespace {

using Json = nlohmann::ordered_json;
using image::ChannelType;

/// As many digits as tell every number of the type from its neighbours.
int digits_of(ChannelType type) {
  if (type == ChannelType::half) return 5;
  if (type == ChannelType::unorm8 || type == ChannelType::unorm16) return 6;
  return type == ChannelType::float32 ? 9 : 10;
}

std::string number_text(double number, ChannelType type) {
  if (std::isnan(number)) return "NaN";
  if (std::isinf(number)) return number > 0 ? "Infinity" : "-Infinity";
  std::ostringstream text;
  text << std::setprecision(digits_of(type)) << number;
  if (type == ChannelType::unorm8) text << " (" << std::lround(number * 255) << ")";
  if (type == ChannelType::unorm16) text << " (" << std::lround(number * 65535) << ")";
  return text.str();
}

std::string source_text(const run::ProbedTexel& probed) {
  return probed.value + (probed.age > 0 ? "@" + std::to_string(probed.age) : "");
}

std::string place_text(const run::ProbedTexel& probed) {
  const bool volume = probed.desc.dimension == Dimension::d3;
  std::string text = std::to_string(probed.place[0]) + ", " + std::to_string(probed.place[1]);
  if (volume) text += ", " + std::to_string(probed.place[2]);
  return (volume ? "voxel (" : "(") + text + ")";
}

std::string texel_text(const run::ProbedTexel& probed) {
  if (!probed.texel) return "no texel: " + probed.missing;
  const ChannelType type = image::channel_type(probed.desc.format);
  std::string text;
  bool finite = true;
  for (uint32_t channel = 0; channel < probed.channels.size(); ++channel) {
    const double number = probed.texel->at(0, 0, 0, channel);
    finite = finite && std::isfinite(number);
    if (probed.channels.size() > 1) text += probed.channels[channel] + " ";
    text += number_text(number, type) + (channel + 1 < probed.channels.size() ? "  " : "");
  }
  return text + (finite ? "" : "   <-- not finite");
}

void print_texel(std::ostream& out, const char* kind, const run::ProbedTexel& probed, bool is_input) {
  out << "     " << kind << " " << probed.port << (is_input ? " = " + source_text(probed) : "");
  if (probed.texel) out << " " << place_text(probed);
  out << "  " << texel_text(probed) << "\n";
}

void print_texels(std::ostream& out, const char* kind, const std::vector<run::ProbedTexel>& texels, bool explain) {
  for (const run::ProbedTexel& probed : texels) {
    print_texel(out, kind, probed, false);
    if (explain && !probed.doc.empty()) out << "           " << probed.doc << "\n";
  }
}

std::string bundle_of(const std::string& name) {
  const size_t point = name.rfind('.');
  return point == std::string::npos ? std::string() : name.substr(0, point);
}

/// Bundles of this frame stand above, where they were written, and histories from before the first frame are black: a
/// line each for the whole of them.
void print_inputs(std::ostream& out, const std::vector<run::ProbedTexel>& inputs, uint32_t history_length) {
  for (size_t i = 0; i < inputs.size(); ++i) {
    const run::ProbedTexel& probed = inputs[i];
    size_t end = i + 1;
    const std::string bundle = bundle_of(probed.port);
    const bool whole_bundle = !bundle.empty() && probed.age == 0;
    const bool too_old = probed.age > history_length;
    while (end < inputs.size() && ((whole_bundle && inputs[end].age == 0 && bundle_of(inputs[end].port) == bundle) ||
                                   (too_old && inputs[end].port == probed.port && inputs[end].age > probed.age)))
      ++end;
    if (end - i == 1 || (!whole_bundle && !too_old)) {
      print_texel(out, "in ", probed, true);
      continue;
    }
    if (too_old)
      out << "     in  " << probed.port << " = " << source_text(probed) << ".." << inputs[end - 1].age
          << "  zeros: there was no frame yet\n";
    else
      out << "     in  " << bundle << " = " << bundle_of(probed.value) << "  as above\n";
    i = end - 1;
  }
}

void print_pass(std::ostream& out, size_t number, const run::ProbedPass& pass, uint32_t history_length, bool explain) {
  out << std::setw(3) << number << ". " << pass.name << " (" << pass.type << ")";
  for (const auto& [name, value] : pass.params) out << " " << name << "=" << to_string(value);
  out << "\n";
  if (!pass.once.empty()) out << "     ran once, in the first frame: " << pass.once << "\n";
  print_inputs(out, pass.inputs, history_length);
  print_texels(out, "out", pass.outputs, explain);
  print_texels(out, "tmp", pass.scratch, explain);
}

std::string origin_text(const glm::dvec3& origin) {
  if (origin == glm::dvec3(0)) return {};
  std::ostringstream text;
  text << std::setprecision(12) << " from the scene's origin (" << origin.x << ", " << origin.y << ", " << origin.z
       << ")";
  return text.str();
}

void print_frame(std::ostream& out, const run::ProbedFrame& frame, bool explain) {
  out << "\nframe " << frame.frame << ", " << frame.time << " s; histories hold " << frame.history_length
      << (frame.history_length == 1 ? " earlier frame\n" : " earlier frames\n");
  if (frame.point)
    out << "the pixel sees (" << frame.point->x << ", " << frame.point->y << ", " << frame.point->z << ") m"
        << origin_text(frame.origin) << ", says " << frame.point_source
        << "; volumes are shown at the voxel that holds it\n";
  else
    out << frame.point_source << "\n";
  for (size_t i = 0; i < frame.passes.size(); ++i)
    print_pass(out, i + 1, frame.passes[i], frame.history_length, explain);
}

void print_remarks(std::ostream& out, const char* what, const std::vector<PassRemark>& remarks) {
  for (const PassRemark& remark : remarks) out << what << " " << remark.pass << ": " << remark.reason << "\n";
}

Json number_json(double number, ChannelType type) {
  if (!std::isfinite(number)) return number_text(number, type);
  if (type == ChannelType::uint32) return static_cast<uint32_t>(number);
  return number;
}

Json texel_json(const run::ProbedTexel& probed, bool is_input) {
  Json json = {{"port", probed.port}, {"value", probed.value}};
  if (is_input) json["age"] = probed.age;
  json["format"] = format_info(probed.desc.format).name;
  json["extent"] = {probed.desc.extent.width, probed.desc.extent.height, probed.desc.extent.depth};
  json["doc"] = probed.doc;
  if (!probed.texel) {
    json["missing"] = probed.missing;
    return json;
  }
  const ChannelType type = image::channel_type(probed.desc.format);
  json["texel"] = probed.place;
  Json channels = Json::object();
  Json bytes = Json::object();
  bool finite = true;
  for (uint32_t channel = 0; channel < probed.channels.size(); ++channel) {
    const double number = probed.texel->at(0, 0, 0, channel);
    finite = finite && std::isfinite(number);
    channels[probed.channels[channel]] = number_json(number, type);
    bytes[probed.channels[channel]] = std::lround(type == ChannelType::unorm8 ? number * 255 : 0);
  }
  json["channels"] = channels;
  if (type == ChannelType::unorm8) json["bytes"] = bytes;
  json["finite"] = finite;
  return json;
}

Json texels_json(const std::vector<run::ProbedTexel>& texels, bool is_input) {
  Json list = Json::array();
  for (const run::ProbedTexel& probed : texels) list.push_back(texel_json(probed, is_input));
  return list;
}

Json pass_json(const run::ProbedPass& pass) {
  Json params = Json::object();
  for (const auto& param : pass.params) std::visit([&](const auto& held) { params[param.first] = held; }, param.second);
  return {{"pass", pass.name},
          {"type", pass.type},
          {"once", pass.once.empty() ? Json() : Json(pass.once)},
          {"params", params},
          {"inputs", texels_json(pass.inputs, true)},
          {"outputs", texels_json(pass.outputs, false)},
          {"scratch", texels_json(pass.scratch, false)}};
}

Json frame_json(const run::ProbedFrame& frame) {
  Json passes = Json::array();
  for (const run::ProbedPass& pass : frame.passes) passes.push_back(pass_json(pass));
  const Json point = frame.point ? Json{frame.point->x, frame.point->y, frame.point->z} : Json();
  return {{"frame", frame.frame},
          {"time", frame.time},
          {"history_length", frame.history_length},
          {"point", point},
          {"scene_origin", {frame.origin.x, frame.origin.y, frame.origin.z}},
          {frame.point ? "point_from" : "no_point", frame.point_source},
          {"passes", passes}};
}

Json remarks_json(const std::vector<PassRemark>& remarks) {
  Json list = Json::array();
  for (const PassRemark& remark : remarks) list.push_back({{"pass", remark.pass}, {"reason", remark.reason}});
  return list;
}

}  // namespace

void print_probe(std::ostream& out, const run::ProbeReport& report, uint32_t x, uint32_t y, bool explain) {
  out << "pixel " << x << "," << y << " of " << report.graph << ", view " << report.view.width << "x"
      << report.view.height << "\n";
  for (const run::ProbedFrame& frame : report.frames) print_frame(out, frame, explain);
  if (!report.culled.empty() || !report.bypassed.empty()) out << "\n";
  print_remarks(out, "did not run:", report.culled);
  print_remarks(out, "is disabled:", report.bypassed);
}

Json probe_json(const run::ProbeReport& report, uint32_t x, uint32_t y) {
  Json frames = Json::array();
  for (const run::ProbedFrame& frame : report.frames) frames.push_back(frame_json(frame));
  return {{"graph", report.graph},
          {"view", {report.view.width, report.view.height}},
          {"pixel", {x, y}},
          {"frames", frames},
          {"culled", remarks_json(report.culled)},
          {"bypassed", remarks_json(report.bypassed)}};
}

}  // namespace lightloom::cli
