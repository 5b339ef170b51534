#include "tests/graph/fixed_registry.hpp"

#include "passes/bundles.hpp"

namespace lightloom::toy {
namespace {

Port port(const std::string& name, Direction direction, ExtentRule extent, const std::string& like = {}) {
  Port result;
  result.name = name;
  result.direction = direction;
  result.parts = {{"", Format::rgba32_sfloat, ""}};
  result.extent = extent;
  result.like = like;
  result.access = direction == Direction::in ? Access::compute_sampled_read : Access::compute_storage_write;
  return result;
}

Port surface(Port result) {
  result.bundle = "surface";
  result.parts = passes::surface_parts();
  return result;
}

Port voxels(Port result) {
  result.bundle = "voxels";
  result.parts = passes::voxel_parts();
  result.dimension = Dimension::d3;
  return result;
}

Port volume(Port result) {
  result.dimension = Dimension::d3;
  return result;
}

Port bypassed(Port result, const std::string& input) {
  result.bypass = Bypass{input, {}};
  return result;
}

PassType type(const std::string& name, std::vector<Port> ports, std::vector<Param> params = {}) {
  PassType result;
  result.name = name;
  result.ports = std::move(ports);
  result.params = std::move(params);
  result.record = [](PassContext&) {};
  return result;
}

constexpr Direction kIn = Direction::in;
constexpr Direction kOut = Direction::out;

void add_geometry(PassRegistry& types) {
  types.add(type("voxelize", {voxels(port("voxels", kOut, ExtentRule::grid))},
                 {{"geometry", ParamType::choice, std::string("all"), {}, {}, {"static", "dynamic", "all"}, "", ""},
                  {"resolution", ParamType::integer, int64_t{128}, 8, 512, {}, "voxels", ""}}));
  types.add(type("distance_transform", {voxels(port("voxels", kIn, ExtentRule::any)),
                                        volume(port("distance", kOut, ExtentRule::like, "voxels"))}));
  types.add(type("gather", {surface(port("surface", kOut, ExtentRule::view)),
                            port("depth", Direction::scratch, ExtentRule::view)}));
  types.add(type("resample_surface", {surface(port("surface", kIn, ExtentRule::any)),
                                      bypassed(surface(port("surface", kOut, ExtentRule::trace)), "surface")}));
}

void add_light(PassRegistry& types) {
  types.add(type("voxel_path_trace",
                 {surface(port("surface", kIn, ExtentRule::any)), voxels(port("voxels", kIn, ExtentRule::any)),
                  volume(port("distance", kIn, ExtentRule::any)), port("radiance", kOut, ExtentRule::like, "surface")},
                 {{"paths", ParamType::integer, int64_t{1}, 1, 256, {}, "", ""},
                  {"bounces", ParamType::integer, int64_t{3}, 0, 64, {}, "", ""}}));
  types.add(type("denoise_radial",
                 {port("radiance", kIn, ExtentRule::any), surface(port("surface", kIn, ExtentRule::like, "radiance")),
                  bypassed(port("radiance", kOut, ExtentRule::like, "radiance"), "radiance")}));
  types.add(
      type("tonemap", {port("radiance", kIn, ExtentRule::any), port("image", kOut, ExtentRule::like, "radiance")},
           {{"exposure", ParamType::real, 0.0, -32, 32, {}, "EV", ""},
            {"curve", ParamType::choice, std::string("filmic"), {}, {}, {"filmic", "reinhard", "linear"}, "", ""}}));
}

}  // namespace

const PassRegistry& fixed_registry() {
  static const PassRegistry types = [] {
    PassRegistry result;
    add_geometry(result);
    add_light(result);
    return result;
  }();
  return types;
}

}  // namespace lightloom::toy
