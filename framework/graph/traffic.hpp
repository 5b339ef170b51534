#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"

namespace lightloom {

/// Texels of one format that a pass moves.
struct TexelTraffic {
  Format format = Format::rgba16_sfloat;
  uint64_t read = 0;
  uint64_t written = 0;
};

/// What a pass has to move between memory and itself in a frame, if it touches each texel once.
struct PassTraffic {
  std::vector<TexelTraffic> texels;  ///< a format each, in the order of Format
  [[nodiscard]] uint64_t bytes_read() const;
  [[nodiscard]] uint64_t bytes_written() const;
};

/// By what the graph declares: each layer of an input that is read, each output that somebody reads, and scratch, which
/// is written and read. What a pass need not touch does not count: volumes in which a pass looks things up that writes
/// no volume itself, and values that persist, of which a frame may leave all as it is. Buffers of the scene are not
/// values, so they do not count either.
/// @param bound what the pass's shaders bind, where that is known: other inputs do not count
[[nodiscard]] PassTraffic traffic_of(const Graph& graph, const GraphPass& pass,
                                     const std::set<std::string>* bound = nullptr);

}  // namespace lightloom
