// Who reads what nobody wrote, or leaves it to others: toy passes with each such fault, and the shipped ways of
// keeping and leaving texels, which are none.
#include "framework/run/poison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/image/half.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/poison_check.hpp"
#include "tests/run/observed_run.hpp"

namespace lightloom::run {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using toy::image_port;
using toy::one_shader_type;

constexpr uint32_t kFrames = 5;

/// The chain that all tests share: `faulty` is under test, `reader` and `late` depend on it.
std::string graph_of(const std::string& type, const std::string& value) {
  return R"({ "lightloom": 1, "name": "faults",
    "view": { "width": 25, "height": 9 }, "trace": { "width": 25, "height": 9 },
    "passes": {
      "faulty": { "type": ")" +
         type + R"(" },
      "reader": { "type": "test_counter", "in": { "previous": "faulty.)" +
         value + R"(" } },
      "late": { "type": "test_counter", "in": { "previous": "reader.count@1" } }
    },
    "outputs": { "late": "late.count" } })";
}

PassType counter_type() {
  PassType type =
      one_shader_type("test_counter", {image_port("previous", Direction::in), image_port("count", Direction::out)},
                      "test_counter.comp", "count");
  type.params = {{"start", ParamType::real, 0.0, {}, {}, {}, "", ""}};
  return type;
}

class PoisonTest : public test::DeviceTest {
 protected:
  /// Complaints about a graph with this pass type; where there are none, its bits must be those without poison.
  static std::vector<std::string> complaints(const PassType& type, const LinkOptions& link = {}) {
    const scene::Scene quad = toy::one_quad();
    const toy::ObservedGraph graph(graph_of(type.name, type.ports.front().name), {type, counter_type()}, quad, link);
    const std::vector<FrameResult> nan_run =
        toy::run_frames(graph.plan, quad, kFrames, toy::observed_options(PoisonTone::nan));
    const std::vector<FrameResult> number_run =
        toy::run_frames(graph.plan, quad, kFrames, toy::observed_options(PoisonTone::number));
    PoisonCheck check(graph.plan);
    for (uint32_t frame = 0; frame < kFrames; ++frame)
      check.add(frame, nan_run[frame].scanned, number_run[frame].scanned);
    if (check.found().empty()) {
      const toy::ObservedGraph plain(graph_of(type.name, type.ports.front().name), {type, counter_type()}, quad, link,
                                     false);
      toy::expect_same_images(toy::run_frames(plain.plan, quad, kFrames, toy::observed_options()), nan_run);
    }
    return check.complaints();
  }
};

/// Writes `columns` columns of a ramp.
PassType ramp_type(uint32_t columns) {
  PassType type = one_shader_type("test_ramp", {image_port("ramp", Direction::out)}, "test_ramp.comp", "ramp");
  type.reads = FrameState::time;  // not hoisted
  type.record = [columns](PassContext& context) { context.dispatch({"test_ramp.comp", {columns, 9, 1}, {}}); };
  return type;
}

TEST_F(PoisonTest, WhoWritesAllIsNotNamed) {
  EXPECT_THAT(complaints(ramp_type(25)), IsEmpty());
}

TEST_F(PoisonTest, AColumnLeftUnwrittenIsNamedWithItsPlace) {
  EXPECT_THAT(complaints(ramp_type(24)),
              ElementsAre("faulty.ramp: faulty leaves 9 of 225 texels unwritten, first 24,0; frames 0..4"));
}

TEST_F(PoisonTest, AHoistedPassIsCheckedInItsFrame) {
  PassType type = ramp_type(24);
  type.reads = FrameState::none;
  EXPECT_THAT(complaints(type),
              ElementsAre("faulty.ramp: faulty leaves 9 of 225 texels unwritten, first 24,0; frame 0"));
}

PassType on_top_type(bool clamped, bool clears) {
  PassType type = one_shader_type("test_on_top", {image_port("sum", Direction::out)}, "test_on_top.comp", "sum");
  type.ports[0].access = Access::compute_storage_read_write;
  type.reads = FrameState::time;
  type.record = [clamped, clears](PassContext& context) {
    if (clears) context.clear("sum", {3, 0, 0, 0});
    context.dispatch({"test_on_top.comp", context.output_extent("sum"), {{"clamped", clamped}}});
  };
  return type;
}

TEST_F(PoisonTest, WhoReadsItsOutputBeforeWritingIsNamed) {
  EXPECT_THAT(complaints(on_top_type(false, false)),
              ElementsAre("faulty.sum: faulty makes it of what nobody wrote: it reads an output or scratch before it "
                          "writes there; frames 0..4"));
  EXPECT_THAT(complaints(on_top_type(false, true)), IsEmpty());
}

TEST_F(PoisonTest, AClampThatSwallowsNanDoesNotHideIt) {
  // max(x, 0) is 0 for a NaN and for a negative number, but not for the positive one of odd frames.
  const std::vector<std::string> found = complaints(on_top_type(true, false));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0], ::testing::HasSubstr("frames 1, 3"));
}

TEST_F(PoisonTest, WhoTakesScratchForZerosIsNamed) {
  for (const bool clears : {false, true}) {
    PassType type = one_shader_type("test_on_scratch",
                                    {image_port("counts", Direction::out), image_port("count", Direction::scratch)},
                                    "test_on_scratch.comp", "counts");
    type.ports[1].parts = {{"", Format::r32_uint, ""}};
    type.ports[1].access = Access::compute_storage_read_write;
    type.reads = FrameState::time;
    type.record = [clears](PassContext& context) {
      if (clears) context.clear("count", {0, 0, 0, 0});
      context.dispatch({"test_on_scratch.comp", context.output_extent("counts"), {}});
    };
    if (clears)
      EXPECT_THAT(complaints(type), IsEmpty());
    else
      EXPECT_THAT(complaints(type),
                  ElementsAre("faulty.counts: faulty makes it of what nobody wrote: it reads an output or scratch "
                              "before it writes there; frames 0..4"));
  }
}

TEST_F(PoisonTest, WhatNobodyWantsNeedNotBeWritten) {
  PassType type = one_shader_type("test_two", {image_port("ramp", Direction::out), image_port("extra", Direction::out)},
                                  "test_ramp.comp", "ramp");
  type.reads = FrameState::time;
  EXPECT_THAT(complaints(type), IsEmpty());
  LinkOptions dumped;
  dumped.captures = {"faulty.extra"};
  // No shader of it has such an image, which is seen before any poison is.
  EXPECT_THAT([&] { static_cast<void>(complaints(type, dumped)); },
              ::testing::ThrowsMessage<Error>(::testing::HasSubstr("recorded nothing that writes its output 'extra'")));
}

/// Rewrites one column of what it keeps; the whole in the first frame only if `all_at_first`.
PassType keeping_type(bool all_at_first) {
  PassType type;
  type.name = "test_frontier";
  type.doc = "For tests.";
  type.ports = {image_port("front", Direction::out), image_port("memo", Direction::scratch)};
  type.ports[1].parts = {{"", Format::r32_uint, ""}};
  type.ports[1].access = Access::compute_storage_read_write;
  for (Port& port : type.ports) port.persistent = true;
  type.reads = FrameState::time;
  type.record = [all_at_first](PassContext& context) {
    const Extent3 all = context.output_extent("front");
    const uint32_t columns = context.kept("front") || !all_at_first ? 1 : all.width;
    context.dispatch({"test_frontier.comp", {columns, all.height, 1}, {{"columns", columns}}});
  };
  return type;
}

TEST_F(PoisonTest, WhatIsKeptIsNotPoisoned) {
  EXPECT_THAT(complaints(keeping_type(true)), IsEmpty());
}

TEST_F(PoisonTest, AFirstFrameMustWriteAllOfWhatIsKept) {
  const std::vector<std::string> found = complaints(keeping_type(false));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0], ::testing::HasSubstr("faulty.front: faulty leaves"));
}

TEST(PoisonBits, ThePatternsDifferAndAreWhatTheyClaim) {
  for (const Format format :
       {Format::r8_unorm, Format::rgba16_sfloat, Format::r32_sfloat, Format::rgba32_uint, Format::d32_sfloat})
    for (const uint64_t frame : {0U, 1U}) {
      const uint32_t nan = poison_bits(format, PoisonTone::nan, frame);
      const uint32_t number = poison_bits(format, PoisonTone::number, frame);
      EXPECT_NE(nan, number);
      EXPECT_NE(nan, 0U);
      EXPECT_NE(number, 0U);
      const auto value = [&](uint32_t bits) {
        return image::channel_type(format) == image::ChannelType::half
                   ? image::float_from_half(static_cast<uint16_t>(bits))
                   : std::bit_cast<float>(bits);
      };
      if (format_info(format).depth) {
        for (const uint32_t bits : {nan, number}) EXPECT_TRUE(value(bits) > 0 && value(bits) < 1);
      } else if (image::channel_type(format) != image::ChannelType::unorm8 &&
                 format_info(format).numeric == NumericClass::floating) {
        EXPECT_TRUE(std::isnan(value(nan)));
        EXPECT_EQ(std::signbit(value(number)), frame == 0);
        EXPECT_GT(std::abs(value(number)), 7000);
      }
    }
}

}  // namespace
}  // namespace lightloom::run
