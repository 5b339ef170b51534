#include "framework/stability/check.hpp"

namespace lightloom::stability {

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
  add_material_checks(checks);
  add_sampler_checks(checks);
  add_light_checks(checks);
  add_source_checks(checks);
  add_accumulation_checks(checks);
  add_injection_checks(checks);
  return checks;
}

}  // namespace lightloom::stability
