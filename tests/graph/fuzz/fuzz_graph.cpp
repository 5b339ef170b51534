// Spoilt graph files through every phase from the text to the verified plan: fuzz_graph SECONDS SEED [INPUT].
// Each must either be refused with a diagnostic or give a plan without a violation, soon. With INPUT, the number that a
// failure or a crash names, only that one is made, shown and tried. Exit code 1 tells of a failure.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/share_memory.hpp"
#include "framework/graph/verify.hpp"
#include "passes/registry.hpp"
#include "tests/graph/fuzz/mutator.hpp"
#include "tests/graph/memory_needs.hpp"
#include "tests/support/random_graph.hpp"
#include "tests/support/source_dir.hpp"
#include "tests/support/toy_graphs.hpp"

namespace lightloom::fuzz {
namespace {

constexpr double kLongest = 2;  ///< that any input may take [s]

/// A file that is right, or wrong in one way, and the passes that it is made of.
struct Seedling {
  std::string text;
  const PassRegistry* types = nullptr;
};

const PassRegistry& real_types() {
  static const PassRegistry types = [] {
    PassRegistry result;
    passes::register_builtin_passes(result);
    return result;
  }();
  return types;
}

std::vector<Seedling> seedlings() {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"graphs", "tests/graphs_bad"})
    for (const auto& entry : std::filesystem::directory_iterator(source_dir() / folder))
      if (entry.path().extension() == ".json" && entry.path().filename() != "expected.json")
        files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Seedling> list;
  for (const auto& file : files) list.push_back({read_text_file(file), &real_types()});
  // The graphs that ship reach furthest, and toys have what no real pass has.
  for (const auto& file : files)
    if (file.parent_path().filename() == "graphs") list.insert(list.end(), 20, {read_text_file(file), &real_types()});
  for (uint32_t seed = 0; seed < 40; ++seed)
    list.push_back({toy::random_graph(seed, 4 + static_cast<int>(seed % 12)), &toy::registry()});
  return list;
}

LinkEnvironment environment(Random& random) {
  LinkEnvironment environment = toy::environment(random() % 2 == 0);
  for (const char* feature : {"emissive", "punctual", "environment", "environment_image", "textured", "alpha",
                              "normal_mapped", "specular", "anisotropic", "metallic"})
    environment.scene_features.emplace_back(feature, random() % 2 == 0);
  return environment;
}

/// What a command line could ask of this file; every third asks for nothing.
LinkOptions options(const GraphSpec& spec, const PassRegistry& types, Random& random) {
  LinkOptions options;
  if (random() % 3 == 0) return options;
  std::vector<std::string> passes = {"*", "nobody"};
  for (const PassSpec& pass : spec.passes) passes.push_back(pass.name);
  const std::vector<std::string> values = {"0", "1", "-1", "1e9", "true", "x", ""};
  for (const VariantSpec& variant : spec.variants)
    if (random() % 4 == 0) options.variants.push_back(variant.name);
  if (random() % 4 == 0) options.disables.push_back(any(passes, random));
  if (random() % 4 == 0) options.swaps.emplace_back(any(passes, random), any(types.names(), random));
  if (random() % 4 == 0) options.captures.push_back(random() % 2 == 0 ? "*" : any(passes, random) + ".*");
  if (random() % 6 == 0) options.sets.emplace_back(any(passes, random) + ".strength", any(values, random));
  if (random() % 6 == 0) options.type_sets.push_back({"--geometry", any(types.names(), random), "geometry", "voxels"});
  if (random() % 4 == 0)
    options.view = {static_cast<uint32_t>(random() % 20000), static_cast<uint32_t>(random() % 500)};
  options.hoist = random() % 4 != 0;
  options.general = random() % 8 == 0;
  return options;
}

CompileOptions compile_options(Random& random) {
  CompileOptions options;
  options.sync = random() % 4 == 0 ? SyncPolicy::conservative : SyncPolicy::minimal;
  options.order = static_cast<PassOrder>(random() % 3);
  options.order_seed = random();
  options.scan = random() % 4 == 0;
  return options;
}

/// How far inputs came.
struct Counts {
  uint64_t inputs = 0;
  uint64_t read = 0;      ///< the parser had nothing to say
  uint64_t verified = 0;  ///< plans
  uint64_t barriers = 0;
  double longest = 0;                     ///< [s]
  std::map<std::string, uint64_t> codes;  ///< inputs that a diagnostic's code was said of
};

std::string check_diagnostics(const Diagnostics& diagnostics, bool passed, Counts& counts) {
  if (passed == diagnostics.has_errors()) return passed ? "passes with an error" : "fails without a diagnostic";
  std::map<std::string, bool> codes;
  for (const Diagnostic& diagnostic : diagnostics.sorted()) {
    codes[diagnostic.code] = true;
    const std::string text = format_diagnostic(diagnostic);
    if (diagnostic.message.empty() || diagnostic.where.file.empty() ||
        diagnostic.message.find('\n') != std::string::npos)
      return "has a diagnostic of bad form: " + text;
  }
  for (const auto& [code, said] : codes) ++counts.codes[code];
  return {};
}

std::string check_plan(const Graph& graph, Random& random, Counts& counts) {
  Plan plan = compile(graph, compile_options(random));
  const std::vector<MemoryNeed> needs = toy::needs_of(graph);
  PlannedMemory memory;
  MemorySharing sharing;
  if (random() % 2 == 0) {
    sharing = share_memory(plan, needs);
    memory = {&sharing, needs};
  }
  const Verification result = verify(plan, memory, 1);
  counts.barriers += result.barriers;
  ++counts.verified;
  if (!result.violations.empty()) return "gives a plan with a violation: " + result.violations.front();
  if (print_plan(plan).empty() || plan_hash(plan) != plan_hash(plan)) return "gives a plan that cannot be shown";
  return {};
}

/// What is wrong with how the text was treated; "" if nothing is.
std::string try_text(const std::string& text, const PassRegistry& types, Random& random, Counts& counts) {
  Diagnostics diagnostics;
  const std::optional<GraphSpec> spec = parse_graph(text, "graph.json", diagnostics);
  if (!diagnostics.has_errors()) ++counts.read;
  if (!spec) return check_diagnostics(diagnostics, false, counts);
  const LinkOptions chosen = options(*spec, types, random);
  const std::optional<Graph> graph = link(*spec, types, chosen, environment(random), diagnostics);
  std::string problem = check_diagnostics(diagnostics, graph.has_value(), counts);
  return problem.empty() && graph ? check_plan(*graph, random, counts) : problem;
}

// Read by the signal handler, which may use little else.
volatile std::sig_atomic_t current_input = 0;

void on_crash(int signal) {
  char text[64];
  int length = std::snprintf(text, sizeof text, "\ninput %d: signal %d\n", static_cast<int>(current_input), signal);
  if (write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) length = 0;
  _exit(1);
}

class Fuzzer {
 public:
  explicit Fuzzer(uint64_t seed) : seed_(seed), seedlings_(seedlings()), mutator_(texts(), names()) {}

  /// The input with a number is the same whatever came before it.
  bool run(uint64_t input, bool show) {
    using Clock = std::chrono::steady_clock;
    std::seed_seq sequence{static_cast<uint32_t>(seed_), static_cast<uint32_t>(input),
                           static_cast<uint32_t>(input >> 32U)};
    Random random(sequence);
    current_input = static_cast<std::sig_atomic_t>(input);
    const Seedling& seedling = any(seedlings_, random);
    const std::string text = mutator_.mutate(seedling.text, random);
    if (show) std::printf("%s\n", text.c_str());
    alarm(30);  // a hang ends in the handler
    const Clock::time_point begin = Clock::now();
    std::string problem;
    try {
      problem = try_text(text, *seedling.types, random, counts_);
    } catch (const std::exception& exception) {
      problem = std::string("throws: ") + exception.what();
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    if (problem.empty() && seconds > kLongest) problem = "takes " + std::to_string(seconds) + " s";
    counts_.longest = std::max(counts_.longest, seconds);
    ++counts_.inputs;
    if (!problem.empty()) std::printf("input %llu %s\n", static_cast<unsigned long long>(input), problem.c_str());
    return problem.empty();
  }

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> result;
    for (const Seedling& seedling : seedlings_) result.push_back(seedling.text);
    return result;
  }
  static std::vector<std::string> names() {
    std::vector<std::string> result = real_types().names();
    for (const std::string& name : toy::registry().names()) result.push_back(name);
    for (const std::string& name : real_types().names())
      for (const Port& port : real_types().find(name)->ports) result.push_back(port.name);
    return result;
  }

  uint64_t seed_;
  std::vector<Seedling> seedlings_;
  Mutator mutator_;
  Counts counts_;
};

int run(double seconds, uint64_t seed, const char* input) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGALRM, SIGFPE, SIGILL, SIGBUS}) std::signal(signal, on_crash);
  Fuzzer fuzzer(seed);
  if (input != nullptr) return fuzzer.run(std::strtoull(input, nullptr, 10), true) ? 0 : 1;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  uint64_t failures = 0;
  for (uint64_t next = 0; failures < 10 && std::chrono::steady_clock::now() < end; ++next)
    failures += fuzzer.run(next, false) ? 0 : 1;
  const Counts& counts = fuzzer.counts();
  const auto number = [](uint64_t value) { return static_cast<unsigned long long>(value); };
  std::printf(
      "%llu inputs of seed %llu, %llu without a mistake of form, %llu plans verified (%llu barriers), "
      "%llu failures; the longest took %.3f s\n",
      number(counts.inputs), number(seed), number(counts.read), number(counts.verified), number(counts.barriers),
      number(failures), counts.longest);
  for (const auto& [code, inputs] : counts.codes) std::printf("  %s: %llu\n", code.c_str(), number(inputs));
  const bool too_few = counts.verified * 50 < counts.inputs;
  if (too_few) std::printf("too few inputs came through to a plan\n");
  return failures > 0 || too_few ? 1 : 0;
}

}  // namespace
}  // namespace lightloom::fuzz

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "usage: fuzz_graph SECONDS SEED [INPUT]\n");
    return 2;
  }
  try {
    return lightloom::fuzz::run(std::strtod(arguments[1], nullptr), std::strtoull(arguments[2], nullptr, 10),
                                count > 3 ? arguments[3] : nullptr);
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "%s\n", exception.what());
    return 1;
  }
}
