#include "framework/run/brdf.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {
namespace {

constexpr double kRadiansPerDegree = 3.141592653589793 / 180;

/// Albedo quadrature: azimuths, and radii for each. At 89.9 degrees the share of an azimuth changes within 1/600 of the
/// circle.
constexpr uint32_t kAzimuths = 4096;
constexpr uint32_t kRadii = 128;
/// Directions at once; bounds the memory for answers to 32 MiB.
constexpr size_t kAlbedoBatch = 256;

using Vector = std::array<double, 3>;

Vector vector_of(const PolarDirection& direction) {
  const double theta = direction.theta * kRadiansPerDegree;
  const double phi = std::fmod(direction.phi, 360.0) * kRadiansPerDegree;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::array<float, 4> to_float(const Vector& vector) {
  return {static_cast<float>(vector[0]), static_cast<float>(vector[1]), static_cast<float>(vector[2]), 0};
}

/// The largest float below 1 where rounding would reach it.
float unit_interval(double u) {
  return std::min(static_cast<float>(u), std::nextafter(1.0f, 0.0f));
}

}  // namespace

BrdfEvaluator::BrdfEvaluator(const gpu::DeviceOptions& options, const ShaderFolders& folders)
    : device_(options), shaders_(device_, {.include_directories = folders.sources, .cache_directory = folders.cache}) {}

std::vector<BrdfEvaluator::Answer> BrdfEvaluator::run(Quantity quantity, const WardLobe& lobe,
                                                      std::span<const Query> queries, uint32_t per_query) {
  if (queries.empty()) return {};
  const auto invocations = static_cast<uint32_t>(queries.size() * per_query);
  const gpu::ShaderProgram& program = shaders_.program({"brdf.comp"});
  const std::array constants{ShaderValue{"quantity", static_cast<uint32_t>(quantity)},
                             ShaderValue{"ward", static_cast<uint32_t>(lobe.form)},
                             ShaderValue{"ward_sampling", static_cast<uint32_t>(lobe.sampling)}};
  const gpu::Pipeline& pipeline = shaders_.pipelines().compute(program, constants);
  const gpu::Buffer input(device_, queries.size_bytes(), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device,
                          "brdf queries");
  const gpu::Buffer output(device_, invocations * sizeof(Answer), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                           gpu::MemoryKind::device, "brdf answers");
  gpu::upload_buffer(device_, input, std::as_bytes(queries));
  gpu::DescriptorAllocator descriptors(device_);
  const VkDescriptorSet set =
      descriptors.allocate(pipeline, {{"Queries", gpu::resource(input)}, {"Answers", gpu::resource(output)}});
  const std::array params{ShaderValue{"alpha_x", static_cast<float>(lobe.alpha_x)},
                          ShaderValue{"alpha_y", static_cast<float>(lobe.alpha_y)},
                          ShaderValue{"invocations", invocations}, ShaderValue{"columns", kAzimuths},
                          ShaderValue{"rows", kRadii}};
  const std::vector<std::byte> push_constants = gpu::encode_push_constants(pipeline.reflection(), params);
  const uint32_t local_size = program.reflection.local_size[0];
  device_.run_commands([&](VkCommandBuffer commands) {
    gpu::record_full_barrier(commands);
    pipeline.bind(commands, set, push_constants);
    vkCmdDispatch(commands, (invocations + local_size - 1) / local_size, 1, 1);
  });
  const std::vector<std::byte> bytes = gpu::read_buffer(device_, output);
  std::vector<Answer> answers(invocations);
  std::memcpy(answers.data(), bytes.data(), bytes.size());
  return answers;
}

std::vector<LobeValues> BrdfEvaluator::evaluate(const WardLobe& lobe, std::span<const DirectionPair> pairs) {
  std::vector<Query> queries;
  queries.reserve(pairs.size());
  for (const DirectionPair& pair : pairs) {
    const Vector i = vector_of(pair.incoming), o = vector_of(pair.outgoing);
    // Near the mirror direction of a smooth lobe the difference of rounded directions is nothing but rounding.
    queries.push_back({to_float(i), to_float(o), to_float({i[0] + o[0], i[1] + o[1], i[2] + o[2]})});
  }
  std::vector<LobeValues> values;
  values.reserve(pairs.size());
  for (const Answer& answer : run(Quantity::evaluate, lobe, queries, 1))
    values.push_back({answer.values[0], answer.values[1], answer.values[2], answer.direction[3] != 0});
  return values;
}

LobeSample BrdfEvaluator::sample(const WardLobe& lobe, const PolarDirection& incoming, std::array<double, 2> u) {
  const Query query{to_float(vector_of(incoming)), {unit_interval(u[0]), unit_interval(u[1]), 0, 0}, {}};
  const Answer answer = run(Quantity::sample, lobe, {&query, 1}, 1).front();
  return {{answer.direction[0], answer.direction[1], answer.direction[2]},
          {answer.values[0], answer.values[1], answer.values[2], answer.direction[3] != 0}};
}

std::vector<double> BrdfEvaluator::albedo(const WardLobe& lobe, std::span<const PolarDirection> incoming) {
  WardLobe least_variance = lobe;
  least_variance.sampling = WardSampling::exact;
  std::vector<double> albedos;
  for (size_t first = 0; first < incoming.size(); first += kAlbedoBatch) {
    std::vector<Query> queries;
    for (const PolarDirection& direction : incoming.subspan(first, std::min(kAlbedoBatch, incoming.size() - first)))
      queries.push_back({to_float(vector_of(direction)), {}, {}});
    const std::vector<Answer> shares = run(Quantity::albedo, least_variance, queries, kAzimuths);
    for (size_t k = 0; k < queries.size(); ++k) {
      double sum = 0;
      for (size_t column = 0; column < kAzimuths; ++column) sum += shares[k * kAzimuths + column].values[0];
      albedos.push_back(sum / kAzimuths);
    }
  }
  return albedos;
}

}  // namespace lightloom::run
