#include "framework/run/device_room.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::run {
namespace {

using ::testing::HasSubstr;

constexpr DeviceRoom kRoom{
    .device = "toy", .bytes = 1'000'000, .bytes_per_image = 600'000, .side_2d = 2000, .side_3d = 300, .layers = 8};

Value volume(const Extent3& extent, Format format = Format::rgba8_unorm) {
  Value value;
  value.pass = "v";
  value.port = "voxels";
  value.desc = {format, Dimension::d3, extent};
  return value;
}

Value picture(const Extent3& extent, uint32_t history) {
  Value value;
  value.pass = "p";
  value.port = "radiance";
  value.desc = {Format::rgba8_unorm, Dimension::d2, extent};
  value.history = history;
  return value;
}

/// Sentence and hint of the refusal; empty if there is none.
std::string refusal(const std::vector<Value>& values, const DeviceRoom& room = kRoom) {
  Graph graph;
  graph.values = values;
  try {
    require_room(graph, room);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    return std::string(error.what()) + " / " + error.hint();
  }
  return "";
}

TEST(DeviceRoom, WhatFitsIsNotRefused) {
  EXPECT_EQ(refusal({}), "");
  EXPECT_EQ(refusal({volume({50, 50, 50}), volume({50, 50, 50})}), "");  // 500,000 bytes each: all there is
  EXPECT_EQ(refusal({picture({100, 100, 1}, 7)}), "");
}

TEST(DeviceRoom, TooManyBytesInAllAreToldWithTheResolutionThatFits) {
  const std::string text = refusal({volume({50, 50, 50}), volume({50, 50, 50}), picture({100, 100, 1}, 0)});
  EXPECT_THAT(text, HasSubstr("need 1040000 bytes"));
  EXPECT_THAT(text, HasSubstr("more than the 1000000 bytes"));
  EXPECT_THAT(text, HasSubstr("'toy'"));
  EXPECT_THAT(text, HasSubstr("lower the param 'resolution' to 49"));  // 2 * 4 * 49^3 = 941,192
  EXPECT_EQ(refusal({volume({49, 49, 49}), volume({49, 49, 49}), picture({100, 100, 1}, 0)}), "");
}

TEST(DeviceRoom, WherePicturesAloneAreTooManyTheSizeIsToBlame) {
  const std::string text =
      refusal({volume({50, 50, 50}), picture({300, 300, 1}, 0), picture({300, 300, 1}, 0), picture({300, 300, 1}, 0)});
  EXPECT_THAT(text, HasSubstr("need 1.5 MiB (1580000 bytes)"));
  EXPECT_THAT(text, HasSubstr("--size"));
}

TEST(DeviceRoom, OneImageThatIsTooLargeIsNamed) {
  const std::string text = refusal({volume({60, 60, 60})});
  EXPECT_THAT(text, HasSubstr("'v.voxels' (rgba8_unorm 60x60x60) needs 864000 bytes"));
  EXPECT_THAT(text, HasSubstr("600000 bytes"));
  EXPECT_THAT(text, HasSubstr("'resolution' to 53"));  // 4 * 53^3 = 595,508
  EXPECT_THAT(refusal({picture({400, 400, 1}, 0)}), HasSubstr("--size"));
  DeviceRoom unlimited = kRoom;
  unlimited.bytes_per_image = 0;
  EXPECT_EQ(refusal({volume({60, 60, 60})}, unlimited), "");
}

TEST(DeviceRoom, SidesAndLayersHaveLimits) {
  EXPECT_THAT(refusal({volume({301, 2, 2})}), HasSubstr("is 301 texels long, more than the 300"));
  EXPECT_THAT(refusal({volume({2, 2, 301})}), HasSubstr("'resolution' to 300 or less"));
  EXPECT_EQ(refusal({picture({2000, 2, 1}, 0)}), "");
  EXPECT_THAT(refusal({picture({2001, 2, 1}, 0)}), HasSubstr("--size"));
  EXPECT_THAT(refusal({picture({10, 10, 1}, 8)}), HasSubstr("keeps 9 frames, more than the 8 layers"));
}

TEST(DeviceRoom, GridsOfMoreBytesThanFitIn32BitsAreCounted) {
  DeviceRoom large = kRoom;
  large.bytes = uint64_t{6} << 30;
  large.bytes_per_image = uint64_t{2} << 30;
  large.side_3d = 4096;
  const std::vector<Value> grids(13, volume({512, 512, 512}));
  const std::string text = refusal(grids, large);
  EXPECT_THAT(text, HasSubstr("need 6656.0 MiB (6979321856 bytes), more than the 6144.0 MiB (6442450944 bytes)"));
  EXPECT_EQ(refusal({grids.begin(), grids.begin() + 12}, large), "");
}

using DeviceRoomOnDevice = test::DeviceTest;

TEST_F(DeviceRoomOnDevice, TheDeviceTellsItsLimits) {
  const DeviceRoom room = room_of(device());
  EXPECT_EQ(room.device, device().info().name);
  EXPECT_GT(room.bytes, uint64_t{1} << 26);
  EXPECT_LT(room.bytes, uint64_t{1} << 50);
  EXPECT_GE(room.side_3d, 256u);  // the least that Vulkan allows
  EXPECT_GE(room.side_2d, 4096u);
}

}  // namespace
}  // namespace lightloom::run
