#include "framework/graph/param.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

template <class T>
const T& typed(const ParamSet& params, std::string_view name) {
  const ParamSet::Entry* entry = params.find(name);
  const T* value = entry == nullptr ? nullptr : std::get_if<T>(&entry->value);
  if (value == nullptr)
    throw Error(ExitCode::run_failed,
                "a pass asks for param '" + std::string(name) + "', which its type does not declare so");
  return *value;
}

}  // namespace

void ParamSet::set(const Param& param, ParamValue value) {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.param->name == param.name; });
  if (found == entries_.end()) {
    entries_.push_back({&param, std::move(value)});
  } else {
    *found = {&param, std::move(value)};
  }
}

bool ParamSet::boolean(std::string_view name) const {
  return typed<bool>(*this, name);
}
int64_t ParamSet::integer(std::string_view name) const {
  return typed<int64_t>(*this, name);
}
double ParamSet::real(std::string_view name) const {
  return typed<double>(*this, name);
}
const std::string& ParamSet::choice(std::string_view name) const {
  return typed<std::string>(*this, name);
}

uint32_t ParamSet::choice_index(std::string_view name) const {
  const std::string& value = choice(name);
  const std::vector<std::string>& choices = find(name)->param->choices;
  return static_cast<uint32_t>(std::find(choices.begin(), choices.end(), value) - choices.begin());
}

const ParamSet::Entry* ParamSet::find(std::string_view name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.param->name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

std::string to_string(const ParamValue& value) {
  if (const bool* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  if (const int64_t* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
  if (const double* real = std::get_if<double>(&value)) {
    std::array<char, 32> buffer{};
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), *real);
    std::string text(buffer.data(), result.ptr);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
  }
  std::string text = "\"";
  for (const char c : std::get<std::string>(value)) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

}  // namespace lightloom
