// Plans of the graphs that ship, spoilt in one place each: the verifier must catch every mutant, or the mutant must be
// of a kind that is known to be harmless. The table that this prints stands in docs/plan.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "framework/base/file.hpp"
#include "framework/graph/verify.hpp"
#include "tests/graph/real_passes.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom {
namespace {

constexpr auto kLastAccess = Access::frame_input_read;
constexpr VkAccessFlags2 kReadBits = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                     VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                                     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                                     VK_ACCESS_2_HOST_READ_BIT;

struct Count {
  uint32_t caught = 0;
  uint32_t harmless = 0;
};
using Table = std::map<std::string, Count>;

std::vector<std::vector<Barrier>*> lists_of(Plan& plan) {
  std::vector<std::vector<Barrier>*> lists = {&plan.prologue_barriers, &plan.frame_start, &plan.inputs_ready,
                                              &plan.once_barriers};
  for (Observation& observation : plan.opening_observations) lists.push_back(&observation.barriers);
  for (std::vector<PlanStep>* steps : {&plan.once, &plan.steps})
    for (PlanStep& step : *steps) {
      lists.push_back(&step.barriers);
      for (Observation& observation : step.observations) lists.push_back(&observation.barriers);
    }
  return lists;
}

/// Rows of the access table that have some, but not all, of the stages and accesses of another one.
std::vector<Access> narrower(Access wide) {
  std::vector<Access> result;
  const AccessInfo& all = access_info(wide);
  for (auto row = static_cast<int>(Access::none) + 1; row <= static_cast<int>(kLastAccess); ++row) {
    const AccessInfo& part = access_info(static_cast<Access>(row));
    const bool within = (part.stages & ~all.stages) == 0 && (part.access & ~all.access) == 0;
    if (within && (part.stages != all.stages || part.access != all.access)) result.push_back(static_cast<Access>(row));
  }
  return result;
}

class Mutator {
 public:
  Mutator(Plan plan, Table& table) : plan_(std::move(plan)), table_(table) {}

  void run() {
    for (std::vector<Barrier>* list : lists_of(plan_))
      for (size_t i = 0; i < list->size(); ++i) {
        drop(*list, i);
        narrow(*list, i);
      }
    for (size_t i = 0; i + 1 < plan_.steps.size(); ++i) {
      const bool strangers = !reads(i + 1, i);
      std::swap(plan_.steps[i], plan_.steps[i + 1]);
      judge("two steps exchanged", strangers, plan_.graph.passes[plan_.steps[i].pass].name);
      std::swap(plan_.steps[i], plan_.steps[i + 1]);
    }
  }

 private:
  /// Does one step read what the other writes in the same frame?
  bool reads(size_t reader, size_t writer) const {
    const std::vector<Use>& inputs = plan_.graph.passes[plan_.steps[reader].pass].inputs;
    const std::vector<Use>& outputs = plan_.graph.passes[plan_.steps[writer].pass].outputs;
    return std::any_of(inputs.begin(), inputs.end(), [&](const Use& input) {
      return input.first_age == 0 && std::any_of(outputs.begin(), outputs.end(),
                                                 [&](const Use& output) { return output.value == input.value; });
    });
  }

  void drop(std::vector<Barrier>& list, size_t i) {
    const Barrier dropped = list[i];
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(i));
    // In a ring, the barriers of the frames between may hold those already who are done frames before.
    const bool ring = dropped.value < plan_.graph.values.size() && plan_.graph.values[dropped.value].history > 0 &&
                      dropped.hazard == Hazard::write_after_read;
    judge("a barrier dropped", ring, dropped.reason);
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(i), dropped);
  }

  void narrow(std::vector<Barrier>& list, size_t i) {
    const Barrier whole = list[i];
    for (const Access part : narrower(whole.from)) {
      list[i].from = part;
      // Nothing has to be made available of what was only read.
      const AccessInfo& all = access_info(whole.from);
      const AccessInfo& left = access_info(part);
      const bool reads_alone = all.stages == left.stages && ((all.access & ~left.access) & ~kReadBits) == 0;
      judge("bits of the source dropped", reads_alone, whole.reason);
    }
    list[i] = whole;
    for (const Access part : narrower(whole.to)) {
      list[i].to = part;
      // A write that reads as well may find nothing there that anyone wrote; and the clear before all frames is
      // carried on by the barrier that each frame has before its write.
      const bool carried_on = &list == &plan_.prologue_barriers;
      judge("bits of the target dropped", access_info(whole.to).writes && (access_info(part).writes || carried_on),
            whole.reason);
    }
    list[i] = whole;
  }

  void judge(const std::string& kind, bool may_be_harmless, const std::string& reason) {
    const bool caught = !verify(plan_, {}, 1).violations.empty();
    ++(caught ? table_[kind].caught : table_[kind].harmless);
    EXPECT_TRUE(caught || may_be_harmless) << plan_.graph.name << ", " << kind << ": " << reason;
  }

  Plan plan_;
  Table& table_;
};

TEST(Mutations, OfTheGraphsThatShipAreCaughtOrHarmless) {
  Table table;
  for (const char* name : {"paper.json", "lightloom.json", "stages.json", "reference.json"}) {
    for (const bool dynamic : {false, true}) {
      LinkEnvironment scene = toy::environment(dynamic);
      scene.scene_features = {{"dynamic", dynamic}, {"emissive", true}, {"specular", true}};
      Plan plan = compile(toy::graph_of(read_text_file(source_dir() / "graphs" / name), {}, real_passes(), scene));
      ASSERT_TRUE(verify(plan).violations.empty()) << name;
      Mutator(std::move(plan), table).run();
    }
  }
  for (const auto& [kind, count] : table)
    std::printf("%-28s %5u caught %5u harmless\n", kind.c_str(), count.caught, count.harmless);
  EXPECT_GT(table["a barrier dropped"].caught, 500u);
  EXPECT_GT(table["bits of the source dropped"].caught, 30u);
  EXPECT_GT(table["bits of the target dropped"].caught, 30u);
}

}  // namespace
}  // namespace lightloom
