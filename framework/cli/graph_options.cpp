#include "framework/cli/graph_options.hpp"

#include <charconv>
#include <system_error>

namespace lightloom::cli {

std::string parse_value(std::string_view text, OrderChoice& value) {
  constexpr std::string_view kRandom = "random:";
  uint64_t seed = 0;
  if (text.starts_with(kRandom)) {
    const char* end = text.data() + text.size();
    const auto result = std::from_chars(text.data() + kRandom.size(), end, seed);
    if (result.ec == std::errc{} && result.ptr == end) {
      value = {PassOrder::random, seed};
      return {};
    }
  }
  if (text != "level" && text != "declared")
    return "expected level, declared or random:SEED, with a seed from 0 to 2^64 - 1";
  value = {text == "level" ? PassOrder::level : PassOrder::declared, 0};
  return {};
}

std::string format_value(const OrderChoice& value) {
  return to_string(value.order, value.seed);
}

void GraphOptions::add_to(Command& command) {
  const auto group = [](Option& option) -> Option& { return option.group("Changes to the graph"); };
  group(command.option("--variant", variants, "Apply a variant that the graph declares")).placeholder("NAME");
  group(command.option("--set", sets,
                       "Set a parameter of the graph (NAME=VALUE) or of a pass (PASS.PARAM=VALUE, where PASS "
                       "may be a pattern such as 'denoise_*')"));
  group(command.option("--disable", disables, "Disable the passes that match; each output is replaced by its bypass"))
      .placeholder("GLOB");
  group(command.option("--swap", swaps, "Exchange the type of the passes that match, e.g. trace=reference_path_trace"))
      .placeholder("GLOB=TYPE");
  group(command.option("--store", stores,
                       "Format in which the values that match PASS.PORT or PASS.PORT.PART are stored, e.g. "
                       "'*.radiance=rgba16_sfloat'; of several those that can be"))
      .placeholder("GLOB=FORMAT");
  group(command.option("--geometry", geometry,
                       "What the passes of type reference_path_trace trace: the scene's triangles, or its voxels"))
      .choices({"triangles", "voxels"})
      .default_text("as the graph has it");
  group(command.option("--dump", dumps, "Write the values that match PASS.PORT or PASS.PORT.PART, '*' for all of them"))
      .placeholder("GLOB");
  group(command.flag("--no-hoist", no_hoist,
                     "Run every pass in every frame, those as well that give the same each time; the pictures are the "
                     "same"));
  group(command.flag("--general", general,
                     "Model all that any scene could need, not only what this one requires: every pass whatever its "
                     "'when', shaders with every feature, nothing hoisted; the pictures are the same"));
  group(command.option("--sync", sync,
                       "Barriers: only those that the accesses demand, or everything before each pass done before it "
                       "begins; the pictures are the same"))
      .choices({"minimal", "conservative"});
  group(command.option("--order", order,
                       "Order of passes that do not need each other: level (as soon as possible), declared (as in the "
                       "file) or random:SEED; the pictures are the same"))
      .placeholder("ORDER");
  group(command.option("--size", size, "View size in pixels, instead of the graph's"));
  group(command.option("--trace-size", trace_size, "Size in pixels at which is traced, instead of the graph's"));
}

LinkOptions GraphOptions::link_options() const {
  LinkOptions options;
  options.variants = variants;
  options.disables = disables;
  options.captures = dumps;
  for (const Assignment& set : sets) options.sets.emplace_back(set.name, set.value);
  for (const Assignment& swap : swaps) options.swaps.emplace_back(swap.name, swap.value);
  for (const Assignment& store : stores) options.formats.emplace_back(store.name, store.value);
  if (!geometry.empty()) options.type_sets.push_back({"--geometry", "reference_path_trace", "geometry", geometry});
  options.hoist = !no_hoist;
  options.general = general;
  if (size) options.view = {size->width, size->height};
  if (trace_size) options.trace = {trace_size->width, trace_size->height};
  return options;
}

CompileOptions GraphOptions::compile_options() const {
  CompileOptions options;
  if (sync == "conservative") options.sync = SyncPolicy::conservative;
  options.order = order.order;
  options.order_seed = order.seed;
  return options;
}

}  // namespace lightloom::cli
