#include "framework/page/make_plan_page.hpp"

#include <nlohmann/json.hpp>

#include "framework/page/page.hpp"
#include "framework/page/plan_assets.hpp"

namespace lightloom::page {

std::string make_plan_page(const Plan& plan, const PlanFacts& facts) {
  const std::string data =
      plan_json(plan, facts).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  return fill(plan_page(), {{"title", escape_html(plan.graph.name.empty() ? "Plan" : plan.graph.name)},
                            {"style", std::string(plan_style())},
                            {"script", std::string(plan_script())},
                            {"data", escape_for_script(data)}});
}

}  // namespace lightloom::page
