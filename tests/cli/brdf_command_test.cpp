#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "framework/base/text.hpp"
#include "framework/image/png.hpp"
#include "tests/cli/program_fixture.hpp"
#include "tests/shaders/ward_vectors.hpp"

namespace lightloom::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::array<const char*, 3> kModels = {"ward92", "dur", "bounded"};

class BrdfCommand : public ProgramTest {
 protected:
  BrdfCommand() : ProgramTest({"brdf"}) {}

  nlohmann::json run_json(std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    EXPECT_EQ(run(arguments), 0) << err_;
    EXPECT_EQ(err_, "");
    return nlohmann::json::parse(out_);
  }

  /// One error, one line, and no result.
  void expect_usage_error(const std::vector<std::string>& arguments, const std::string& sentence) {
    EXPECT_EQ(run(arguments), 2) << join(arguments, " ");
    EXPECT_EQ(out_, "");
    EXPECT_THAT(err_, HasSubstr(sentence));
    EXPECT_EQ(split(err_, '\n')[0].rfind("error: option", 0), 0u) << err_;
  }
};

std::string pair_text(double a, double b) {
  std::ostringstream text;
  text << a << ',' << b;
  return text.str();
}

TEST_F(BrdfCommand, prints_the_test_vectors_to_1e5) {
  for (size_t row = 0; row < test::kWardVectors.size(); ++row)
    for (size_t model = 0; model < kModels.size(); ++model) {
      // Each run opens the device; all rows of all models are compared below the command.
      if (kModels[model] != std::string("bounded") && row % 3 != model) continue;
      const test::WardVector& v = test::kWardVectors[row];
      const nlohmann::json json =
          run_json({"--model", kModels[model], "--alpha", pair_text(v.ax, v.ay), "--wi", pair_text(v.theta_i, v.phi_i),
                    "--wo", pair_text(v.theta_o, v.phi_o), "--sampling", model == 0 ? "phi_uniform" : "exact"});
      EXPECT_NEAR(json["f"].get<double>() / v.values[model], 1, 1e-5) << kModels[model] << " " << v.theta_i;
      const double pdf = v.pdf[model == 0 ? 1 : 0];
      if (!std::isnan(pdf)) {
        EXPECT_NEAR(json["pdf"].get<double>() / pdf, 1, 1e-5) << v.theta_i;
      }
      EXPECT_EQ(json["model"], kModels[model]);
    }
}

TEST_F(BrdfCommand, json_holds_the_question_and_the_whole_answer) {
  const nlohmann::json json =
      run_json({"--alpha", "0.1,0.3", "--wi", "30,0", "--sampling=exact", "--sample", "0.5,0.25", "--validate"});
  EXPECT_EQ(json["model"], "bounded");
  EXPECT_EQ(json["sampling"], "exact");
  EXPECT_EQ(json["alpha"], nlohmann::json({0.1, 0.3}));
  EXPECT_EQ(json["wi"], nlohmann::json({30.0, 0.0}));
  EXPECT_EQ(json["wo"], nlohmann::json({30.0, 180.0})) << "the mirror direction";
  EXPECT_NEAR(json["weight"].get<double>(), 1, 1e-6);
  EXPECT_NEAR(json["albedo"].get<double>(), 0.948225, 1e-4);
  EXPECT_EQ(json["mirror"], false);
  const nlohmann::json& sample = json["sample"];
  EXPECT_NEAR(sample["direction"][0].get<double>(), -0.5, 1.5e-3);
  EXPECT_NEAR(sample["direction"][1].get<double>(), 0.407205278799, 1.5e-3);
  EXPECT_NEAR(sample["wo"][0].get<double>(), std::acos(0.764319214019) * 57.29577951308232, 0.2);
  EXPECT_NEAR(sample["weight"].get<double>(), 0.93761675375, 2e-3);
  EXPECT_NEAR(sample["pdf"].get<double>(), 1.72850516032, 2e-2);
  EXPECT_EQ(sample["lost"], false);
  EXPECT_FALSE(run_json({"--alpha", "0.1,0.3", "--wi", "30,0"}).contains("sample"));
}

TEST_F(BrdfCommand, prints_nine_digits) {
  ASSERT_EQ(run({"--model", "ward92", "--alpha", "0.1,0.3", "--wi", "30,0", "--wo", "30,180"}), 0);
  EXPECT_THAT(out_, ::testing::ContainsRegex("f  +3\\.06293[0-9][0-9][0-9]  +sr"));
  EXPECT_THAT(out_, AllOf(HasSubstr("pdf"), HasSubstr("weight"), HasSubstr("albedo")));
}

TEST_F(BrdfCommand, is_zero_at_the_horizon) {
  const nlohmann::json json = run_json({"--alpha", "0.1,0.3", "--wi", "90,0", "--sample", "0.5,0.5"});
  for (const char* name : {"f", "pdf", "weight", "albedo"}) EXPECT_EQ(json[name], 0) << name;
  EXPECT_EQ(json["sample"]["lost"], true);
}

TEST_F(BrdfCommand, refuses_bad_values_with_a_sentence) {
  const auto with = [](const std::string& option, const std::string& value) {
    std::vector<std::string> line = {"--alpha", "0.1,0.3", "--wi", "30,0"};
    line.push_back(option + "=" + value);
    return line;
  };
  expect_usage_error(with("--wi", "91,0"), "theta must be from 0 (along the normal) to 90 (at the horizon) degrees");
  expect_usage_error(with("--wo", "-1,0"), "got -1");
  expect_usage_error(with("--wo", "30"), "expected THETA,PHI in degrees such as 30,180, got '30'");
  expect_usage_error(with("--wi", "nan,0"), "expected THETA,PHI");
  expect_usage_error(with("--alpha", "0.1,1.5"), "alpha must be from 0 (smooth) to 1 (rough), got 1.5");
  expect_usage_error(with("--alpha", "rough"), "expected AX,AY such as 0.1,0.3, got 'rough'");
  expect_usage_error(with("--sample", "0.5,1"), "at least 0 and below 1, got 1");
  expect_usage_error(with("--model", "ward"), "'ward' is not one of its choices");
  EXPECT_THAT(err_, HasSubstr("hint: "));
  expect_usage_error(with("--model", "bunded"), "did you mean 'bounded'?");
  expect_usage_error(with("--sampling", "exakt"), "did you mean 'exact'?");
  expect_usage_error({}, "option '--alpha' is missing");
  EXPECT_THAT(err_, HasSubstr("option '--wi' is missing"));
}

TEST_F(BrdfCommand, plots_lobe_and_albedo) {
  std::string folder = (std::filesystem::temp_directory_path() / "lightloom_brdf_XXXXXX").string();
  ASSERT_NE(mkdtemp(folder.data()), nullptr);
  const std::filesystem::path file = std::filesystem::path(folder) / "new" / "brdf.png";
  ASSERT_EQ(run({"--alpha", "0.1,0.3", "--wi", "30,0", "--plot", file.string()}), 0) << err_;
  const image::HostImage picture = image::read_png(file);
  EXPECT_EQ(picture.desc.extent.width, 1500u);
  std::set<std::array<int, 3>> colors;
  for (size_t k = 0; k + 3 < picture.texels.size(); k += 4)
    colors.insert({static_cast<int>(picture.texels[k]), static_cast<int>(picture.texels[k + 1]),
                   static_cast<int>(picture.texels[k + 2])});
  EXPECT_GT(colors.size(), 500u) << "the map is a gradient";
  EXPECT_EQ(colors.count({0, 89, 191}), 1u) << "the curves of the bounded form";
  EXPECT_EQ(run({"--alpha", "0.1,0.3", "--wi", "30,0", "--plot", "/dev/null/brdf.png"}), 1);
  EXPECT_THAT(err_, HasSubstr("/dev/null/brdf.png"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace lightloom::cli
