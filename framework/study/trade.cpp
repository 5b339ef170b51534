#include "framework/study/trade.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>

#include "framework/base/text.hpp"

namespace lightloom::study {
namespace {

std::optional<double> number_of(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end) return std::nullopt;
  return value;
}

/// Everything that names a row but one axis.
using Rest = std::tuple<std::string, std::string, std::vector<std::pair<std::string, std::string>>>;

struct Place {
  double milliseconds = 0;
  double error = 0;
};

std::optional<Place> place_of(const Row& row, const std::string& metric) {
  const auto found = row.metrics.find(metric);
  if (found == row.metrics.end()) return std::nullopt;
  const Place place{row.frame_ms.mean, found->second.mean};
  const bool usable =
      place.milliseconds > 0 && place.error > 0 && std::isfinite(place.milliseconds) && std::isfinite(place.error);
  return usable ? std::optional(place) : std::nullopt;
}

/// Three digits, as a reader wants them.
std::string short_number(double value) {
  std::ostringstream text;
  text.precision(3);
  text << value;
  return text.str();
}

bool same_view(const Row& a, const Row& b) {
  return a.scene == b.scene && a.camera == b.camera;
}

/// y where x is met on the line through two points, all in logarithms; empty where x is not between them.
std::optional<double> between(double x0, double y0, double x1, double y1, double x) {
  if (x < std::min(x0, x1) || x > std::max(x0, x1) || x0 == x1) return std::nullopt;
  const double part = std::log(x / x0) / std::log(x1 / x0);
  return y0 * std::pow(y1 / y0, part);
}

std::string others_text(const Row& row, const std::string& axis) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : row.values)
    if (name != axis) parts.push_back(name + "=" + value);
  return join(parts, ", ");
}

class TradeTables {
 public:
  explicit TradeTables(StudyResults& results) : results_(results), curves_(find_curves(results)) {}

  void fill() {
    for (const View& view : results_.views)
      for (const Row* target : targets(view)) add_target(*target);
  }

 private:
  /// The rows of the curves that the baseline is on; it alone where there are none.
  std::vector<const Row*> targets(const View& view) const {
    const auto baseline = std::find_if(results_.rows.begin(), results_.rows.end(), [&](const Row& row) {
      return row.scene == view.scene && row.camera == view.camera;
    });
    if (baseline == results_.rows.end()) return {};
    std::vector<const Row*> rows;
    for (const Curve& curve : curves_)
      if (std::find(curve.rows.begin(), curve.rows.end(), &*baseline) != curve.rows.end())
        for (const Row* row : curve.rows)
          if (std::find(rows.begin(), rows.end(), row) == rows.end()) rows.push_back(row);
    if (rows.empty()) rows.push_back(&*baseline);
    return rows;
  }

  void add_target(const Row& target) {
    const auto aim = place_of(target, results_.metric);
    if (!aim) return;
    std::vector<TradeEntry> at_time;
    std::vector<TradeEntry> at_error;
    for (const Curve& curve : curves_) {
      if (!same_view(*curve.rows.front(), target)) continue;
      if (std::find(curve.rows.begin(), curve.rows.end(), &target) != curve.rows.end()) continue;
      if (auto entry = meet(curve, *aim, true)) at_time.push_back(std::move(*entry));
      if (auto entry = meet(curve, *aim, false)) at_error.push_back(std::move(*entry));
    }
    add(results_.equal_time, target, *aim, aim->milliseconds, at_time);
    add(results_.equal_error, target, *aim, aim->error, at_error);
  }

  /// Where a curve first has the time, or the error, that is aimed at.
  std::optional<TradeEntry> meet(const Curve& curve, const Place& aim, bool equal_time) const {
    for (size_t i = 0; i + 1 < curve.rows.size(); ++i) {
      const auto one = place_of(*curve.rows[i], results_.metric);
      const auto other = place_of(*curve.rows[i + 1], results_.metric);
      if (!one || !other) continue;
      const double target = equal_time ? aim.milliseconds : aim.error;
      const double from = equal_time ? one->milliseconds : one->error;
      const double to = equal_time ? other->milliseconds : other->error;
      const auto met = equal_time ? between(from, one->error, to, other->error, target)
                                  : between(from, one->milliseconds, to, other->milliseconds, target);
      if (!met) continue;
      const Row& row = *curve.rows[i];
      const std::string others = others_text(row, curve.axis);
      const double value = between(from, curve.values[i], to, curve.values[i + 1], target).value_or(curve.values[i]);
      return TradeEntry{row.scene,
                        row.camera,
                        (others.empty() ? "" : others + ", ") + curve.axis + " about " + short_number(value),
                        target,
                        equal_time ? target : *met,
                        equal_time ? *met : target,
                        "interpolated between " + row.setting + " and " + curve.rows[i + 1]->setting};
    }
    return std::nullopt;
  }

  static void add(std::vector<TradeEntry>& table, const Row& target, const Place& aim, double value,
                  const std::vector<TradeEntry>& reached) {
    if (reached.empty()) return;
    table.push_back({target.scene, target.camera, target.setting, value, aim.milliseconds, aim.error, "measured"});
    table.insert(table.end(), reached.begin(), reached.end());
  }

  StudyResults& results_;
  std::vector<Curve> curves_;
};

}  // namespace

std::vector<Curve> find_curves(const StudyResults& results) {
  std::vector<Curve> curves;
  for (const std::string& axis : results.axes) {
    std::map<Rest, std::vector<std::pair<double, const Row*>>> groups;
    for (const Row& row : results.rows) {
      if (!row.error.empty()) continue;
      Rest rest{row.scene, row.camera, {}};
      std::optional<double> value;
      for (const auto& entry : row.values) {
        if (entry.first == axis)
          value = number_of(entry.second);
        else
          std::get<2>(rest).push_back(entry);
      }
      if (value) groups[rest].emplace_back(*value, &row);
    }
    for (auto& [rest, rows] : groups) {
      if (rows.size() < 2) continue;
      std::stable_sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      Curve& curve = curves.emplace_back();
      curve.axis = axis;
      for (const auto& [value, row] : rows) {
        curve.rows.push_back(row);
        curve.values.push_back(value);
      }
    }
  }
  return curves;
}

void fill_trade_tables(StudyResults& results) {
  TradeTables(results).fill();
}

}  // namespace lightloom::study
