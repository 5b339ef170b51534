#include "framework/study/report_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "framework/base/text.hpp"
#include "framework/page/page.hpp"
#include "framework/study/metric_info.hpp"

namespace lightloom::study {
namespace {

constexpr size_t kViewsInWords = 4;
constexpr size_t kNamesInWords = 6;

using ViewName = std::pair<std::string, std::string>;

std::string plural(size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string strong(const std::string& name) {
  return "<strong>" + page::escape_html(name) + "</strong>";
}

/// "a, b and c", at most kNamesInWords of them named.
std::string list_names(const std::vector<std::string>& names) {
  std::vector<std::string> shown;
  for (size_t i = 0; i < std::min(names.size(), kNamesInWords); ++i) shown.push_back(strong(names[i]));
  if (names.size() > kNamesInWords) shown.push_back(std::to_string(names.size() - kNamesInWords) + " more");
  if (shown.size() < 2) return join(shown, "");
  const std::string last = shown.back();
  shown.pop_back();
  return join(shown, ", ") + " and " + last;
}

std::string with_interval(const Estimate& e) {
  std::string text = format_number(e.mean);
  if (e.count > 1 && std::isfinite(e.high - e.low)) text += " ± " + format_number((e.high - e.low) / 2);
  return text;
}

std::vector<ViewName> views_of(const StudyResults& results) {
  std::vector<ViewName> views;
  for (const auto& row : results.rows) {
    const ViewName view{row.scene, row.camera};
    if (std::find(views.begin(), views.end(), view) == views.end()) views.push_back(view);
  }
  return views;
}

std::string view_name(const ViewName& view) {
  std::string text = page::escape_html(view.first);
  if (!view.second.empty()) text += ", " + page::escape_html(view.second);
  return text;
}

/// Rows of one view that were run.
std::vector<const Row*> rows_of(const StudyResults& results, const ViewName& view) {
  std::vector<const Row*> rows;
  for (const auto& row : results.rows) {
    if (row.error.empty() && row.scene == view.first && row.camera == view.second) rows.push_back(&row);
  }
  return rows;
}

const Row* best_by(const std::vector<const Row*>& rows, const MetricInfo& metric) {
  const Row* best = nullptr;
  for (const Row* row : rows) {
    const auto value = row->metrics.find(metric.name);
    if (value == row->metrics.end()) continue;
    if (best == nullptr || is_better(metric, value->second.mean, best->metrics.at(metric.name).mean)) best = row;
  }
  return best;
}

std::string best_words(const Row& best, const MetricInfo& metric) {
  std::string words = strong(best.setting) + " is best by " + page::escape_html(metric.label) + ", " +
                      with_interval(best.metrics.at(metric.name)) + (metric.unit.empty() ? "" : " " + metric.unit);
  const auto verdict = best.verdicts.find(metric.name);
  if (verdict == best.verdicts.end()) return words + " (it is the baseline)";
  if (verdict->second.within_noise) return words + " (not told apart from the baseline)";
  const double ratio = verdict->second.ratio;
  if (std::isfinite(ratio) && ratio > 0 && !metric.nearest_zero_is_best) {
    words += " (" + format_number(ratio) + " times the baseline's)";
  }
  return words;
}

/// Settings that the metric does not tell from the baseline; with one seed nothing is known.
std::string noise_words(const std::vector<const Row*>& rows, const MetricInfo& metric) {
  std::vector<std::string> within;
  size_t judged = 0;
  for (const Row* row : rows) {
    const auto verdict = row->verdicts.find(metric.name);
    if (verdict == row->verdicts.end() || verdict->second.difference.count < 2) continue;
    ++judged;
    if (verdict->second.within_noise) within.push_back(row->setting);
  }
  if (judged == 0) return "";
  if (within.empty()) return "; every setting differs from the baseline by more than the noise";
  return "; within the noise of the baseline: " + list_names(within);
}

/// Of a frame [ms], as the table gives it.
double time_of(const Row& row) {
  return row.frame_ms.count > 0 ? row.frame_ms.mean : row.frame.median;
}

std::string view_words(const StudyResults& results, const ViewName& view, const MetricInfo& metric, bool named) {
  const auto rows = rows_of(results, view);
  if (rows.empty()) return "";
  std::string words = named ? "In " + view_name(view) + " " : "";
  const Row* best = best_by(rows, metric);
  if (best != nullptr) words += best_words(*best, metric) + "; ";
  const Row* fastest =
      *std::min_element(rows.begin(), rows.end(), [](const Row* a, const Row* b) { return time_of(*a) < time_of(*b); });
  words += strong(fastest->setting) + " is fastest, " + format_number(time_of(*fastest)) + " ms a frame";
  return words + noise_words(rows, metric) + ".";
}

std::string count_words(const StudyResults& results, size_t views) {
  std::set<std::string> settings;
  uint32_t fewest = 0;
  uint32_t most = 0;
  for (const auto& row : results.rows) {
    settings.insert(row.setting);
    for (const auto& [name, value] : row.metrics) {
      fewest = most == 0 ? value.count : std::min(fewest, value.count);
      most = std::max(most, value.count);
    }
  }
  std::string words = plural(settings.size(), "setting") + " in " + plural(views, "view");
  if (most > 0) {
    words += ", " + (fewest == most ? plural(most, "seed") : std::to_string(fewest) + " to " + plural(most, "seed")) +
             " each";
  }
  words += most == 1 ? ": with one seed, noise cannot be told from a difference." : ".";
  return words;
}

}  // namespace

std::string format_number(double value) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  const double size = std::abs(value);
  std::array<char, 64> buffer{};
  auto format = std::chars_format::fixed;
  int digits = size >= 1 ? std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))))
                         : 2 - static_cast<int>(std::floor(std::log10(size)));
  if (size >= 1e7 || size < 1e-4) {
    format = std::chars_format::scientific;
    digits = 1;
  }
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, digits);
  return {buffer.data(), end.ptr};
}

std::string summary_html(const StudyResults& results) {
  const auto views = views_of(results);
  if (views.empty()) return "This study holds no setting.";
  const MetricInfo metric = metric_info(results.metric);
  std::string words = count_words(results, views.size());
  for (size_t i = 0; i < std::min(views.size(), kViewsInWords); ++i) {
    const std::string sentence = view_words(results, views[i], metric, views.size() > 1);
    if (!sentence.empty()) words += " " + sentence;
  }
  if (views.size() > kViewsInWords) {
    words += " " + plural(views.size() - kViewsInWords, "more view") + " below.";
  }
  const auto failed =
      std::count_if(results.rows.begin(), results.rows.end(), [](const Row& row) { return !row.error.empty(); });
  if (failed > 0)
    words += " " + plural(static_cast<size_t>(failed), "row") + " could not be run, with the reason below.";
  return words;
}

}  // namespace lightloom::study
