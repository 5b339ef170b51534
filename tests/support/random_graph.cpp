#include "tests/support/random_graph.hpp"

#include <random>
#include <vector>

#include "tests/support/toy_graphs.hpp"

namespace lightloom::toy {
namespace {

class Generator {
 public:
  Generator(uint32_t seed, int passes) : random_(seed), calm_(seed % 2 == 1), kinds_(static_cast<std::size_t>(passes)) {
    for (auto& kind : kinds_) kind = random_() % (kPairs + 1);
    kinds_[0] = 0;
  }

  std::string run() {
    std::string passes = "\"p0\": {\"type\": \"" + source() + "\"},\n\"r0\": {\"type\": \"raster\"}";
    images_ = {"p0.a", "r0.p.u"};
    pairs_ = {"r0.p"};
    for (std::size_t i = 1; i < kinds_.size(); ++i) passes += ",\n" + next_pass("p" + std::to_string(i), kinds_[i]);
    std::string outputs = "\"last\": \"" + images_.back() + "\"";
    outputs += ", \"any\": \"" + any(images_) + (one_in(3) ? "@2" : "") + "\"";
    return file(passes, outputs);
  }

 private:
  bool one_in(uint32_t n) { return random_() % n == 0; }
  std::string any(const std::vector<std::string>& list) { return list[random_() % list.size()]; }

  std::string image() { return "\"" + any(images_) + (one_in(calm_ ? 20 : 5) ? age() : "") + "\""; }
  /// In every second graph nothing changes but what `raster` and histories bring in.
  std::string source() { return calm_ || one_in(4) ? "still" : "source"; }
  std::string age() { return "@" + std::to_string(1 + random_() % 3); }

  /// Also of a pass that comes later: only history may look ahead.
  std::string history() {
    const std::size_t i = random_() % kinds_.size();
    return "p" + std::to_string(kinds_[i] < kSink ? i : 0) + ".a";
  }

  std::string next_pass(const std::string& name, uint64_t kind) {
    std::string text = "\"" + name + "\": {\"type\": \"";
    switch (kind) {
      case 0:
        text += one_in(2) ? source() + "\"" : "black\", \"in\": {\"x\": " + image() + "}";
        break;
      case 1:
        text += "filter\", \"in\": {\"x\": " + image() + (one_in(2) ? ", \"y\": " + image() : "") + "}" + maybe_off();
        break;
      case 2:
        text += "mix\", \"in\": {\"x\": " + image() + ", \"y\": " + image() + "}";
        break;
      case 3:
        text += "trail\", \"in\": {\"x\": " + image() + ", \"past\": \"" + history() + "@1.." +
                std::to_string(1 + random_() % 4) + "\"}" + maybe_off();
        break;
      case 4:
        text += "accumulate\", \"in\": {\"x\": " + image() + ", \"last\": \"" + name + ".a@1\"}";
        break;
      case 5:
        text += std::string(one_in(2) ? "shade" : "patch") + "\", \"in\": {\"x\": " + image() + "}";
        break;
      case 6:
        text += "pick\", \"in\": {\"p\": \"" + any(pairs_) + (one_in(4) ? age() : "") + "\"}";
        break;
      case kSink:
        text += "sink\", \"in\": {\"x\": \"" + history() + age() + "\"}";
        return text + "}";
      default:
        text += "pairs\", \"in\": {\"p\": \"" + any(pairs_) + "\"}" + maybe_off();
        pairs_.push_back(name + ".p");
        images_.push_back(name + ".p.u");
        return text + "}";
    }
    images_.push_back(name + ".a");
    return text + "}";
  }

  std::string maybe_off() { return one_in(4) ? ", \"enabled\": false" : ""; }

  std::mt19937 random_;
  bool calm_;
  static constexpr uint64_t kSink = 7;  // the kinds from here on have no output `a`
  static constexpr uint64_t kPairs = 8;
  std::vector<uint64_t> kinds_;
  std::vector<std::string> images_;  ///< of one kind and size
  std::vector<std::string> pairs_;
};

}  // namespace

std::string random_graph(uint32_t seed, int passes) {
  return Generator(seed, passes).run();
}

}  // namespace lightloom::toy
