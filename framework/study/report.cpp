#include "framework/study/report.hpp"

#include <functional>
#include <map>
#include <string_view>

#include "framework/study/report_assets.hpp"
#include "framework/study/report_data.hpp"
#include "framework/study/report_text.hpp"

namespace lightloom::study {
namespace {

/// Each {{name}} of the page replaced once; what is put in is not looked at again.
std::string fill(std::string_view page, const std::map<std::string, std::string, std::less<>>& places) {
  std::string text;
  size_t at = 0;
  while (at < page.size()) {
    const size_t open = page.find("{{", at);
    const size_t close = open == std::string_view::npos ? open : page.find("}}", open);
    if (close == std::string_view::npos) break;
    text += page.substr(at, open - at);
    text += places.at(std::string(page.substr(open + 2, close - open - 2)));
    at = close + 2;
  }
  text += page.substr(at);
  return text;
}

std::string provenance_html(const StudyResults& results) {
  std::string list;
  const auto entry = [&](const std::string& name, const std::string& value) {
    list += "<div><dt>" + escape_html(name) + "</dt><dd>" + escape_html(value) + "</dd></div>\n";
  };
  if (!results.graph.empty()) entry("graph", results.graph);
  for (const auto& [name, value] : results.provenance) entry(name, value);
  return list;
}

std::string notes_html(const StudyResults& results) {
  std::string list;
  for (const auto& note : results.notes) list += "<li class=\"own\">" + escape_html(note) + "</li>\n";
  return list;
}

}  // namespace

std::string make_report(const StudyResults& results, const std::filesystem::path& folder) {
  const std::string description =
      results.description.empty() ? "" : "<p class=\"description\">" + escape_html(results.description) + "</p>";
  return fill(report_page(), {{"title", escape_html(results.name.empty() ? "Study" : results.name)},
                              {"description", description},
                              {"summary", summary_html(results)},
                              {"provenance", provenance_html(results)},
                              {"notes", notes_html(results)},
                              {"style", std::string(report_style())},
                              {"script", std::string(report_script())},
                              {"data", report_data(results, folder)}});
}

}  // namespace lightloom::study
