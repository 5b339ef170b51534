#include "framework/study/trade.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lightloom::study {
namespace {

/// error = scale / ms: a straight line of logarithms, so interpolation must be exact.
Row row(const std::string& denoise, int paths, double milliseconds, double scale) {
  Row made;
  made.setting = "denoise=" + denoise + ", paths=" + std::to_string(paths);
  made.scene = "atrium";
  made.camera = "nave";
  made.values = {{"denoise", denoise}, {"paths", std::to_string(paths)}};
  made.frame_ms.mean = milliseconds;
  made.metrics["flip"].mean = scale / milliseconds;
  return made;
}

StudyResults two_curves() {
  StudyResults results;
  results.metric = "flip";
  results.axes = {"denoise", "paths"};
  results.views = {{"atrium", "nave", {}, 0, {}}};
  for (const int paths : {1, 4, 16}) results.rows.push_back(row("off", paths, 10.0 * paths, 8));
  for (const int paths : {1, 4, 16}) results.rows.push_back(row("on", paths, 15.0 * paths, 2));
  return results;
}

TEST(Trade, CurvesAreRowsThatDifferInOneNumber) {
  const StudyResults results = two_curves();
  const std::vector<Curve> curves = find_curves(results);
  ASSERT_EQ(curves.size(), 2U);
  for (const Curve& curve : curves) {
    EXPECT_EQ(curve.axis, "paths");
    EXPECT_THAT(curve.values, ::testing::ElementsAre(1, 4, 16));
  }
}

TEST(Trade, InterpolatesLogarithmsAndSaysBetweenWhich) {
  StudyResults results = two_curves();
  fill_trade_tables(results);
  // At 40 ms (off, 4 paths) the other curve has 2 / 40; at 10 ms nothing is known of it.
  ASSERT_EQ(results.equal_time.size(), 4U);
  EXPECT_EQ(results.equal_time[0].setting, "denoise=off, paths=4");
  EXPECT_EQ(results.equal_time[0].note, "measured");
  EXPECT_DOUBLE_EQ(results.equal_time[1].target, 40);
  EXPECT_DOUBLE_EQ(results.equal_time[1].milliseconds, 40);
  EXPECT_NEAR(results.equal_time[1].error, 0.05, 1e-12);
  EXPECT_EQ(results.equal_time[1].setting, "denoise=on, paths about 2.67") << "40 / 15 paths";
  EXPECT_EQ(results.equal_time[1].note, "interpolated between denoise=on, paths=1 and denoise=on, paths=4");
}

TEST(Trade, EqualErrorIsTheTimeToGetThere) {
  StudyResults results = two_curves();
  results.rows[1].metrics["flip"].mean = 0.1;  // off, 4 paths: the other reaches it at 20 ms
  fill_trade_tables(results);
  const auto found = std::find_if(results.equal_error.begin(), results.equal_error.end(), [](const TradeEntry& entry) {
    return entry.target == 0.1 && entry.note != "measured";
  });
  ASSERT_NE(found, results.equal_error.end());
  EXPECT_NEAR(found->milliseconds, 20, 1e-9);
}

TEST(Trade, NothingIsExtrapolated) {
  StudyResults results = two_curves();
  fill_trade_tables(results);
  for (const std::vector<TradeEntry>* table : {&results.equal_time, &results.equal_error})
    for (const TradeEntry& entry : *table) {
      EXPECT_GE(entry.milliseconds, 10);
      EXPECT_LE(entry.milliseconds, 240);
    }
  for (const TradeEntry& entry : results.equal_time) EXPECT_NE(entry.target, 10);
}

TEST(Trade, RowsWithoutATimeOrAnErrorAreLeftOut) {
  StudyResults results = two_curves();
  results.rows[4].error = "cannot be run";
  results.rows[3].frame_ms.mean = 0;
  results.rows[5].metrics["flip"].mean = std::nan("");
  fill_trade_tables(results);
  EXPECT_TRUE(results.equal_time.empty());
}

}  // namespace
}  // namespace lightloom::study
