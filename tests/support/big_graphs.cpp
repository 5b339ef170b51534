#include "tests/support/big_graphs.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "framework/base/text.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom::toy {
namespace {

std::string name(uint32_t index) {
  return "p" + std::to_string(index);
}

std::string pass(uint32_t index, const std::string& type, const std::string& inputs, const std::string& params = {}) {
  return "\"" + name(index) + "\": {\"type\": \"" + type + "\", \"in\": {" + inputs + "}" +
         (params.empty() ? "" : ", \"params\": {" + params + "}") + "}";
}

std::string edge(const std::string& port, uint32_t pass, const std::string& age = {}) {
  return "\"" + port + "\": \"" + name(pass) + ".a" + age + "\"";
}

/// Every eighth has scratch, every sixteenth a history, every fourth a param.
std::string link_of_chain(uint32_t i) {
  if (i % 8 == 3) return pass(i, "mix", edge("x", i - 1) + ", " + edge("y", i - 1));
  if (i % 16 == 5) return pass(i, "accumulate", edge("x", i - 1) + ", " + edge("last", i, "@1"));
  return i % 4 == 0 ? pass(i, "filter", edge("x", i - 1), "\"strength\": \"$strength\"")
                    : pass(i, "blur", edge("x", i - 1));
}

std::vector<std::string> links_of_chain(uint32_t passes) {
  std::vector<std::string> links = {R"("p0": {"type": "source"})"};
  for (uint32_t i = 1; i < passes; ++i) links.push_back(link_of_chain(i));
  return links;
}

std::string whole(const std::vector<std::string>& passes, const std::string& outputs) {
  return file(join(passes, ",\n"), outputs, R"("params": {"strength": 0.5},)");
}

std::string last_of(uint32_t passes) {
  return "\"o\": \"" + name(passes - 1) + ".a\"";
}

/// What a pass of the layered graph may read: `sources` are in the layers before it.
std::string member_of_layer(uint32_t i, const std::vector<uint32_t>& sources, std::mt19937& random) {
  const auto any = [&] { return sources[random() % sources.size()]; };
  switch (random() % 8) {
    case 0:
      return pass(i, "mix", edge("x", any()) + ", " + edge("y", any()));
    case 1:
      return pass(i, "accumulate", edge("x", any()) + ", " + edge("last", i, "@1"));
    case 2:
      return pass(i, "trail", edge("x", any()) + ", " + edge("past", any(), "@1..3"));
    case 3:
      return pass(i, "patch", edge("x", any()));
    case 4:
      return pass(i, "blur", edge("x", any()), "\"strength\": \"$strength\", \"taps\": 7");
    default:
      return pass(i, "filter", edge("x", any()) + ", " + edge("y", any()));
  }
}

}  // namespace

std::string chain(uint32_t passes) {
  return whole(links_of_chain(passes), last_of(passes));
}

std::string backward_chain(uint32_t passes) {
  std::vector<std::string> links = links_of_chain(passes);
  std::reverse(links.begin(), links.end());
  return whole(links, last_of(passes));
}

std::string layers(uint32_t passes, uint32_t seed) {
  constexpr uint32_t kWidth = 16;
  constexpr uint32_t kReach = 4;
  std::mt19937 random(seed);
  std::vector<std::string> members;
  for (uint32_t i = 0; i < passes; ++i) {
    const uint32_t layer = i / kWidth;
    std::vector<uint32_t> sources;
    for (uint32_t j = layer < kReach ? 0 : (layer - kReach) * kWidth; j < layer * kWidth; ++j) sources.push_back(j);
    members.push_back(layer == 0 ? "\"" + name(i) + "\": {\"type\": \"source\"}" : member_of_layer(i, sources, random));
  }
  const std::string text = join(members, ",\n");
  std::vector<std::string> outputs;  // what nobody reads
  for (uint32_t i = 0; i < passes; ++i)
    if (text.find("\"" + name(i) + ".a") == std::string::npos)
      outputs.push_back("\"o" + std::to_string(i) + "\": \"" + name(i) + ".a\"");
  return whole(members, join(outputs, ", "));
}

std::string hub(uint32_t passes) {
  std::vector<std::string> members = {R"("p0": {"type": "source"})"};
  for (uint32_t i = 1; i + 1 < passes; ++i) members.push_back(pass(i, "sink", edge("x", 0)));
  members.push_back(pass(passes - 1, "blur", edge("x", 0)));
  return whole(members, last_of(passes));
}

}  // namespace lightloom::toy
