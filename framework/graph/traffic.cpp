#include "framework/graph/traffic.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace lightloom {
namespace {

bool is_volume(const Value& value) {
  return value.desc.dimension == Dimension::d3;
}

uint64_t texels_of(const Value& value) {
  const Extent3& extent = value.desc.extent;
  return uint64_t{extent.width} * extent.height * extent.depth;
}

/// An attachment that is not blended is written alone.
bool reads_what_it_writes(Access access) {
  return access == Access::compute_storage_read_write || access == Access::fragment_storage_read_write;
}

class Counter {
 public:
  Counter(const Graph& graph, const GraphPass& pass, const std::set<std::string>* bound) : graph_(graph) {
    const auto writes_volume = [&](const Use& use) { return is_volume(graph.values[use.value]); };
    whole_volumes_ = std::any_of(pass.outputs.begin(), pass.outputs.end(), writes_volume);
    for (const Use& use : pass.inputs)
      if (bound == nullptr || bound->contains(use.shader_name)) add_input(use);
    for (const Use& use : pass.outputs) add_output(use);
    for (const Use& use : pass.scratch) add_scratch(use);
  }

  [[nodiscard]] PassTraffic traffic() const {
    PassTraffic result;
    for (const auto& [format, texels] : texels_) result.texels.push_back({format, texels.first, texels.second});
    return result;
  }

 private:
  void add_input(const Use& use) {
    const Value& value = graph_.values[use.value];
    if (is_volume(value) && !whole_volumes_) return;
    for (uint32_t age = use.first_age; age <= use.last_age; ++age)
      if (seen_.insert({use.value, age}).second) texels_[value.desc.format].first += texels_of(value);
  }

  void add_output(const Use& use) {
    const Value& value = graph_.values[use.value];
    if (value.persistent || !value.read) return;
    texels_[value.desc.format].second += texels_of(value);
    if (reads_what_it_writes(use.access)) texels_[value.desc.format].first += texels_of(value);
  }

  void add_scratch(const Use& use) {
    const Value& value = graph_.values[use.value];
    if (value.persistent) return;
    texels_[value.desc.format].first += texels_of(value);
    texels_[value.desc.format].second += texels_of(value);
  }

  const Graph& graph_;
  bool whole_volumes_ = false;
  std::set<std::pair<ValueId, uint32_t>> seen_;             ///< value and age: read through two ports, it is moved once
  std::map<Format, std::pair<uint64_t, uint64_t>> texels_;  ///< read, written
};

}  // namespace

uint64_t PassTraffic::bytes_read() const {
  uint64_t bytes = 0;
  for (const TexelTraffic& entry : texels) bytes += entry.read * format_info(entry.format).bytes_per_texel;
  return bytes;
}

uint64_t PassTraffic::bytes_written() const {
  uint64_t bytes = 0;
  for (const TexelTraffic& entry : texels) bytes += entry.written * format_info(entry.format).bytes_per_texel;
  return bytes;
}

PassTraffic traffic_of(const Graph& graph, const GraphPass& pass, const std::set<std::string>* bound) {
  return Counter(graph, pass, bound).traffic();
}

}  // namespace lightloom
