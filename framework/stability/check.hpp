#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framework/stability/figure.hpp"
#include "framework/stability/lab.hpp"

namespace lightloom::stability {

/// One extreme to which the renderer is pushed, and what must still be true there.
struct Check {
  std::string name;     ///< "scene_scale": what one asks for on the command line
  std::string group;    ///< "geometry", "light", …: a heading of the table
  std::string extreme;  ///< what is pushed how far
  std::string danger;   ///< what goes wrong without a guard
  std::string guard;    ///< what keeps it from happening, and where
  /// Renders and measures. What it throws fails the check with that text.
  std::function<std::vector<Figure>(Lab&)> measure;
  bool slow = false;  ///< more than about ten seconds on two cores
};

/// Adds checks of one group to a list, which outlives it.
class CheckGroup {
 public:
  CheckGroup(std::vector<Check>& checks, std::string group) : checks_(checks), group_(std::move(group)) {}
  /// The members of Check, in their order.
  void operator()(std::string name, std::string extreme, std::string danger, std::string guard,
                  std::function<std::vector<Figure>(Lab&)> measure, bool slow = false) const;

 private:
  std::vector<Check>& checks_;
  std::string group_;
};

/// All checks; those of one group stand together.
[[nodiscard]] std::vector<Check> all_checks();

// Each adds the checks of one group.
void add_geometry_checks(std::vector<Check>& checks);
void add_grid_checks(std::vector<Check>& checks);
void add_metamorphic_checks(std::vector<Check>& checks);
void add_random_checks(std::vector<Check>& checks);
void add_shape_checks(std::vector<Check>& checks);
void add_view_checks(std::vector<Check>& checks);
void add_generator_checks(std::vector<Check>& checks);
void add_material_checks(std::vector<Check>& checks);
void add_sampler_checks(std::vector<Check>& checks);
void add_table_checks(std::vector<Check>& checks);
void add_light_checks(std::vector<Check>& checks);
void add_source_checks(std::vector<Check>& checks);
void add_accumulation_checks(std::vector<Check>& checks);
void add_variance_checks(std::vector<Check>& checks);
void add_injection_checks(std::vector<Check>& checks);
void add_history_checks(std::vector<Check>& checks);
void add_surface_checks(std::vector<Check>& checks);

}  // namespace lightloom::stability
