#include "framework/run/run_times.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RunTimesTest : public ::testing::Test {
 protected:
  RunTimesTest() : folder_(fs::temp_directory_path() / ("lightloom-times-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    for (const char* name : {"b", "a"}) {
      plan_.graph.passes.push_back({});
      plan_.graph.passes.back().name = name;
      plan_.graph.passes.back().type = &type_;
    }
  }
  ~RunTimesTest() override { fs::remove_all(folder_); }

  RunTimes read(const std::string& record) {
    std::ofstream(folder_ / "run.json") << record;
    return read_run_times(folder_, plan_);
  }

  std::string error_of(const std::string& record) {
    try {
      (void)read(record);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
  PassType type_;
  Plan plan_;
};

TEST_F(RunTimesTest, AreInTheOrderOfThePlan) {
  EXPECT_TRUE(read(R"({"passes": []})").step_ms.empty()) << "no steps, no times";
  plan_.steps = {{1, {}, {}}};
  const RunTimes times = read(R"({"passes": [{"pass": "b", "median_ms": 2}, {"pass": "a", "median_ms": 0.5}]})");
  EXPECT_EQ(times.step_ms, std::vector<double>{0.5});
  EXPECT_FALSE(times.same_plan);
}

TEST_F(RunTimesTest, WhatIsMissingIsNamed) {
  EXPECT_THROW((void)read_run_times(folder_ / "nowhere", plan_), Error);
  EXPECT_THAT(error_of("{"), HasSubstr("run.json' is no record of a run"));
  EXPECT_THAT(error_of("[]"), HasSubstr("is no record of a run"));
  plan_.steps = {{0, {}, {}}};
  EXPECT_THAT(error_of(R"({"passes": [{"pass": "a", "median_ms": 1}]})"), HasSubstr("has no time of pass 'b'"));
  EXPECT_THAT(error_of(R"({"passes": [{"pass": "b", "median_ms": null}, 7]})"), HasSubstr("has no time of pass 'b'"));
  EXPECT_THAT(error_of(R"({"passes": [{"pass": "b", "median_ms": -1}]})"), HasSubstr("has no time of pass 'b'"));
}

}  // namespace
}  // namespace lightloom::run
