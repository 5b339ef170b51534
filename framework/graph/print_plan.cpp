#include <array>
#include <cstdio>
#include <sstream>
#include <unordered_map>
#include <utility>

#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"
#include "framework/graph/plan.hpp"

namespace lightloom {
namespace {

std::string bytes_text(uint64_t bytes) {
  constexpr std::array<const char*, 4> kUnits{"B", "KiB", "MiB", "GiB"};
  auto amount = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; amount >= 1024 && unit + 1 < kUnits.size(); ++unit) amount /= 1024;
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), unit == 0 ? "%.0f %s" : "%.1f %s", amount, kUnits.at(unit));
  return buffer.data();
}

class Printer {
 public:
  explicit Printer(const Plan& plan) : plan_(plan), graph_(plan.graph) {}

  std::string run() {
    const MemoryUse memory = memory_use(graph_);
    out_ << "plan of '" << graph_.name << "' " << hex(plan_hash(plan_)) << "\n";
    out_ << "view " << to_string(graph_.view) << ", trace " << to_string(graph_.trace) << ", "
         << plan_.once.size() + plan_.steps.size() << " passes, " << plan_.once.size() << " of them once, "
         << graph_.values.size() << " images, " << bytes_text(memory.total) << " (" << bytes_text(memory.rings)
         << " in rings)\n";
    for (const auto& [name, value] : graph_.params) out_ << "param " << name << " = " << to_string(value) << "\n";
    prologue();
    once();
    out_ << "\nframe\n";
    barriers(plan_.frame_start);
    out_ << "  upload frame inputs\n";
    barriers(plan_.inputs_ready);
    observations(plan_.opening_observations);
    for (const PlanStep& each : plan_.steps) step(each);
    remarks();
    return out_.str();
  }

 private:
  std::string name(ValueId value) const { return barrier_subject(graph_, value); }

  void prologue() {
    if (plan_.prologue.empty()) return;
    out_ << "\nprologue\n";
    for (const Clear& clear : plan_.prologue) {
      const Value& value = graph_.values[clear.value];
      out_ << "  clear " << value_name(value) << " to (" << clear.color[0] << ", " << clear.color[1] << ", "
           << clear.color[2] << ", " << clear.color[3] << "), ";
      if (value.constant) {
        out_ << "constant " << to_string(value.desc) << "\n";
      } else if (value.persistent) {
        out_ << "kept from frame to frame\n";
      } else {
        out_ << "ring of " << ring_layers(value) << "\n";
      }
    }
    barriers(plan_.prologue_barriers);
  }

  void once() {
    if (plan_.once.empty()) return;
    out_ << "\nonce, in the first frame when its inputs are there\n";
    for (const PlanStep& each : plan_.once) step(each);
    barriers(plan_.once_barriers);
  }

  /// Barriers on parts of one port that differ in nothing else share a line.
  void barriers(const std::vector<Barrier>& list) {
    std::vector<std::pair<std::string, std::vector<std::string>>> lines;  // port and what follows it, parts
    std::unordered_map<std::string, std::size_t> line_of;
    for (const Barrier& barrier : list) {
      std::string port = name(barrier.value);
      std::string part;
      if (barrier.value < graph_.values.size()) {
        port = graph_.values[barrier.value].pass + "." + graph_.values[barrier.value].port;
        part = graph_.values[barrier.value].part;
      }
      std::ostringstream line;
      line << ": " << access_info(barrier.from).name << " -> " << access_info(barrier.to).name << ", "
           << to_string(barrier.hazard) << (barrier.previous_frame ? ", previous frame" : "") << ": " << barrier.reason;
      const std::string key = port + "\n" + line.str();
      const auto [known, is_new] = line_of.try_emplace(key, lines.size());
      if (is_new) lines.emplace_back(key, std::vector<std::string>{});
      lines[known->second].second.push_back(part);
    }
    for (const auto& [key, parts] : lines) {
      const std::size_t end = key.find('\n');
      out_ << "  | " << key.substr(0, end) << (parts.front().empty() ? "" : ".{" + join(parts, ",") + "}")
           << key.substr(end + 1) << "\n";
    }
  }

  void observations(const std::vector<Observation>& list) {
    for (const Observation& observation : list) {
      barriers(observation.barriers);
      out_ << (observation.observer == Observer::scan ? "  scan " : "  read back ") << name(observation.value);
      if (observation.age > 0) out_ << "@" << observation.age;
      out_ << "\n";
    }
  }

  void step(const PlanStep& step) {
    const GraphPass& pass = graph_.passes[step.pass];
    barriers(step.barriers);
    out_ << "  " << ++steps_ << ". " << pass.name << " (" << pass.type->name << ")";
    for (const ParamSet::Entry& entry : pass.params.entries())
      out_ << " " << entry.param->name << "=" << to_string(entry.value);
    out_ << "\n";
    if (!pass.once.empty()) out_ << "       " << pass.once << "\n";
    for (const Use& use : pass.inputs) input(use);
    for (const std::string& port : pass.unconnected) out_ << "       in  " << port << ": not connected\n";
    for (const Use& use : pass.outputs) written("out ", use);
    for (const Use& use : pass.scratch) written("tmp ", use);
    observations(step.observations);
  }

  void input(const Use& use) {
    out_ << "       in  " << use.port << (use.part.empty() ? "" : ".") << use.part << " = " << name(use.value);
    if (use.last_age > 0) out_ << "@" << use.first_age;
    if (use.last_age > use.first_age) out_ << ".." << use.last_age;
    out_ << "\n";
  }

  void written(const char* kind, const Use& use) {
    const Value& value = graph_.values[use.value];
    out_ << "       " << kind << use.port << (use.part.empty() ? "" : ".") << use.part << ": " << to_string(value.desc);
    if (ring_layers(value) > 1) out_ << ", ring of " << ring_layers(value);
    if (value.persistent) out_ << ", kept from frame to frame";
    out_ << ", " << bytes_text(byte_size(value)) << "\n";
  }

  void remarks() {
    out_ << "\noutputs\n";
    for (const GraphOutput& output : graph_.outputs) {
      out_ << "  " << output.name << " = " << name(output.value);
      if (output.age > 0) out_ << "@" << output.age;
      out_ << "\n";
    }
    if (!graph_.culled.empty()) out_ << "\nculled\n";
    for (const PassRemark& remark : graph_.culled) out_ << "  " << remark.pass << ": " << remark.reason << "\n";
    if (!graph_.bypassed.empty()) out_ << "\nbypassed\n";
    for (const PassRemark& remark : graph_.bypassed) out_ << "  " << remark.pass << ": " << remark.reason << "\n";
    if (!graph_.notes.empty()) out_ << "\nnotes\n";
    for (const std::string& note : graph_.notes) out_ << "  " << note << "\n";
  }

  const Plan& plan_;
  const Graph& graph_;
  std::ostringstream out_;
  std::size_t steps_ = 0;
};

}  // namespace

std::string print_plan(const Plan& plan) {
  return Printer(plan).run();
}

}  // namespace lightloom
