#include "framework/run/command_hazards.hpp"

#include <gmock/gmock.h>

#include <array>

namespace lightloom::run {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Use use(const std::string& port, Access access) {
  return {.port = port, .part = {}, .shader_name = port, .access = access};
}

/// Slots: 0 input, 1 and 2 outputs, 3 scratch.
GraphPass pass() {
  GraphPass result;
  result.inputs = {use("x", Access::compute_sampled_read)};
  result.outputs = {use("a", Access::compute_storage_write), use("b", Access::compute_storage_write)};
  result.scratch = {use("s", Access::compute_storage_read_write)};
  return result;
}

constexpr Touch kReadInput{0, Access::compute_sampled_read};
constexpr Touch kWriteA{1, Access::compute_storage_write};
constexpr Touch kWriteB{2, Access::compute_storage_write};
constexpr Touch kUpdateScratch{3, Access::compute_storage_read_write};

template <class... Touches>
std::vector<Dependency> next(CommandHazards& hazards, Touches... touches) {
  return hazards.before(std::array{touches...});
}

TEST(CommandHazards, WhatPortsDeclareNeedsNothing) {
  const GraphPass toy = pass();
  CommandHazards hazards(toy);
  EXPECT_THAT(next(hazards, kReadInput, kWriteA, kUpdateScratch), IsEmpty());
  EXPECT_THAT(hazards.finish(), IsEmpty());
}

TEST(CommandHazards, DispatchesOnDisjointImagesNeedNothing) {
  const GraphPass toy = pass();
  CommandHazards hazards(toy);
  EXPECT_THAT(next(hazards, kReadInput, kWriteA), IsEmpty());
  EXPECT_THAT(next(hazards, kReadInput, kWriteB), IsEmpty());
  EXPECT_THAT(hazards.finish(), IsEmpty());
}

TEST(CommandHazards, EachKindOfHazardNeedsOne) {
  const GraphPass toy = pass();
  constexpr Touch kReadScratch{3, Access::compute_storage_read};
  CommandHazards hazards(toy);
  EXPECT_THAT(next(hazards, kWriteA), IsEmpty());
  EXPECT_THAT(next(hazards, kWriteA),
              ElementsAre(Dependency{Access::compute_storage_write, Access::compute_storage_write}));
  EXPECT_THAT(next(hazards, kUpdateScratch), IsEmpty());
  EXPECT_THAT(next(hazards, kReadScratch, kWriteB),
              ElementsAre(Dependency{Access::compute_storage_read_write, Access::compute_storage_read}));
  // Known by now, for as long as nobody writes.
  EXPECT_THAT(next(hazards, kReadScratch), IsEmpty());
  // After its readers, who came after the write.
  EXPECT_THAT(next(hazards, kUpdateScratch),
              ElementsAre(Dependency{Access::compute_storage_read, Access::compute_storage_read_write}));
  EXPECT_THAT(hazards.finish(), IsEmpty());
}

TEST(CommandHazards, AClearIsChainedToWhatThePortDeclares) {
  const GraphPass toy = pass();
  CommandHazards hazards(toy);
  EXPECT_THAT(hazards.before(port_touches(toy, "s", Access::transfer_write)),
              ElementsAre(Dependency{Access::compute_storage_read_write, Access::transfer_write}));
  // That barrier was about all memory, so `a` is served.
  EXPECT_THAT(hazards.before(port_touches(toy, "a", Access::transfer_write)), IsEmpty());
  EXPECT_THAT(next(hazards, kUpdateScratch),
              ElementsAre(Dependency{Access::transfer_write, Access::compute_storage_read_write}));
  // And so it is here; the plan's next barriers go on from compute.
  EXPECT_THAT(next(hazards, kWriteA), IsEmpty());
  EXPECT_THAT(hazards.finish(), IsEmpty());
}

TEST(CommandHazards, WhatEndsOtherwiseThanDeclaredIsChainedBack) {
  const GraphPass toy = pass();
  CommandHazards cleared(toy);
  static_cast<void>(cleared.before(port_touches(toy, "a", Access::transfer_write)));
  EXPECT_THAT(cleared.finish(), ElementsAre(Dependency{Access::transfer_write, Access::compute_storage_write}));

  CommandHazards drawn(toy);
  constexpr Touch kSampledByADraw{0, Access::fragment_sampled_read};
  EXPECT_THAT(next(drawn, kSampledByADraw),
              ElementsAre(Dependency{Access::compute_sampled_read, Access::fragment_sampled_read}));
  EXPECT_THAT(drawn.finish(), ElementsAre(Dependency{Access::fragment_sampled_read, Access::compute_sampled_read}));
}

TEST(CommandHazards, AShaderThatCouldReadAnOutputNeedsNothingForIt) {
  const GraphPass toy = pass();
  constexpr Touch kNotMarkedWriteOnly{1, Access::compute_storage_read_write};
  CommandHazards hazards(toy);
  EXPECT_THAT(next(hazards, kNotMarkedWriteOnly), IsEmpty());
  EXPECT_THAT(next(hazards, kNotMarkedWriteOnly),
              ElementsAre(Dependency{Access::compute_storage_read_write, Access::compute_storage_read_write}));
  EXPECT_THAT(hazards.finish(), IsEmpty());
}

TEST(CommandHazards, TouchesFollowTheShaders) {
  const GraphPass toy = pass();
  gpu::Reflection reflection;
  const auto bind = [&](const std::string& name, gpu::BindingKind kind, VkShaderStageFlags stages, bool readable,
                        bool writable) {
    gpu::Binding binding;
    binding.name = name;
    binding.kind = kind;
    binding.stages = stages;
    binding.readable = readable;
    binding.writable = writable;
    reflection.bindings.push_back(binding);
  };
  bind("FrameBlock", gpu::BindingKind::uniform_buffer, VK_SHADER_STAGE_COMPUTE_BIT, true, false);
  bind("x", gpu::BindingKind::sampled_image, VK_SHADER_STAGE_COMPUTE_BIT, true, false);
  bind("a", gpu::BindingKind::storage_image, VK_SHADER_STAGE_COMPUTE_BIT, false, true);
  bind("s", gpu::BindingKind::storage_image, VK_SHADER_STAGE_FRAGMENT_BIT, true, true);
  EXPECT_THAT(bound_touches(toy, reflection),
              ElementsAre(Touch{0, Access::compute_sampled_read}, Touch{1, Access::compute_storage_write},
                          Touch{3, Access::fragment_storage_read_write}));
  EXPECT_THAT(port_touches(toy, "x", Access::transfer_write), IsEmpty());
  EXPECT_EQ(written_touch(toy, toy.outputs[1], Access::color_attachment_write),
            (Touch{2, Access::color_attachment_write}));
}

}  // namespace
}  // namespace lightloom::run
