#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace lightloom {

using ParamValue = std::variant<bool, int64_t, double, std::string>;

enum class ParamType : uint8_t { boolean, integer, real, choice };

/// One row of a pass type's parameter table; drives parsing, ranges, the command line and the generated docs.
struct Param {
  std::string name;
  ParamType type = ParamType::real;
  ParamValue default_value;
  std::optional<double> minimum;     ///< inclusive
  std::optional<double> maximum;     ///< inclusive
  std::vector<std::string> choices;  ///< ParamType::choice: the shader sees the index
  std::string unit;                  ///< "voxels", "pixels", "metres", …; empty for a pure number
  std::string doc;
};

/// Resolved, typed parameters of one pass: every declared name has a value of the declared type.
class ParamSet {
 public:
  struct Entry {
    const Param* param = nullptr;
    ParamValue value;
  };
  void set(const Param& param, ParamValue value);
  [[nodiscard]] bool boolean(std::string_view name) const;
  [[nodiscard]] int64_t integer(std::string_view name) const;
  [[nodiscard]] double real(std::string_view name) const;
  [[nodiscard]] const std::string& choice(std::string_view name) const;
  /// Index into Param::choices.
  [[nodiscard]] uint32_t choice_index(std::string_view name) const;
  [[nodiscard]] const Entry* find(std::string_view name) const;
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

[[nodiscard]] std::string to_string(const ParamValue& value);  ///< as it would stand in JSON

}  // namespace lightloom
