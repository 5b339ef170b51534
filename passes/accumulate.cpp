#include "passes/accumulate.hpp"

#include "passes/port_rows.hpp"

namespace lightloom::passes {
namespace {

constexpr float kUnknownError = 1e4f;  // as in shaders/accumulate.comp

std::vector<PortPart> accumulation_parts() {
  return {
      {"sum", Format::rgba32_sfloat, "rgb: sum of the frames; a: how many they are"},
      {"sum_error", Format::rgba32_sfloat, "rgb: what `sum` is short of; a: frames that saw a surface"},
      {"spread", Format::rgba32_sfloat,
       "rgb: sum of the frames' squared standard errors or, without those, of their squared differences from the mean; "
       "a: frames without one"},
      {"spread_error", Format::rgba32_sfloat, "rgb: what `spread` is short of"},
  };
}

/// The same in what the pass left a frame ago.
Port past_input() {
  Port port = image_input("past", Format::rgba32_sfloat,
                          "`accumulation` of this pass a frame ago: connect it to `THIS_PASS.accumulation@1`");
  port.bundle = "accumulation";
  port.parts = accumulation_parts();
  return same_size_as("radiance", port);
}

}  // namespace

PassType make_accumulate() {
  PassType type;
  type.name = "accumulate";
  type.doc =
      "Mean over all frames since the view last changed, for pictures that become better the longer they are rendered. "
      "The sums are compensated (Neumaier 1974, Dekker 1971), so that the mean of 100000 frames is exact to the "
      "rounding of 32-bit floats. A frame with a NaN or an infinity in a pixel is left out there; a pixel whose "
      "history has one starts anew. The scene should not move.";
  Port radiance = image_output_like("radiance", Format::rgba32_sfloat, "radiance",
                                    "rgb: mean; a: number of frames in it that saw a surface (a above 0)");
  radiance.bypass = Bypass{"radiance", {}};
  Port error = image_output_like(
      "standard_error", Format::rgba32_sfloat, "radiance",
      "rgb: standard error of the mean, from the frames' own errors or, without those, from how the frames differ "
      "(Welford 1962), which needs two; 10000 where it is unknown; a: number of frames in the mean");
  error.bypass = Bypass{"", {kUnknownError, kUnknownError, kUnknownError, 0}};
  Port own_error = image_input(
      "standard_error", Format::rgba32_sfloat,
      "rgb: standard error of each frame's radiance, estimated within the frame; 0 in all three where it is not known");
  own_error.optional = true;
  Port accumulation = bundle_output("accumulation", accumulation_parts(), ExtentRule::like,
                                    Access::compute_storage_write, "what the next frame goes on from");
  accumulation.like = "radiance";
  accumulation.exact_format = "sums of many frames stall in half floats (a mean of 2 from 1 after 45 frames)";
  type.ports = {
      image_input("radiance", Format::rgba32_sfloat, "the current frame; frames must be independent of each other"),
      same_size_as("radiance", own_error),
      past_input(),
      radiance,
      error,
      accumulation,
  };
  type.reads = FrameState::camera;
  type.record = one_dispatch("accumulate.comp", "radiance");
  return type;
}

}  // namespace lightloom::passes
