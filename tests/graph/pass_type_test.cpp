#include "framework/graph/pass_type.hpp"

#include <gtest/gtest.h>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

PassType valid() {
  PassType type;
  type.name = "good";
  type.record = [](PassContext&) {};
  Port in;
  in.name = "x";
  in.parts = {{"", Format::rgba16_sfloat, ""}};
  in.access = Access::compute_sampled_read;
  Port out = in;
  out.name = "a";
  out.direction = Direction::out;
  out.extent = ExtentRule::like;
  out.like = "x";
  out.access = Access::compute_storage_write;
  out.bypass = Bypass{"x", {}};
  type.ports = {in, out};
  type.params = {{"n", ParamType::integer, int64_t{1}, 0, 2, {}, "", ""},
                 {"c", ParamType::choice, std::string("p"), {}, {}, {"p", "q"}, "", ""}};
  return type;
}

TEST(PassRegistry, FindsWhatWasAdded) {
  PassRegistry registry;
  registry.add(valid());
  ASSERT_NE(registry.find("good"), nullptr);
  EXPECT_EQ(registry.find("bad"), nullptr);
  EXPECT_EQ(registry.names(), std::vector<std::string>{"good"});
  EXPECT_NE(registry.find("good")->find_port("x", Direction::in), nullptr);
  EXPECT_EQ(registry.find("good")->find_port("x", Direction::out), nullptr);
  EXPECT_NE(registry.find("good")->find_param("n"), nullptr);
  EXPECT_THROW(registry.add(valid()), Error);
}

struct BadTable {
  const char* what;
  void (*spoil)(PassType&);
};

TEST(PassRegistry, RefusesTablesThatContradictThemselves) {
  const BadTable tables[] = {
      {"no name", [](PassType& t) { t.name.clear(); }},
      {"no record", [](PassType& t) { t.record = nullptr; }},
      {"port twice", [](PassType& t) { t.ports.push_back(t.ports[0]); }},
      {"param twice", [](PassType& t) { t.params.push_back(t.params[0]); }},
      {"no part", [](PassType& t) { t.ports[0].parts.clear(); }},
      {"part twice",
       [](PassType& t) {
         t.ports[0].bundle = "b";
         t.ports[0].parts = {{"u", {}, ""}, {"u", {}, ""}};
       }},
      {"parts without bundle",
       [](PassType& t) {
         t.ports[0].parts = {{"u", {}, ""}, {"v", {}, ""}};
       }},
      {"input writes", [](PassType& t) { t.ports[0].access = Access::compute_storage_read_write; }},
      {"output only reads", [](PassType& t) { t.ports[1].access = Access::compute_sampled_read; }},
      {"output without extent",
       [](PassType& t) {
         t.ports[1].extent = ExtentRule::any;
         t.ports[1].like.clear();
       }},
      {"like nothing", [](PassType& t) { t.ports[1].like.clear(); }},
      {"many times as large as nothing",
       [](PassType& t) {
         t.ports[0].times = {2, 1, 1};
       }},
      {"no times as large",
       [](PassType& t) {
         t.ports[1].times = {1, 0, 1};
       }},
      {"like no input", [](PassType& t) { t.ports[1].like = "z"; }},
      {"input like an optional input",
       [](PassType& t) {
         t.ports[0].optional = true;
         t.ports.push_back(t.ports[0]);
         t.ports[2].name = "y";
         t.ports[2].extent = ExtentRule::like;
         t.ports[2].like = "x";
       }},
      {"like without rule", [](PassType& t) { t.ports[1].extent = ExtentRule::view; }},
      {"bypass by no input", [](PassType& t) { t.ports[1].bypass->input = "z"; }},
      {"bypass of other class", [](PassType& t) { t.ports[0].parts[0].format = Format::r32_uint; }},
      {"bypass of other dimension", [](PassType& t) { t.ports[0].dimension = Dimension::d3; }},
      {"bypass by an array", [](PassType& t) { t.ports[0].array = true; }},
      {"array of volumes",
       [](PassType& t) {
         t.ports[1].bypass.reset();
         t.ports[0].array = true;
         t.ports[0].dimension = Dimension::d3;
       }},
      {"bypass on an input", [](PassType& t) { t.ports[0].bypass = Bypass{}; }},
      {"optional output", [](PassType& t) { t.ports[1].optional = true; }},
      {"persistent input", [](PassType& t) { t.ports[0].persistent = true; }},
      {"persistent depth attachment",
       [](PassType& t) {
         t.ports[1].persistent = true;
         t.ports[1].access = Access::depth_attachment_write;
       }},
      {"reads more than declared",
       [](PassType& t) { t.reads_with = [](const ParamSet&) { return FrameState::time; }; }},
      {"reads more than declared with a choice",
       [](PassType& t) {
         t.reads = FrameState::camera;
         t.reads_with = [](const ParamSet& p) {
           return p.choice("c") == "q" ? FrameState::camera | FrameState::seed : FrameState::camera;
         };
       }},
      {"grid without resolution",
       [](PassType& t) {
         t.ports[1].extent = ExtentRule::grid;
         t.ports[1].like.clear();
       }},
      {"default out of range", [](PassType& t) { t.params[0].default_value = int64_t{3}; }},
      {"default of other type", [](PassType& t) { t.params[0].default_value = 1.0; }},
      {"default no choice", [](PassType& t) { t.params[1].default_value = std::string("z"); }},
  };
  for (const BadTable& table : tables) {
    PassType type = valid();
    table.spoil(type);
    PassRegistry registry;
    EXPECT_THROW(registry.add(type), Error) << table.what;
    EXPECT_TRUE(registry.names().empty()) << table.what;
  }
}

TEST(ParamSet, HandsOutTypedValues) {
  const PassType type = valid();
  ParamSet params;
  params.set(type.params[0], int64_t{2});
  params.set(type.params[1], std::string("q"));
  EXPECT_EQ(params.integer("n"), 2);
  EXPECT_EQ(params.choice("c"), "q");
  EXPECT_EQ(params.choice_index("c"), 1U);
  params.set(type.params[0], int64_t{1});
  EXPECT_EQ(params.integer("n"), 1);
  EXPECT_EQ(params.entries().size(), 2U);
  EXPECT_THROW(static_cast<void>(params.real("n")), Error);
  EXPECT_THROW(static_cast<void>(params.integer("missing")), Error);
}

TEST(ParamValue, TextIsJson) {
  EXPECT_EQ(to_string(ParamValue(true)), "true");
  EXPECT_EQ(to_string(ParamValue(int64_t{-3})), "-3");
  EXPECT_EQ(to_string(ParamValue(2.0)), "2.0");
  EXPECT_EQ(to_string(ParamValue(0.1)), "0.1");
  EXPECT_EQ(to_string(ParamValue(1e300)), "1e+300");
  EXPECT_EQ(to_string(ParamValue(std::string("a\"b"))), "\"a\\\"b\"");
}

TEST(Tables, AccessesAndFormatsAreConsistent) {
  for (int i = 1; i <= static_cast<int>(Access::frame_input_read); ++i) {
    const AccessInfo& info = access_info(static_cast<Access>(i));
    EXPECT_TRUE(info.reads || info.writes) << info.name;
    EXPECT_NE(info.stages, VK_PIPELINE_STAGE_2_NONE) << info.name;
    EXPECT_NE(info.access, VK_ACCESS_2_NONE) << info.name;
  }
  for (int i = 0; i <= static_cast<int>(Format::d32_sfloat); ++i) {
    const FormatInfo& info = format_info(static_cast<Format>(i));
    // The name spells out the channels: r8_unorm, rgba16_sfloat, d32_sfloat.
    const std::size_t digits = info.name.find_first_of("0123456789");
    EXPECT_EQ(info.channels, digits) << info.name;
    EXPECT_EQ(info.bytes_per_texel, info.channels * std::stoul(std::string(info.name.substr(digits))) / 8) << info.name;
    EXPECT_EQ(info.numeric == NumericClass::unsigned_integer, info.name.ends_with("uint")) << info.name;
    EXPECT_EQ(info.depth, info.name.starts_with('d')) << info.name;
  }
}

TEST(ImageDesc, TextAndBytes) {
  const ImageDesc flat{Format::rgba16_sfloat, Dimension::d2, {640, 480, 1}};
  EXPECT_EQ(to_string(flat), "rgba16_sfloat 640x480");
  EXPECT_EQ(byte_size(flat), 640U * 480U * 8U);
  const ImageDesc huge{Format::rgba32_sfloat, Dimension::d3, {2048, 2048, 2048}};
  EXPECT_EQ(to_string(huge), "rgba32_sfloat 2048x2048x2048");
  EXPECT_EQ(byte_size(huge), uint64_t{1} << 37U);
}

}  // namespace
}  // namespace lightloom
