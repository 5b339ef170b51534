#include "framework/gpu/shader_values.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/gpu/gpu_support.hpp"

namespace lightloom::gpu {
namespace {

using test::error_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

uint32_t encode(std::variant<bool, int32_t, uint32_t, float> value, ScalarType type) {
  return encode_value({"x", value}, type, "a.comp");
}

TEST(EncodeValue, KeepsBitsOfTheSameType) {
  EXPECT_EQ(encode(true, ScalarType::boolean), 1u);
  EXPECT_EQ(encode(-7, ScalarType::int32), static_cast<uint32_t>(-7));
  EXPECT_EQ(encode(0xFFFFFFFFu, ScalarType::uint32), 0xFFFFFFFFu);
  EXPECT_EQ(encode(-0.1f, ScalarType::float32), std::bit_cast<uint32_t>(-0.1f));
  EXPECT_EQ(encode(std::numeric_limits<float>::infinity(), ScalarType::float32), 0x7F800000u);
}

TEST(EncodeValue, ConvertsWhereTheValueStays) {
  EXPECT_EQ(encode(true, ScalarType::uint32), 1u);
  EXPECT_EQ(encode(3, ScalarType::float32), std::bit_cast<uint32_t>(3.0f));
  EXPECT_EQ(encode(3.0f, ScalarType::int32), 3u);
  EXPECT_EQ(encode(1u, ScalarType::boolean), 1u);
}

TEST(EncodeValue, RefusesWhatWouldChange) {
  EXPECT_THROW(encode(-1, ScalarType::uint32), Error);
  EXPECT_THROW(encode(0.5f, ScalarType::int32), Error);
  EXPECT_THROW(encode(2, ScalarType::boolean), Error);
  EXPECT_THROW(encode(0x80000000u, ScalarType::int32), Error);
  EXPECT_THROW(encode(16777217, ScalarType::float32), Error);
  EXPECT_THROW(encode(std::nanf(""), ScalarType::int32), Error);
  EXPECT_THROW(encode(4294967296.0f, ScalarType::uint32), Error);
  EXPECT_THAT(error_of([] { encode(0.5f, ScalarType::int32); }).what(),
              AllOf(HasSubstr("a.comp"), HasSubstr("'x'"), HasSubstr("int")));
}

TEST(EncodePushConstants, PutsValuesAtTheirOffsets) {
  Reflection reflection;
  reflection.name = "a.comp";
  reflection.push_constant_size = 12;
  reflection.push_constants = {{.name = "a", .offset = 0, .size = 4, .type = ScalarType::uint32, .members = {}},
                               {.name = "b", .offset = 8, .size = 4, .type = ScalarType::float32, .members = {}}};
  const std::array values{ShaderValue{"b", 1.5f}, ShaderValue{"unused", 1}, ShaderValue{"a", 7u}};
  const auto words = test::values_of<uint32_t>(encode_push_constants(reflection, values));
  EXPECT_THAT(words, ::testing::ElementsAre(7u, 0u, std::bit_cast<uint32_t>(1.5f)));
  EXPECT_STREQ(
      error_of([&] { static_cast<void>(encode_push_constants(reflection, std::span(values).first(1))); }).what(),
      "shader a.comp: push constant 'a' has no value");
  reflection.push_constants[1].components = 2;
  EXPECT_THAT(error_of([&] { static_cast<void>(encode_push_constants(reflection, values)); }).what(),
              HasSubstr("'b' is no single bool, int, uint or float"));
}

}  // namespace
}  // namespace lightloom::gpu
