#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "framework/graph/pass_type.hpp"

namespace lightloom::run::toy {

/// Pass types made up for the tests, each a hash of integers, so that no bit of an input can be lost on the way. All
/// have a param `salt`; their shaders are in tests/run/shaders. Together they use every kind of port, access and
/// command: inputs -> outputs,
///   noise () -> a                     another in each frame
///   still () -> a                     the same in each frame
///   mix (x, y?) -> a, bypass x        two dispatches over a scratch `tmp`
///   trail (x, past[]) -> a, bypass x  a history range as an array
///   echo (x, last) -> a, bypass x
///   frontier () -> a                  `a` and its scratch `memo` are persistent
///   stamp (x) -> a, bypass constant   cleared, then written in part
///   blank () -> a                     cleared and nothing else
///   paint (x) -> a, bypass x          drawn as an attachment
///   splat (x) -> a                    a scratch `hits` cleared, stored into by a draw, read by a dispatch
///   grow (x) -> v                     a volume
///   carve (v, old) -> v, bypass v
///   fold (v) -> a
///   split (x) -> p {u, v}, bypass constant
///   join (p) -> a
///   host (x) -> a                     on the host
[[nodiscard]] const std::vector<PassType>& integer_types();

/// A random graph of these types, and what it computes by an interpreter that knows nothing of the framework.
class IntegerGraph {
 public:
  using Texels = std::vector<uint32_t>;  ///< x fastest, then y, then z

  IntegerGraph(uint32_t seed, uint32_t passes);

  /// The graph file.
  [[nodiscard]] std::string text() const;
  /// What the graph's output is in a frame.
  [[nodiscard]] Texels output(const std::string& name, uint32_t frame) const;
  /// What "pass.port[.part]" is in a frame; of a pass that is not disabled.
  [[nodiscard]] const Texels& value(const std::string& name, uint32_t frame) const;
  /// Interprets frames 0 to `frames` - 1.
  void play(uint32_t frames);

 private:
  struct Edge {
    std::string value;
    uint32_t first = 0;
    uint32_t last = 0;
  };
  struct Node {
    std::string name;
    std::string type;
    uint32_t salt = 0;
    bool enabled = true;
    std::map<std::string, Edge> in{};
  };
  using Frame = std::map<std::string, Texels>;

  void add(const std::string& type);
  uint32_t draw() { return static_cast<uint32_t>(random_()); }
  [[nodiscard]] bool one_in(uint32_t n) { return draw() % n == 0; }
  [[nodiscard]] Edge any(const std::vector<std::string>& values, uint32_t aged_one_in);
  [[nodiscard]] Edge earlier(bool volume);
  [[nodiscard]] const Node& node_of(const std::string& value) const;
  [[nodiscard]] Texels fetch(const std::string& value, uint32_t age, uint32_t frame) const;
  [[nodiscard]] Texels fetch(const Node& node, const std::string& port, uint32_t frame) const;
  void run(const Node& node, uint32_t frame, Frame& results) const;
  void run_volume(const Node& node, uint32_t frame, Frame& results) const;

  std::mt19937 random_;
  std::vector<std::string> types_;  ///< of all passes, as histories may look ahead
  std::vector<Node> nodes_;
  std::map<std::string, Edge> outputs_;
  std::vector<std::string> images_;  ///< values so far
  std::vector<std::string> volumes_;
  std::vector<std::string> pairs_;
  std::vector<Frame> frames_;
};

}  // namespace lightloom::run::toy
