#include "framework/study/settings.hpp"

#include <algorithm>
#include <set>

#include "framework/base/text.hpp"

namespace lightloom::study {
namespace {

/// A setting in the making; many of them, of which one is chosen, form a group.
using Group = std::vector<Setting>;

constexpr const char* kVariantAxis = "variant";
constexpr const char* kWhole = "full";

std::string joined(const std::string& first, const std::string& second) {
  return first.empty() || second.empty() ? first + second : first + ", " + second;
}

Setting combine(const Setting& first, const Setting& second) {
  Setting both = first;
  both.name = joined(first.name, second.name);
  both.values.insert(both.values.end(), second.values.begin(), second.values.end());
  both.changes = combine(first.changes, second.changes);
  if (second.where.line > 0) both.where = second.where;
  return both;
}

Group cross(const Group& first, const Group& second) {
  Group all;
  for (const Setting& one : first)
    for (const Setting& other : second) all.push_back(combine(one, other));
  return all;
}

/// Product of sizes, without overflow.
bool too_many(const std::vector<size_t>& sizes) {
  size_t product = 1;
  for (const size_t size : sizes) {
    product *= std::max<size_t>(size, 1);
    if (product > kMostSettings) return true;
  }
  return false;
}

Setting variant(const Choice& choice) {
  return {choice.name, {{kVariantAxis, choice.name}}, choice.changes, choice.where};
}

Setting without(const std::string& pass, const SourceLocation& where) {
  Changes changes;
  changes.disables = {pass};
  const std::string name = "without " + pass;
  return {name, {{kVariantAxis, name}}, std::move(changes), where};
}

Group combinations(const std::vector<std::string>& passes, const SourceLocation& where) {
  Group group;
  for (size_t bits = 0; bits < size_t{1} << passes.size(); ++bits) {
    Setting setting;
    setting.where = where;
    for (size_t i = 0; i < passes.size(); ++i) {
      const bool off = (bits >> i & 1) != 0;
      setting.values.emplace_back(passes[i], off ? "off" : "on");
      if (off) setting.changes.disables.push_back(passes[i]);
    }
    const std::vector<std::string>& off = setting.changes.disables;
    setting.name = off.empty() ? kWhole : "without " + join(off, " and ");
    group.push_back(std::move(setting));
  }
  return group;
}

Setting axis_setting(const Axis& axis, const Choice& choice) {
  return {axis.name + "=" + choice.name, {{axis.name, choice.name}}, choice.changes, choice.where};
}

Group sweep_crossed(const std::vector<Axis>& axes) {
  Group group = {Setting{}};
  for (const Axis& axis : axes) {
    Group values;
    for (const Choice& choice : axis.choices) values.push_back(axis_setting(axis, choice));
    group = cross(group, values);
  }
  return group;
}

Group sweep_one_at_a_time(const std::vector<Axis>& axes) {
  const auto with = [&](size_t varied, size_t value) {
    Setting setting;
    for (size_t i = 0; i < axes.size(); ++i)
      setting = combine(setting, axis_setting(axes[i], axes[i].choices[i == varied ? value : 0]));
    if (varied < axes.size()) setting.where = axes[varied].choices[value].where;
    return setting;
  };
  Group group = {with(axes.size(), 0)};
  for (size_t axis = 0; axis < axes.size(); ++axis)
    for (size_t value = 1; value < axes[axis].choices.size(); ++value) group.push_back(with(axis, value));
  return group;
}

/// Passes that the globs match, in the graph's order.
std::vector<std::string> ablated_passes(const StudySpec& spec, const std::vector<std::string>& passes,
                                        Diagnostics& diagnostics) {
  std::vector<std::string> matched;
  for (const std::string& glob : spec.ablate)
    if (std::none_of(passes.begin(), passes.end(), [&](const auto& pass) { return glob_match(glob, pass); }))
      diagnostics.error("no-match", spec.ablate_where, in_quotes(glob) + " matches no pass that runs",
                        did_you_mean(glob, passes, "these run"));
  for (const std::string& pass : passes)
    if (std::any_of(spec.ablate.begin(), spec.ablate.end(), [&](const auto& glob) { return glob_match(glob, pass); }))
      matched.push_back(pass);
  return matched;
}

Group alternatives(const StudySpec& spec, const std::vector<std::string>& ablated) {
  Group group;
  if (!ablated.empty() && !spec.factorial) {
    group.push_back({kWhole, {{kVariantAxis, kWhole}}, {}, {}});
    for (const std::string& pass : ablated) group.push_back(without(pass, spec.ablate_where));
  }
  for (const Choice& choice : spec.variants) group.push_back(variant(choice));
  if (group.empty()) group.push_back({});
  return spec.factorial ? cross(group, combinations(ablated, spec.ablate_where)) : group;
}

/// The sizes whose product is the number of settings.
std::vector<size_t> group_sizes(const StudySpec& spec, size_t ablated) {
  std::vector<size_t> sizes = {spec.variants.size() + (spec.factorial || ablated == 0 ? 0 : ablated + 1)};
  if (spec.factorial) sizes.insert(sizes.end(), ablated, 2);
  if (spec.crossed) {
    for (const Axis& axis : spec.sweep) sizes.push_back(axis.choices.size());
  } else {
    size_t sum = 1;
    for (const Axis& axis : spec.sweep) sum += axis.choices.size() - 1;
    sizes.push_back(sum);
  }
  return sizes;
}

bool check_names(const std::vector<Setting>& settings, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const Setting& setting : settings)
    if (!names.insert(setting.name).second) {
      diagnostics.error("duplicate", setting.where, "two settings would be called " + in_quotes(setting.name),
                        "give variants other names");
      return false;
    }
  return true;
}

}  // namespace

std::optional<Settings> expand_settings(const StudySpec& spec, const std::vector<std::string>& passes,
                                        Diagnostics& diagnostics) {
  const std::vector<std::string> ablated = ablated_passes(spec, passes, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  if (too_many(group_sizes(spec, ablated.size()))) {
    diagnostics.error("too-many-settings",
                      spec.ablate_where.file.empty() ? SourceLocation{spec.file.string(), 0, 0} : spec.ablate_where,
                      "the study has more than " + std::to_string(kMostSettings) + " settings",
                      spec.factorial
                          ? std::to_string(ablated.size()) + " passes have 2^" + std::to_string(ablated.size()) +
                                " combinations; leave 'factorial' out, or name fewer passes"
                          : "fewer values, or \"mode\": \"one_at_a_time\"");
    return std::nullopt;
  }
  Settings settings;
  settings.list =
      cross(alternatives(spec, ablated), spec.crossed ? sweep_crossed(spec.sweep) : sweep_one_at_a_time(spec.sweep));
  for (Setting& setting : settings.list)
    if (setting.name.empty()) setting.name = kWhole;
  for (const auto& [axis, value] : settings.list.front().values) settings.axes.push_back(axis);
  if (!check_names(settings.list, diagnostics)) return std::nullopt;
  return settings;
}

}  // namespace lightloom::study
