#include <algorithm>
#include <map>
#include <utility>

#include "framework/stability/check.hpp"

namespace lightloom::stability {
namespace {

/// Groups in the order in which they first appear, each in one piece; within a group the order stays.
std::vector<Check> by_group(std::vector<Check> checks) {
  std::map<std::string, size_t> places;
  for (const Check& check : checks) places.emplace(check.group, places.size());
  std::stable_sort(checks.begin(), checks.end(),
                   [&](const Check& a, const Check& b) { return places.at(a.group) < places.at(b.group); });
  return checks;
}

}  // namespace

void CheckGroup::operator()(std::string name, std::string extreme, std::string danger, std::string guard,
                            std::function<std::vector<Figure>(Lab&)> measure, bool slow) const {
  checks_.push_back({.name = std::move(name),
                     .group = group_,
                     .extreme = std::move(extreme),
                     .danger = std::move(danger),
                     .guard = std::move(guard),
                     .measure = std::move(measure),
                     .slow = slow});
}

std::vector<Check> all_checks() {
  std::vector<Check> checks;
  add_geometry_checks(checks);
  add_shape_checks(checks);
  add_grid_checks(checks);
  add_view_checks(checks);
  add_metamorphic_checks(checks);
  add_random_checks(checks);
  add_generator_checks(checks);
  add_material_checks(checks);
  add_sampler_checks(checks);
  add_table_checks(checks);
  add_light_checks(checks);
  add_source_checks(checks);
  add_accumulation_checks(checks);
  add_variance_checks(checks);
  add_injection_checks(checks);
  add_history_checks(checks);
  add_surface_checks(checks);
  return by_group(std::move(checks));
}

}  // namespace lightloom::stability
