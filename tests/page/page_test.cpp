#include "framework/page/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/page/make_plan_page.hpp"

namespace lightloom::page {
namespace {

TEST(Page, PlacesAreFilledOnce) {
  EXPECT_EQ(fill("a {{x}} b {{y}}{{x}}", {{"x", "1"}, {"y", "{{x}}"}}), "a 1 b {{x}}1");
  EXPECT_EQ(fill("no places } { {{", {}), "no places } { {{");
  EXPECT_THROW((void)fill("{{x}}", {}), std::out_of_range);
}

TEST(Page, ScriptsCannotBeEnded) {
  const nlohmann::json data = {{"a", "</script><!-- & \xE2\x80\xA8 \xE2\x80\xA9 \\"}};
  const std::string escaped = escape_for_script(data.dump());
  EXPECT_EQ(escaped.find_first_of("<>&"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(escaped), data);
}

TEST(Page, APlanWithoutAnythingIsAPage) {
  const std::string page = make_plan_page(Plan{});
  EXPECT_NE(page.find("<title>Plan: plan</title>"), std::string::npos);
  EXPECT_EQ(page.find("{{"), std::string::npos);
}

}  // namespace
}  // namespace lightloom::page
