#include "framework/run/brdf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/shaders/ward_albedo_table.hpp"
#include "tests/shaders/ward_vectors.hpp"

namespace lightloom::run {
namespace {

constexpr std::array kForms = {WardForm::ward_1992, WardForm::dur, WardForm::bounded};

/// A device of its own, with validation, shared by all tests here.
BrdfEvaluator& evaluator() {
  static BrdfEvaluator instance({.name = {}, .validate = true});
  return instance;
}

class Brdf : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const gpu::ValidationMessage& message : evaluator().device().validation_messages())
      ADD_FAILURE() << message.text;
  }
};

TEST_F(Brdf, MatchesTestVectorsTo1e5) {
  for (const test::WardVector& v : test::kWardVectors) {
    const DirectionPair pair{{v.theta_i, v.phi_i}, {v.theta_o, v.phi_o}};
    for (size_t form = 0; form < kForms.size(); ++form) {
      const LobeValues exact =
          evaluator().evaluate({kForms[form], WardSampling::exact, v.ax, v.ay}, {&pair, 1}).front();
      EXPECT_NEAR(exact.f / v.values[form], 1, 1e-5) << v.theta_i << " " << v.ax;
      EXPECT_NEAR(exact.pdf / v.pdf[0], 1, 1e-5) << v.theta_i << " " << v.ax;
      const LobeValues uniform =
          evaluator().evaluate({kForms[form], WardSampling::phi_uniform, v.ax, v.ay}, {&pair, 1}).front();
      EXPECT_EQ(uniform.f, exact.f);
      if (std::isnan(v.pdf[1])) continue;
      EXPECT_NEAR(uniform.pdf / v.pdf[1], 1, 1e-5) << v.theta_i << " " << v.ax;
    }
  }
}

TEST_F(Brdf, AlbedoIsThatOfTheTable) {
  for (size_t form = 0; form < kForms.size(); ++form)
    for (const test::WardAlbedo& row : test::kWardAlbedos) {
      const PolarDirection incoming{row.theta, row.phi};
      const double albedo = evaluator().albedo({kForms[form], {}, row.ax, row.ay}, {&incoming, 1}).front();
      const double error = row.theta > 89 ? 3e-4 : 1e-4;  // of the table itself
      EXPECT_NEAR(albedo, row.albedo[form], (error + 1e-5) * std::max(1.0, row.albedo[form]))
          << "form " << form << ", alpha " << row.ax << " " << row.ay << ", theta " << row.theta << " " << row.phi;
    }
}

/// Quadrature in double precision on 2000 x 36000 points of Walter's map.
TEST_F(Brdf, AlbedoIsRightAtGrazingAngles) {
  struct Row {
    double ax, ay, phi, albedo;
  };
  for (const Row& row :
       {Row{1, 1, 0, 0.990752}, Row{0.3, 0.3, 0, 0.984071}, Row{0.2, 0.2, 0, 0.978909}, Row{0.1, 0.5, 90, 0.989719}}) {
    const PolarDirection incoming{89.9, row.phi};
    const double albedo = evaluator().albedo({WardForm::bounded, {}, row.ax, row.ay}, {&incoming, 1}).front();
    EXPECT_NEAR(albedo, row.albedo, 2e-5) << row.ax << " " << row.ay;
  }
}

TEST_F(Brdf, AlbedoHasAClosedFormAtNormalIncidence) {
  const PolarDirection normal{0, 0};
  for (const double alpha : {0.001, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0}) {
    const double exact = 1 - alpha * alpha * (1 - std::exp(-1 / (alpha * alpha)));
    const double albedo =
        evaluator().albedo({WardForm::bounded, WardSampling::phi_uniform, alpha, alpha}, {&normal, 1}).front();
    EXPECT_NEAR(albedo, exact, 1e-5) << alpha;
  }
}

TEST_F(Brdf, SamplesWhereTheMapSays) {
  const LobeSample s = evaluator().sample({WardForm::bounded, WardSampling::exact, 0.2, 0.2}, {30, 0}, {0.1, 0.05});
  EXPECT_NEAR(s.direction[0], -0.389713868609, 1.5e-3);
  EXPECT_NEAR(s.direction[1], 0.0358341363102, 1.5e-3);
  EXPECT_NEAR(s.direction[2], 0.920238564335, 1.5e-3);
  EXPECT_NEAR(s.values.weight, 1.0303500275, 2e-3);
  EXPECT_NEAR(s.values.pdf, 2.01318397837, 2e-2);
  const LobeSample lost =
      evaluator().sample({WardForm::bounded, WardSampling::exact, 0.5, 0.05}, {60, 10}, {0.75, 0.625});
  EXPECT_LE(lost.direction[2], 0);
  EXPECT_EQ(lost.values.weight, 0);
}

TEST_F(Brdf, IsZeroAtTheHorizonAndKnowsMirrors) {
  const std::vector<DirectionPair> pairs = {{{90, 0}, {30, 180}}, {{30, 0}, {90, 180}}};
  for (const WardForm form : kForms)
    for (const LobeValues& v : evaluator().evaluate({form, {}, 0.3, 0.3}, pairs)) {
      EXPECT_EQ(v.f, 0);
      EXPECT_EQ(v.pdf, 0);
      EXPECT_FALSE(v.mirror);
    }
  const PolarDirection level{90, 0};
  EXPECT_EQ(evaluator().albedo({}, {&level, 1}).front(), 0);
  EXPECT_TRUE(evaluator().evaluate({WardForm::bounded, {}, 0.001, 0.001}, pairs).front().mirror);
}

TEST_F(Brdf, AnswersInTheOrderOfWhatIsAsked) {
  std::vector<PolarDirection> directions;
  for (int k = 0; k < 600; ++k) directions.push_back({k * 0.1, 0});
  const std::vector<double> albedos = evaluator().albedo({WardForm::ward_1992, {}, 0.1, 0.1}, directions);
  ASSERT_EQ(albedos.size(), directions.size());
  for (size_t k = 1; k < albedos.size(); ++k) EXPECT_LT(albedos[k], albedos[k - 1]);
}

}  // namespace
}  // namespace lightloom::run
