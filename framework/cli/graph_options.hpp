#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/cli/argument_parser.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/plan.hpp"

namespace lightloom::cli {

/// level, declared or random:SEED.
struct OrderChoice {
  PassOrder order = PassOrder::level;
  uint64_t seed = 0;
};
[[nodiscard]] std::string parse_value(std::string_view text, OrderChoice& value);
[[nodiscard]] std::string format_value(const OrderChoice& value);

/// The options by which a command line changes a graph; shared by `render`, `plan` and `check`.
struct GraphOptions {
  std::vector<std::string> variants;
  std::vector<Assignment> sets;
  std::vector<std::string> disables;
  std::vector<Assignment> swaps;
  std::vector<Assignment> stores;
  std::vector<std::string> dumps;
  std::string geometry;
  std::optional<Size> size;
  std::optional<Size> trace_size;
  bool no_hoist = false;
  bool general = false;
  std::string sync = "minimal";
  OrderChoice order;

  void add_to(Command& command);
  [[nodiscard]] LinkOptions link_options() const;
  [[nodiscard]] CompileOptions compile_options() const;
};

}  // namespace lightloom::cli
