#include "framework/cli/argument_values.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;

template <typename T>
void expect_value(std::string_view text, const T& expected) {
  T value{};
  EXPECT_EQ(parse_value(text, value), "") << text;
  EXPECT_EQ(value, expected) << text;
}

template <typename T>
void expect_refused(const std::vector<std::string>& texts, const T& untouched) {
  for (const std::string& text : texts) {
    T value = untouched;
    EXPECT_NE(parse_value(text, value), "") << text;
    EXPECT_EQ(value, untouched) << text;
  }
}

TEST(ArgumentValues, whole_numbers_use_all_of_the_text_and_stay_in_range) {
  expect_value<uint32_t>("0", 0);
  expect_value<uint32_t>("4294967295", 4294967295u);
  expect_refused<uint32_t>({"", "-1", "4294967296", "1.0", "1 ", " 1", "+1", "0x10", "ten", "1e3"}, 7);
  expect_value<int64_t>("-9223372036854775808", INT64_MIN);
  expect_refused<int64_t>({"9223372036854775808", "--1", "1a"}, 7);
}

TEST(ArgumentValues, reals_are_finite) {
  expect_value<double>("-1.5e-3", -1.5e-3);
  expect_value<double>(".5", 0.5);
  expect_refused<double>({"", "nan", "inf", "-inf", "1e999", "1,5", "1.5x"}, 7.0);
}

TEST(ArgumentValues, sizes_need_two_positive_numbers) {
  expect_value<Size>("640x480", {640, 480});
  expect_refused<Size>({"640", "640x", "x480", "0x480", "640x0", "-1x5", "640X480", "640x480x3", "640 x 480", ""},
                       {1, 2});
}

TEST(ArgumentValues, ranges_run_forward_and_one_number_is_a_range) {
  expect_value<Range>("0..15", {0, 15});
  expect_value<Range>("7..7", {7, 7});
  expect_value<Range>("7", {7, 7});
  expect_refused<Range>({"", "..", "3..", "..3", "5..4", "0...3", "0-3", "a..b", "-1..3", "0..4294967296"}, {1, 2});
  Range range;
  EXPECT_THAT(parse_value("5..4", range), HasSubstr("does not end before it begins"));
}

TEST(ArgumentValues, assignments_split_at_the_first_equals_sign) {
  expect_value<Assignment>("a=b", {"a", "b"});
  expect_value<Assignment>("pass.param=-1.5", {"pass.param", "-1.5"});
  expect_value<Assignment>("a=b=c", {"a", "b=c"});
  expect_value<Assignment>("a=", {"a", ""});
  expect_refused<Assignment>({"", "a", "=b"}, {"x", "y"});
}

TEST(ArgumentValues, vectors_collect_and_optionals_are_set) {
  std::vector<uint32_t> values;
  EXPECT_EQ(parse_value("1", values), "");
  EXPECT_NE(parse_value("x", values), "");
  EXPECT_EQ(parse_value("2", values), "");
  EXPECT_EQ(values, (std::vector<uint32_t>{1, 2}));
  std::optional<double> number;
  EXPECT_NE(parse_value("x", number), "");
  EXPECT_FALSE(number.has_value());
  EXPECT_EQ(parse_value("2.5", number), "");
  EXPECT_EQ(number, 2.5);
}

TEST(ArgumentValues, what_is_formatted_parses_back) {
  const auto round_trip = [](const auto& value) {
    std::decay_t<decltype(value)> back{};
    EXPECT_EQ(parse_value(format_value(value), back), "");
    EXPECT_EQ(back, value);
  };
  round_trip(uint32_t{5});
  round_trip(int64_t{-5});
  round_trip(2.5);
  round_trip(Size{3, 4});
  round_trip(Range{3, 4});
  round_trip(Range{3, 3});
  round_trip(Assignment{"a", "b"});
  round_trip(std::filesystem::path("a b"));
  EXPECT_EQ(format_value(Size{}), "");
}

TEST(ArgumentValues, control_characters_never_reach_the_message) {
  uint32_t value = 0;
  EXPECT_EQ(parse_value("\x1b[31m", value).find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace lightloom::cli
