#include "framework/cli/plugin_arguments.hpp"

#include <gmock/gmock.h>

#include "framework/base/error.hpp"
#include "framework/run/plugins.hpp"

namespace lightloom::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(PluginArguments, are_taken_from_anywhere) {
  const PluginArguments taken =
      take_plugin_arguments({"--plugin", "a.so", "render", "--plugin=b.so", "g.json", "--size", "1x1"}, "");
  EXPECT_THAT(taken.plugins, ElementsAre("a.so", "b.so"));
  EXPECT_THAT(taken.rest, ElementsAre("render", "g.json", "--size", "1x1"));
}

TEST(PluginArguments, of_the_environment_come_first) {
  const PluginArguments taken = take_plugin_arguments({"passes", "--plugin", "c.so"}, "a.so::b.so");
  EXPECT_THAT(taken.plugins, ElementsAre("a.so", "b.so", "c.so"));
}

TEST(PluginArguments, after_two_dashes_are_left_alone) {
  const PluginArguments taken = take_plugin_arguments({"check", "--", "--plugin", "a.so"}, "");
  EXPECT_THAT(taken.plugins, IsEmpty());
  EXPECT_THAT(taken.rest, ElementsAre("check", "--", "--plugin", "a.so"));
}

TEST(PluginArguments, without_a_file_are_left_to_the_parser) {
  EXPECT_THAT(take_plugin_arguments({"--plugin"}, "").rest, ElementsAre("--plugin"));
  EXPECT_THAT(take_plugin_arguments({"--plugin", "--help"}, "").rest, ElementsAre("--plugin", "--help"));
  EXPECT_THAT(take_plugin_arguments({"--plugin="}, "").rest, ElementsAre("--plugin="));
}

std::string refusal(const std::filesystem::path& file) {
  PassRegistry registry;
  try {
    (void)run::load_plugin(file, registry);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
  return "";
}

TEST(LoadPlugin, refuses_what_is_no_plugin) {
  EXPECT_THAT(refusal("no/such/plugin.so"), HasSubstr("is not there"));
  EXPECT_THAT(refusal("/proc/self/exe"), HasSubstr("cannot be loaded"));
  EXPECT_THAT(refusal("/proc/self/status"), HasSubstr("cannot be loaded"));
}

}  // namespace
}  // namespace lightloom::cli
