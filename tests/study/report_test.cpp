#include "framework/study/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "framework/base/base64.hpp"
#include "framework/base/error.hpp"
#include "framework/page/page.hpp"
#include "framework/study/graph_layers.hpp"
#include "framework/study/graph_layout.hpp"
#include "framework/study/metric_info.hpp"
#include "framework/study/report_data.hpp"
#include "framework/study/report_text.hpp"
#include "tests/study/sample_results.hpp"

namespace lightloom::study {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class Report : public ::testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::temp_directory_path() / ("lightloom_report_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
};

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

TEST(Base64, VectorsOfRfc4648) {
  EXPECT_EQ(encode_base64(""), "");
  EXPECT_EQ(encode_base64("f"), "Zg==");
  EXPECT_EQ(encode_base64("fo"), "Zm8=");
  EXPECT_EQ(encode_base64("foo"), "Zm9v");
  EXPECT_EQ(encode_base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encode_base64(std::string("\xff\x00\xfb", 3)), "/wD7");
}

TEST_F(Report, SameResultsGiveTheSameBytes) {
  const StudyResults results = sample_results(folder);
  EXPECT_EQ(make_report(results, folder), make_report(results, folder));
}

TEST_F(Report, NamesNothingOutsideItself) {
  const std::string page = make_report(sample_results(folder), folder);
  for (const char* outside : {"<link rel=\"stylesheet\"", "<script src", "url(http", "@import", "fetch("}) {
    EXPECT_THAT(page, Not(HasSubstr(outside)));
  }
  EXPECT_EQ(count(page, "http://www.w3.org/2000/svg"), count(page, "://"));  // a name of XML, no address to visit
  EXPECT_THAT(page, Not(HasSubstr("{{")));
}

TEST_F(Report, HostileNamesStayText) {
  const std::string page = make_report(hostile_results(folder), folder);
  EXPECT_EQ(count(page, "<script"), 2U);
  EXPECT_EQ(count(page, "</script"), 2U);
  EXPECT_THAT(page, Not(HasSubstr("<!-- ")));
  const std::string data = report_data(hostile_results(folder), folder);
  for (const char* unsafe : {"<", ">", "&", "\xE2\x80\xA8", "\xE2\x80\xA9"}) EXPECT_THAT(data, Not(HasSubstr(unsafe)));
  EXPECT_EQ(nlohmann::json::parse(data).at("name"), hostile_results(folder).name);
}

TEST_F(Report, EqualPicturesAreEmbeddedOnce) {
  const auto data = nlohmann::json::parse(report_data(many_rows(folder, 100), folder));
  EXPECT_EQ(data.at("pictures").size(), 3U);  // reference, picture, heat map
  EXPECT_EQ(data.at("rows").size(), 100U);
}

TEST_F(Report, NumbersThatJsonLacksAreWords) {
  const auto data = nlohmann::json::parse(report_data(sample_results(folder), folder));
  bool seen = false;
  for (const auto& row : data.at("rows")) {
    if (!row.at("metrics").contains("psnr") || row.at("metrics").at("psnr").at("mean") != "inf") continue;
    EXPECT_EQ(row.at("metrics").at("psnr").at("low"), "nan");
    seen = true;
  }
  EXPECT_TRUE(seen);
}

TEST_F(Report, MissingPictureIsAnError) {
  StudyResults results = sample_results(folder);
  results.rows[2].picture = "pictures/none.png";
  try {
    (void)make_report(results, folder);
    FAIL() << "a missing picture was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_THAT(error.what(), HasSubstr("none.png"));
  }
}

TEST_F(Report, SummaryNamesBestFastestNoiseAndFailures) {
  const std::string words = summary_html(sample_results(folder));
  EXPECT_THAT(words, HasSubstr("11 settings in 2 views, 5 seeds each."));
  EXPECT_THAT(words, HasSubstr("<strong>paths=16</strong> is best by FLIP, 0.0447 ± 0.000800"));
  EXPECT_THAT(words, HasSubstr("<strong>without denoise_*</strong> is fastest"));
  EXPECT_THAT(words, HasSubstr("within the noise of the baseline: <strong>without denoise_box_x</strong>"));
  EXPECT_THAT(words, HasSubstr("2 rows could not be run"));
  EXPECT_EQ(summary_html({}), "This study holds no setting.");
}

TEST(ReportText, NumbersHaveThreeDigits) {
  EXPECT_EQ(format_number(0.07123), "0.0712");
  EXPECT_EQ(format_number(12.345), "12.3");
  EXPECT_EQ(format_number(1234.4), "1234");
  EXPECT_EQ(format_number(1.2e-5), "1.2e-05");
  EXPECT_EQ(format_number(0), "0");
  EXPECT_EQ(format_number(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(format_number(std::nan("")), "not a number");
  EXPECT_EQ(page::escape_html("<a href=\"x\">'&'"), "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;");
}

TEST(MetricInfo, KnowsWhatIsBetter) {
  EXPECT_TRUE(is_better(metric_info("flip"), 0.1, 0.2));
  EXPECT_TRUE(is_better(metric_info("psnr"), 31, 30));
  EXPECT_TRUE(is_better(metric_info("bias"), -0.01, 0.02));
  EXPECT_FALSE(is_better(metric_info("ssim"), std::nan(""), 0.2));
  EXPECT_EQ(metric_info("own").label, "own");
}

TEST_F(Report, DrawnBoxesKeepApartAndEdgesLeadDown) {
  const StudyResults results = sample_results(folder);
  const GraphLayout layout = lay_out(results.graph_passes, results.graph_edges);
  ASSERT_EQ(layout.boxes.size(), results.graph_passes.size());
  for (size_t i = 0; i < layout.boxes.size(); ++i) {
    const auto& a = layout.boxes[i];
    EXPECT_GE(a.x, 0);
    EXPECT_LE(a.x + a.width, layout.width);
    EXPECT_LE(a.y + a.height, layout.height);
    for (size_t j = i + 1; j < layout.boxes.size(); ++j) {
      const auto& b = layout.boxes[j];
      EXPECT_TRUE(a.layer != b.layer || a.x + a.width < b.x || b.x + b.width < a.x) << i << " and " << j;
    }
  }
  size_t history = 0;
  for (const auto& edge : layout.edges) {
    EXPECT_FALSE(edge.path.empty());
    if (!edge.history) {
      EXPECT_LT(layout.boxes[edge.from].layer, layout.boxes[edge.to].layer);
    }
    history += edge.history ? 1 : 0;
    if (edge.history && results.graph_passes[edge.from].name == "trace") {
      EXPECT_EQ(edge.ages, "@1..9");
    }
  }
  EXPECT_EQ(history, 4U);
}

TEST(GraphLayers, UntanglesWhatCanBeUntangled) {
  // Two pairs that cross as given: 0 -> 3, 1 -> 2.
  LayeredGraph graph = make_layers({50, 50, 50, 50}, {{0, 3}, {1, 2}});
  EXPECT_EQ(count_crossings(graph), 1U);
  order_layers(graph);
  EXPECT_EQ(count_crossings(graph), 0U);
  place_nodes(graph, 10);
  for (const auto& layer : graph.layers) {
    for (size_t i = 1; i < layer.size(); ++i) {
      EXPECT_GE(graph.nodes[layer[i]].centre - graph.nodes[layer[i - 1]].centre, 60 - 1e-9);
    }
  }
}

TEST(GraphLayers, EmptyGraphsAreDrawnEmpty) {
  const GraphLayout layout = lay_out({}, {{"a", "b", "x", 0}});
  EXPECT_TRUE(layout.boxes.empty());
  EXPECT_TRUE(layout.edges.empty());
}

}  // namespace
}  // namespace lightloom::study
