#include "tests/shaders/ward_support.hpp"

#include "tests/support/snippet_runner.hpp"

namespace lightloom::test {
namespace {

const std::string kEvaluate = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  uint at = 8u * index;
  vec3 i = vec3(inputs[at], inputs[at + 1u], inputs[at + 2u]);
  vec3 o = vec3(inputs[at + 3u], inputs[at + 4u], inputs[at + 5u]);
  vec2 alpha = vec2(inputs[at + 6u], inputs[at + 7u]);
  outputs[4u * index] = ward_evaluate(i, o, alpha);
  outputs[4u * index + 1u] = ward_evaluate(o, i, alpha);
  outputs[4u * index + 2u] = ward_pdf(i, o, alpha);
  outputs[4u * index + 3u] = ward_weight(i, o, alpha);
})";

const std::string kSample = R"(
#include "lib/ward.glsl"
void evaluate(uint index) {
  vec3 i = vec3(inputs[0], inputs[1], inputs[2]);
  vec2 alpha = vec2(inputs[3], inputs[4]);
  vec3 o = ward_sample(i, vec2(inputs[5u + 2u * index], inputs[6u + 2u * index]), alpha);
  outputs[5u * index] = o.x;
  outputs[5u * index + 1u] = o.y;
  outputs[5u * index + 2u] = o.z;
  outputs[5u * index + 3u] = ward_weight(i, o, alpha);
  outputs[5u * index + 4u] = ward_pdf(i, o, alpha);
})";

}  // namespace

std::vector<ShaderValue> ward_constants(WardForm form, WardSampling sampling) {
  return {{"ward", static_cast<uint32_t>(form)}, {"ward_sampling", static_cast<uint32_t>(sampling)}};
}

void append(std::vector<float>& values, const Direction& direction) {
  for (const double v : {direction.x(), direction.y(), direction.z()}) values.push_back(static_cast<float>(v));
}

std::vector<WardValues> evaluate_ward(gpu::Device& device, const std::vector<WardPair>& pairs, WardForm form,
                                      WardSampling sampling) {
  std::vector<float> inputs;
  for (const WardPair& pair : pairs) {
    append(inputs, pair.i);
    append(inputs, pair.o);
    inputs.push_back(static_cast<float>(pair.ax));
    inputs.push_back(static_cast<float>(pair.ay));
  }
  const std::vector<float> outputs = run_snippet(device, kEvaluate, inputs, 4 * pairs.size(),
                                                 static_cast<uint32_t>(pairs.size()), ward_constants(form, sampling));
  std::vector<WardValues> values;
  for (size_t k = 0; k < outputs.size(); k += 4)
    values.push_back({outputs[k], outputs[k + 1], outputs[k + 2], outputs[k + 3]});
  return values;
}

std::vector<WardSample> sample_ward(gpu::Device& device, const Lobe& lobe, const std::vector<float>& u, WardForm form,
                                    WardSampling sampling) {
  std::vector<float> inputs;
  append(inputs, lobe.incoming);
  inputs.push_back(static_cast<float>(lobe.ax));
  inputs.push_back(static_cast<float>(lobe.ay));
  inputs.insert(inputs.end(), u.begin(), u.end());
  const size_t count = u.size() / 2;
  const std::vector<float> outputs =
      run_snippet(device, kSample, inputs, 5 * count, static_cast<uint32_t>(count), ward_constants(form, sampling));
  std::vector<WardSample> samples;
  for (size_t k = 0; k < outputs.size(); k += 5)
    samples.push_back({outputs[k], outputs[k + 1], outputs[k + 2], outputs[k + 3], outputs[k + 4]});
  return samples;
}

}  // namespace lightloom::test
