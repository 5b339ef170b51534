#include "framework/graph/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include "framework/base/hash.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/verify.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

using toy::file;

void expect_equal(const Graph& a, const Graph& b) {
  EXPECT_EQ(a.values, b.values);
  EXPECT_EQ(a.captures, b.captures);
  ASSERT_EQ(a.passes.size(), b.passes.size());
  for (size_t i = 0; i < a.passes.size(); ++i) {
    EXPECT_EQ(a.passes[i].name, b.passes[i].name);
    EXPECT_EQ(a.passes[i].inputs, b.passes[i].inputs);
    EXPECT_EQ(a.passes[i].outputs, b.passes[i].outputs);
    EXPECT_EQ(a.passes[i].scratch, b.passes[i].scratch);
    EXPECT_EQ(a.passes[i].once, b.passes[i].once);
  }
  EXPECT_EQ(plan_hash(compile(a)), plan_hash(compile(b)));
}

Cut cut_by_name(const Graph& graph, const std::set<std::string>& names) {
  std::vector<bool> chosen;
  for (const GraphPass& pass : graph.passes) chosen.push_back(names.contains(pass.name));
  return cut(graph, chosen);
}

std::set<std::pair<std::string, uint32_t>> needed(const Cut& part) {
  std::set<std::pair<std::string, uint32_t>> result;
  for (const NeededLayer& layer : part.needed) result.emplace(value_name(part.graph.values[layer.value]), layer.age);
  return result;
}

using Layers = std::set<std::pair<std::string, uint32_t>>;

/// What values hold, as hashes of all that they depend on.
class Symbols {
 public:
  using Given = std::map<std::pair<ValueId, uint32_t>, uint64_t>;

  explicit Symbols(const Graph& graph) : graph_(graph) {}

  /// Of a value after frame number `frame`; zeros before the first.
  uint64_t whole(ValueId id, int frame) {
    const Value& value = graph_.values[id];
    if (value.constant) return constant(value);
    if (frame < 0) return hash_text("zeros");
    const auto [entry, is_new] = known_.try_emplace({id, frame});
    if (is_new) {
      const uint64_t made = make(id, [&](ValueId input, uint32_t age) { return whole(input, frame - int(age)); });
      known_[{id, frame}] = made;
    }
    return known_[{id, frame}];
  }

  /// Of a value of a cut, from what was given; records what of it was used.
  uint64_t part(ValueId id, uint32_t age, const Given& given, Layers& used) {
    if (const auto found = given.find({id, age}); found != given.end()) {
      used.emplace(value_name(graph_.values[id]), age);
      return found->second;
    }
    if (graph_.values[id].constant) return constant(graph_.values[id]);
    EXPECT_EQ(age, 0U) << value_name(graph_.values[id]) << " of an earlier frame is given by nobody";
    if (age > 0) return 0;
    return make(id, [&](ValueId input, uint32_t input_age) { return part(input, input_age, given, used); });
  }

 private:
  static uint64_t constant(const Value& value) {
    Hasher hasher;
    for (const float channel : *value.constant) hasher.real(channel);
    return hasher.value();
  }

  template <class Read>
  uint64_t make(ValueId id, Read read) const {
    for (const GraphPass& pass : graph_.passes) {
      for (const auto* uses : {&pass.outputs, &pass.scratch}) {
        for (const Use& use : *uses) {
          if (use.value != id) continue;
          Hasher hasher;
          hasher.text(value_name(graph_.values[id]));
          for (const Use& input : pass.inputs)
            for (uint32_t age = input.first_age; age <= input.last_age; ++age) hasher.number(read(input.value, age));
          return hasher.value();
        }
      }
    }
    ADD_FAILURE() << value_name(graph_.values[id]) << " is made by nobody";
    return 0;
  }

  const Graph& graph_;
  std::map<std::pair<ValueId, int>, uint64_t> known_;
};

ValueId find(const Graph& graph, const std::string& name) {
  for (ValueId id = 0; id < graph.values.size(); ++id)
    if (value_name(graph.values[id]) == name) return id;
  throw std::runtime_error("no value " + name);
}

/// The cut, run in one frame from layers of the whole, makes what the whole makes.
void expect_same_results(const Graph& graph, const Cut& part, int frame) {
  Symbols whole(graph);
  Symbols::Given given;
  for (const NeededLayer& layer : part.needed)
    given[{layer.value, layer.age}] =
        whole.whole(find(graph, value_name(part.graph.values[layer.value])), frame - int(layer.age));
  Symbols symbols(part.graph);
  Layers used;
  for (const GraphPass& pass : part.graph.passes) {
    for (const Use& use : pass.outputs) {
      const std::string name = value_name(part.graph.values[use.value]);
      EXPECT_EQ(symbols.part(use.value, 0, given, used), whole.whole(find(graph, name), frame)) << name;
      EXPECT_EQ(part.graph.values[use.value].read, graph.values[find(graph, name)].read)
          << name << " is wanted as before";
    }
    // A pass that writes nothing still reads.
    for (const Use& use : pass.inputs)
      for (uint32_t age = use.first_age; age <= use.last_age; ++age)
        static_cast<void>(symbols.part(use.value, age, given, used));
  }
  for (const GraphOutput& output : part.graph.outputs)
    if (output.age > 0) static_cast<void>(symbols.part(output.value, output.age, given, used));
  EXPECT_EQ(used, needed(part)) << "nothing is asked for in vain";
}

TEST(Cut, OfAllPassesIsTheGraph) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    LinkOptions options;
    if (seed % 2 == 1) options.captures = {"*"};
    const Graph graph = toy::graph_of(toy::random_graph(seed, 12), options);
    const Cut part = cut(graph, std::vector<bool>(graph.passes.size(), true));
    expect_equal(part.graph, graph);
    for (const NeededLayer& layer : part.needed) EXPECT_GT(layer.age, 0U);
  }
}

TEST(Cut, RandomPartsMakeWhatTheWholeMakes) {
  std::mt19937 random(7);
  size_t needed_layers = 0;
  for (uint32_t seed = 0; seed < 120; ++seed) {
    const Graph graph = toy::graph_of(toy::random_graph(seed, 14));
    std::vector<bool> chosen;
    for (size_t pass = 0; pass < graph.passes.size(); ++pass) chosen.push_back(random() % 3 == 0);
    const Cut part = cut(graph, chosen);
    needed_layers += part.needed.size();
    for (const int frame : {0, 2, 20}) expect_same_results(graph, part, frame);
    for (const Graph& runnable : {part.graph, for_one_frame(part.graph)}) {
      const Verification result = verify(compile(runnable));
      EXPECT_TRUE(result.violations.empty()) << "seed " << seed << ": " << result.violations.front();
    }
  }
  EXPECT_GT(needed_layers, 200U);
}

constexpr const char* kPasses = R"("s": {"type": "source"}, "f": {"type": "filter", "in": {"x": "s.a"}},
    "t": {"type": "trail", "in": {"x": "f.a", "past": "f.a@1..3"}},
    "g": {"type": "filter", "in": {"x": "t.a", "y": "s.a@2"}})";

TEST(Cut, NamesWhatIsReadAndNotMade) {
  const Graph graph = toy::graph_of(file(kPasses, R"("o": "g.a")"));
  EXPECT_EQ(needed(cut_by_name(graph, {"s"})), Layers{});
  EXPECT_EQ(needed(cut_by_name(graph, {"f"})), (Layers{{"s.a", 0}}));
  EXPECT_EQ(needed(cut_by_name(graph, {"t"})), (Layers{{"f.a", 0}, {"f.a", 1}, {"f.a", 2}, {"f.a", 3}}));
  EXPECT_EQ(needed(cut_by_name(graph, {"f", "t"})), (Layers{{"s.a", 0}, {"f.a", 1}, {"f.a", 2}, {"f.a", 3}}));
  EXPECT_EQ(needed(cut_by_name(graph, {"g"})), (Layers{{"t.a", 0}, {"s.a", 2}}));
}

TEST(Cut, KeepsRingsAndOutputsOfWhatItMakes) {
  const Graph graph = toy::graph_of(file(kPasses, R"("o": "g.a", "e": "f.a")"));
  const Cut part = cut_by_name(graph, {"t", "g"});
  ASSERT_EQ(part.graph.outputs.size(), 1U);
  EXPECT_EQ(part.graph.outputs[0].name, "o");
  const Value& given = part.graph.values[find(part.graph, "f.a")];
  EXPECT_EQ(given.history, 3U) << "shaders see the ring as it was";
  EXPECT_TRUE(given.constant);
  const Cut inner = cut_by_name(graph, {"f"});
  EXPECT_EQ(inner.graph.captures, std::vector<ValueId>{}) << "an output reads it";
  const Cut unread = cut_by_name(graph, {"t"});
  EXPECT_EQ(unread.graph.captures, std::vector<ValueId>{find(unread.graph, "t.a")}) << "g, which is gone, read it";
}

TEST(Cut, InOneFrameAPassDoesAllOfItsWork) {
  const Graph graph = toy::graph_of(file(R"("k": {"type": "still"}, "s": {"type": "source"},
      "p": {"type": "patch", "in": {"x": "s.a"}}, "m": {"type": "mix", "in": {"x": "k.a", "y": "p.a"}})",
                                         R"("o": "m.a")"));
  ASSERT_FALSE(toy::pass(graph, "k").once.empty());
  const Graph alone = for_one_frame(graph);
  EXPECT_TRUE(compile(alone).once.empty());
  for (const Value& value : alone.values) EXPECT_FALSE(value.persistent) << value_name(value);
}

}  // namespace
}  // namespace lightloom
