#include <algorithm>
#include <cmath>

#include "framework/page/page.hpp"
#include "framework/stability/results.hpp"
#include "framework/stability/stability_assets.hpp"

namespace lightloom::stability {
namespace {

using page::escape_html;

/// The factor between a figure and its bound, where it makes sense.
std::string room_text(const Figure& figure) {
  if (figure.relation == Relation::equal || !(figure.value > 0) || !(figure.threshold > 0)) return "";
  const double room =
      figure.relation == Relation::at_most ? figure.threshold / figure.value : figure.value / figure.threshold;
  return std::isfinite(room) ? number_text(room) : "";
}

std::string row_of(const Figure& figure) {
  return "<tr" + std::string(holds(figure) ? "" : " class=\"missed\"") + "><td>" + escape_html(figure.what) +
         "</td><td class=\"number\">" + number_text(figure.value) + "</td><td class=\"bound\">" +
         escape_html(to_string(figure.relation)) + " " + number_text(figure.threshold) + " " +
         escape_html(figure.unit) + "</td><td class=\"number\">" + room_text(figure) + "</td></tr>\n";
}

std::string figures_of(const Outcome& outcome) {
  if (outcome.figures.empty()) return {};
  std::string rows;
  for (const Figure& figure : outcome.figures) rows += row_of(figure);
  return "<div class=\"scroll\"><table><thead><tr><th>figure</th><th class=\"number\">value</th><th>bound</th>"
         "<th class=\"number\">room</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string check_of(const Outcome& outcome) {
  const Check& check = *outcome.check;
  const bool good = passed(outcome);
  const std::string failure =
      outcome.failure.empty() ? "" : "<p class=\"failure\">" + escape_html(outcome.failure) + "</p>\n";
  return "<article class=\"check" + std::string(good ? "" : " missed") + "\" id=\"" + escape_html(check.name) +
         "\"><h3><code>" + escape_html(check.name) + "</code><span class=\"verdict\">" + (good ? "holds" : "missed") +
         "</span></h3>\n<p>" + escape_html(check.extreme) + "</p>\n" + failure + figures_of(outcome) +
         "<p class=\"guard\">Without a guard: " + escape_html(check.danger) + "<br>Guard: " + escape_html(check.guard) +
         "</p></article>\n";
}

std::string fact(const std::string& name, const std::string& value) {
  return "<div><dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd></div>";
}

std::string facts_of(std::span<const Outcome> outcomes, const TableOrigin& origin) {
  double seconds = 0;
  for (const Outcome& outcome : outcomes) seconds += outcome.seconds;
  return fact("Driver", origin.device.driver + " " + origin.device.driver_info) +
         fact("Vulkan", origin.device.api_version_text()) +
         fact("Validation layers", origin.validation ? "on" : "off") + fact("Program", origin.version) +
         fact("Time", number_text(std::round(seconds * 10) / 10) + " s");
}

struct Groups {
  std::string links, sections;
};

Groups groups_of(std::span<const Outcome> outcomes) {
  Groups groups;
  for (size_t begin = 0, end = 0; begin < outcomes.size(); begin = end) {
    const std::string& group = outcomes[begin].check->group;
    std::string checks;
    for (; end < outcomes.size() && outcomes[end].check->group == group; ++end) checks += check_of(outcomes[end]);
    const std::string id = "group-" + std::to_string(begin);
    groups.links += "<a href=\"#" + id + "\">" + escape_html(group) + "</a>\n";
    groups.sections += "<section id=\"" + id + "\"><h2>" + escape_html(group) + "</h2>\n" + checks + "</section>\n";
  }
  return groups;
}

}  // namespace

std::string to_html(std::span<const Outcome> outcomes, const TableOrigin& origin) {
  const Groups groups = groups_of(outcomes);
  return page::fill(stability_page(), {{"device", escape_html(origin.device.name)},
                                       {"summary", escape_html(summary_text(outcomes))},
                                       {"facts", facts_of(outcomes, origin)},
                                       {"links", groups.links},
                                       {"groups", groups.sections},
                                       {"style", std::string(stability_style())},
                                       {"script", std::string(stability_script())}});
}

}  // namespace lightloom::stability
