#include "framework/study/report.hpp"

#include "framework/page/page.hpp"
#include "framework/study/report_assets.hpp"
#include "framework/study/report_data.hpp"
#include "framework/study/report_text.hpp"

namespace lightloom::study {
namespace {

std::string provenance_html(const StudyResults& results) {
  std::string list;
  const auto entry = [&](const std::string& name, const std::string& value) {
    list += "<div><dt>" + page::escape_html(name) + "</dt><dd>" + page::escape_html(value) + "</dd></div>\n";
  };
  if (!results.graph.empty()) entry("graph", results.graph);
  for (const auto& [name, value] : results.provenance) entry(name, value);
  return list;
}

std::string notes_html(const StudyResults& results) {
  std::string list;
  for (const auto& note : results.notes) list += "<li class=\"own\">" + page::escape_html(note) + "</li>\n";
  return list;
}

}  // namespace

std::string make_report(const StudyResults& results, const std::filesystem::path& folder) {
  const std::string description =
      results.description.empty() ? "" : "<p class=\"description\">" + page::escape_html(results.description) + "</p>";
  return page::fill(report_page(), {{"title", page::escape_html(results.name.empty() ? "Study" : results.name)},
                                    {"description", description},
                                    {"summary", summary_html(results)},
                                    {"provenance", provenance_html(results)},
                                    {"notes", notes_html(results)},
                                    {"style", std::string(report_style())},
                                    {"script", std::string(report_script())},
                                    {"data", report_data(results, folder)}});
}

}  // namespace lightloom::study
