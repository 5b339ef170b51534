#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "framework/base/file.hpp"
#include "tests/cli/program_fixture.hpp"

namespace lightloom::cli {
namespace {

using ::testing::HasSubstr;

class SchemaCommand : public ProgramTest {
 protected:
  SchemaCommand() : ProgramTest({"schema"}) {}
};

TEST_F(SchemaCommand, gives_each_format) {
  for (const std::string format : {"graph", "scene", "study", "plan"}) {
    ASSERT_EQ(run({format}), 0) << err_;
    EXPECT_EQ(nlohmann::json::parse(out_)["title"], "Lightloom " + format);
    const std::string printed = out_;
    const std::filesystem::path file = folder_ / format;
    ASSERT_EQ(run({format, "--out", file.string()}), 0) << err_;
    EXPECT_EQ(out_, "");
    EXPECT_EQ(read_text_file(file), printed);
  }
}

TEST_F(SchemaCommand, has_the_pass_types_that_are_registered) {
  PassType type;
  type.name = "my_own";
  type.doc = "Mine.";
  type.record = [](PassContext&) {};
  registry_.add(type);
  ASSERT_EQ(run({"graph"}), 0);
  EXPECT_EQ(nlohmann::json::parse(out_)["$defs"]["type_my_own"]["description"], "Mine.");
}

TEST_F(SchemaCommand, refuses_others) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"grahp"}), 2);
  EXPECT_THAT(err_, HasSubstr("graph"));
}

}  // namespace
}  // namespace lightloom::cli
