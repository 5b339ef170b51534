#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/base/file.hpp"
#include "framework/study/evaluate.hpp"
#include "framework/study/run_study.hpp"
#include "framework/study/write_results.hpp"
#include "passes/registry.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {

/// A folder of its own for each test of each process, with a small study in it.
class StudyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    passes::register_builtin_passes(registry_);
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("lightloom-study-" + std::to_string(getpid()) + "-" + std::string(test->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A study of the paper's graph in the atrium, as small as it gets, and more members that replace its own.
  static nlohmann::ordered_json small_study(const nlohmann::ordered_json& members = {}) {
    nlohmann::ordered_json study = {
        {"lightloom_study", 1},
        {"name", "small"},
        {"graph", (source_dir() / "graphs/paper.json").string()},
        {"scenes", {(source_dir() / "samples/scenes/atrium.scene.json").string()}},
        {"size", "48x36"},
        {"trace_size", "24x18"},
        {"changes", {{"set", {{"resolution", 16}}}}},
        {"frames", 2},
        {"reference", {{"graph", (source_dir() / "graphs/reference.json").string()}, {"set", {{"paths", 4}}}}}};
    for (const auto& [key, value] : members.items()) study[key] = value;
    return study;
  }

  study::StudySpec spec_of(const nlohmann::ordered_json& json) const {
    Diagnostics diagnostics;
    auto spec = study::parse_study(json.dump(), folder_ / "study.json", diagnostics);
    for (const Diagnostic& problem : diagnostics.all()) ADD_FAILURE() << format_diagnostic(problem);
    return spec.value();
  }

  /// Runs a study in process, in the folder `out`.
  study::StudyResults run(const nlohmann::ordered_json& json, const std::string& out = "out") {
    const gpu::DeviceInfo device = gpu::Device().info();
    Diagnostics diagnostics;
    const auto plan = study::plan_study(spec_of(json), {registry_, device}, diagnostics);
    for (const Diagnostic& problem : diagnostics.all()) ADD_FAILURE() << format_diagnostic(problem);
    const study::StudyFolder kept(folder_ / out);
    rendered_ = study::find_state(plan.value(), kept).missing();
    const study::RunProblems problems = study::run_study(*plan, kept, {}, {});
    return study::evaluate(*plan, kept, problems, device);
  }

  PassRegistry registry_;
  std::filesystem::path folder_;
  size_t rendered_ = 0;  ///< references and cells that the last run had to make
};

inline const study::Row& row_of(const study::StudyResults& results, const std::string& setting) {
  for (const study::Row& row : results.rows)
    if (row.setting == setting) return row;
  throw std::runtime_error("no row " + setting);
}

}  // namespace lightloom::test
