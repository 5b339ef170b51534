#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

bool is_reference(const ParamValue& value) {
  const std::string* text = std::get_if<std::string>(&value);
  return text != nullptr && text->starts_with('$');
}

std::string number_text(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? std::to_string(static_cast<int64_t>(value))
                                                              : to_string(ParamValue(value));
}

std::string range_text(const Param& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  if (param.minimum && param.maximum)
    return "lie within " + number_text(*param.minimum) + " and " + number_text(*param.maximum) + unit;
  return param.minimum ? "be at least " + number_text(*param.minimum) + unit
                       : "be at most " + number_text(*param.maximum) + unit;
}

std::string_view wanted(ParamType type) {
  switch (type) {
    case ParamType::boolean:
      return "true or false";
    case ParamType::integer:
      return "an integer";
    case ParamType::real:
      return "a number";
    case ParamType::choice:
      break;
  }
  return "a string";
}

class ValueCheck {
 public:
  ValueCheck(const Param& param, const SourceLocation& where, std::string what, Report& report)
      : param_(param), where_(where), what_(std::move(what)), report_(report) {}

  /// The value in the param's own type; empty and reported if it does not fit.
  std::optional<ParamValue> convert(const ParamValue& value) {
    switch (param_.type) {
      case ParamType::boolean:
        if (std::holds_alternative<bool>(value)) return value;
        break;
      case ParamType::integer:
        if (const int64_t* integer = std::get_if<int64_t>(&value))
          return in_range(static_cast<double>(*integer), value) ? std::optional(value) : std::nullopt;
        break;
      case ParamType::real:
        return convert_real(value);
      case ParamType::choice:
        if (std::holds_alternative<std::string>(value)) return convert_choice(value);
        break;
    }
    return wrong_type(value);
  }

 private:
  std::nullopt_t wrong_type(const ParamValue& value) {
    report_.error("wrong-type", where_,
                  what_ + " must be " + std::string(wanted(param_.type)) + ", not " + to_string(value));
    return std::nullopt;
  }

  bool in_range(double number, const ParamValue& value) {
    if (std::isfinite(number) && (!param_.minimum || number >= *param_.minimum) &&
        (!param_.maximum || number <= *param_.maximum))
      return true;
    const bool bounded = param_.minimum || param_.maximum;
    report_.error("out-of-range", where_,
                  what_ + " must " + (bounded ? range_text(param_) : "be finite") + ", not " + to_string(value));
    return false;
  }

  std::optional<ParamValue> convert_real(const ParamValue& value) {
    double number = 0;
    if (const int64_t* integer = std::get_if<int64_t>(&value)) {
      number = static_cast<double>(*integer);
    } else if (const double* real = std::get_if<double>(&value)) {
      number = *real;
    } else {
      return wrong_type(value);
    }
    return in_range(number, value) ? std::optional<ParamValue>(number) : std::nullopt;
  }

  std::optional<ParamValue> convert_choice(const ParamValue& value) {
    const std::string& text = std::get<std::string>(value);
    if (std::find(param_.choices.begin(), param_.choices.end(), text) != param_.choices.end()) return value;
    const std::string listed = "choices: " + join(param_.choices, ", ");
    const auto close = closest_match(text, param_.choices);
    report_.error("unknown-choice", where_, what_ + " has no choice " + in_quotes(text),
                  close ? "did you mean '" + *close + "'? " + listed : listed);
    return std::nullopt;
  }

  const Param& param_;
  SourceLocation where_;
  std::string what_;
  Report& report_;
};

const ScalarSpec* find(const std::vector<ScalarSpec>& params, std::string_view name) {
  const auto found =
      std::find_if(params.begin(), params.end(), [&](const ScalarSpec& param) { return param.name == name; });
  return found == params.end() ? nullptr : &*found;
}

std::optional<ParamValue> resolve(const Param& param, const Node& node, const Nodes& nodes, Report& report) {
  const ScalarSpec* given = find(node.params, param.name);
  if (given == nullptr || given->broken) return std::nullopt;
  std::string what = "param '" + param.name + "' of pass '" + node.spec->name + "'";
  if (!is_reference(given->value)) return ValueCheck(param, given->where, what, report).convert(given->value);
  const std::string name = std::get<std::string>(given->value).substr(1);
  const ScalarSpec* source = find(nodes.graph_params, name);
  if (source == nullptr) {
    std::vector<std::string> names;
    for (const ScalarSpec& candidate : nodes.graph_params) names.push_back(candidate.name);
    report.error("unknown-graph-param", given->where,
                 what + " refers to " + in_quotes("$" + name) + ", but the graph has no such param",
                 did_you_mean(name, names, "graph params"));
    return std::nullopt;
  }
  if (source->broken) return std::nullopt;
  return ValueCheck(param, source->where, what + " (through $" + name + ")", report).convert(source->value);
}

}  // namespace

void resolve_params(Nodes& nodes, Report& report) {
  for (Node& node : nodes.list) {
    node.resolved = {};
    if (node.type == nullptr) continue;
    for (const Param& param : node.type->params)
      node.resolved.set(param, resolve(param, node, nodes, report).value_or(param.default_value));
  }
}

void warn_unused_params(const Nodes& nodes, const Input& input, Report& report) {
  std::set<std::string> used;
  const auto note = [&](const std::vector<ScalarSpec>& params) {
    for (const ScalarSpec& param : params)
      if (is_reference(param.value)) used.insert(std::get<std::string>(param.value).substr(1));
  };
  for (const PassSpec& pass : input.spec.passes) note(pass.params);
  for (const VariantSpec& variant : input.spec.variants) note(variant.set);
  for (const Node& node : nodes.list) note(node.params);
  for (const ScalarSpec& param : input.spec.params)
    if (!used.contains(param.name))
      report.warning("unused-param", param.name_where, "no pass uses graph param '" + param.name + "'",
                     "write \"$" + param.name + "\" where a pass should take it");
}

}  // namespace lightloom::linking
