#include "framework/cli/bench_report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include "framework/cli/text_layout.hpp"

namespace lightloom::cli {
namespace {

using Row = std::vector<std::string>;

std::string number(double value, const char* format = "%.3g") {
  std::array<char, 48> buffer{};
  std::snprintf(buffer.data(), buffer.size(), value >= 1000 ? "%.0f" : format, value);
  return buffer.data();
}

std::string mebibytes(uint64_t bytes) {
  return number(static_cast<double>(bytes) / (1 << 20));
}

std::string ratio_text(const study::RatioEstimate& ratio) {
  std::string text = number(ratio.median);
  if (ratio.low < ratio.high) text += " (" + number(ratio.low) + " to " + number(ratio.high) + ")";
  const bool holds_one = ratio.low <= 1 && ratio.high >= 1;
  if (!ratio.within_noise) return text;
  return text + (holds_one ? ", within the noise" : ", too few frames to tell");
}

class Report {
 public:
  explicit Report(const study::BenchRecord& record) : record_(record), two_(record.runs.size() > 1) {
    if (two_) comparison_ = study::compare_runs(record.runs[0], record.runs[1]);
  }

  std::string write() {
    heading();
    out_ << align_columns(frames()) << "\nonce [ms]\n"
         << align_columns(once()) << "\nmemory [MiB]\n"
         << align_columns(memory());
    rays();
    if (record_.rates) out_ << "\nwhat the device does at best\n" << align_columns(rates());
    for (size_t i = 0; i < record_.floors.size(); ++i)
      out_ << "\nnear the limit" << (two_ ? ", " + std::to_string(i + 1) : "") << " [ms]\n"
           << align_columns(floors(record_.floors[i]));
    return out_.str();
  }

 private:
  void heading() {
    const study::BenchSettings& settings = record_.settings;
    out_ << record_.device.name << ", " << record_.device.driver_info << "; " << settings.frames << " frames after "
         << settings.warm_up << " to warm up\n";
    for (size_t i = 0; i < record_.runs.size(); ++i) {
      const Graph& graph = record_.plans[i].graph;
      out_ << (two_ ? std::to_string(i + 1) + ": " : "") << record_.runs[i].name << ", view " << to_string(graph.view)
           << ", trace " << to_string(graph.trace) << '\n';
    }
    out_ << "\nevery frame [ms]\n";
  }

  void add_timing(Row& row, const std::vector<double>* samples) const {
    if (samples == nullptr || samples->empty()) {
      row.insert(row.end(), {"-", "-"});
      return;
    }
    const study::Timing timing = study::timing_of(*samples);
    row.insert(row.end(), {number(timing.median), number(timing.p95)});
  }

  std::vector<Row> frames() const {
    std::vector<Row> rows = {two_ ? Row{"", "1: median", "p95", "2: median", "p95", "1 / 2 (95 %)"}
                                  : Row{"", "median", "p95"}};
    Row whole = {"whole frame"};
    for (const study::BenchFigures& run : record_.runs) add_timing(whole, &run.frame_ms);
    if (two_) whole.push_back(ratio_text(comparison_.frame));
    rows.push_back(whole);
    Row sum = {"passes alone, together"};
    for (const study::BenchFigures& run : record_.runs) {
      const std::vector<double> sums = study::sums_of_passes(run);
      add_timing(sum, &sums);
    }
    if (two_) sum.emplace_back();
    rows.push_back(sum);
    for (const std::string& pass : all_passes()) rows.push_back(pass_row(pass));
    return rows;
  }

  std::vector<std::string> all_passes() const {
    std::vector<std::string> passes;
    for (const study::BenchFigures& run : record_.runs)
      for (const std::string& pass : run.passes)
        if (std::find(passes.begin(), passes.end(), pass) == passes.end()) passes.push_back(pass);
    return passes;
  }

  Row pass_row(const std::string& pass) const {
    Row row = {"  " + pass};
    for (const study::BenchFigures& run : record_.runs) {
      const auto found = std::find(run.passes.begin(), run.passes.end(), pass);
      const bool timed = found != run.passes.end() && !run.pass_ms.empty();
      add_timing(row, timed ? &run.pass_ms[static_cast<size_t>(found - run.passes.begin())] : nullptr);
    }
    if (!two_) return row;
    const auto both = std::find_if(comparison_.passes.begin(), comparison_.passes.end(),
                                   [&](const auto& entry) { return entry.first == pass; });
    row.push_back(both == comparison_.passes.end() ? "" : ratio_text(both->second));
    return row;
  }

  std::vector<Row> once() const {
    std::vector<Row> rows = {{"  read the scene", number(record_.scene_ms)},
                             {"  open the device", number(record_.device_ms)}};
    const auto add = [&](const std::string& name, auto figure) {
      Row row = {name};
      for (const study::BenchFigures& run : record_.runs) row.push_back(number(figure(run)));
      rows.push_back(row);
    };
    add("  plan the graph", [](const study::BenchFigures& run) { return run.plan_ms; });
    add("  set up memory, upload the scene", [](const study::BenchFigures& run) { return run.setup_ms; });
    add("  first frame, with what follows", [](const study::BenchFigures& run) { return run.first_frame_ms; });
    add("    shaders read or compiled", [](const study::BenchFigures& run) { return run.shaders_ms; });
    add("    pipelines made", [](const study::BenchFigures& run) { return run.pipelines_ms; });
    std::vector<std::string> hoisted;
    for (const study::BenchFigures& run : record_.runs)
      for (const auto& [pass, milliseconds] : run.once)
        if (std::find(hoisted.begin(), hoisted.end(), pass) == hoisted.end()) hoisted.push_back(pass);
    for (const std::string& pass : hoisted) {
      Row row = {"    " + pass + ", hoisted"};
      for (const study::BenchFigures& run : record_.runs) {
        const auto found =
            std::find_if(run.once.begin(), run.once.end(), [&](const auto& entry) { return entry.first == pass; });
        row.push_back(found == run.once.end() || found->second < 0 ? "-" : number(found->second));
      }
      rows.push_back(row);
    }
    return rows;
  }

  std::vector<Row> memory() const {
    std::vector<Row> rows = {{""}};
    for (size_t i = 0; i < record_.runs.size(); ++i) rows[0].push_back(two_ ? std::to_string(i + 1) : "now");
    rows[0].push_back("at its peak");
    const auto add = [&](const std::string& name, auto figure, uint64_t peak) {
      Row row = {name};
      for (const study::BenchFigures& run : record_.runs) row.push_back(mebibytes(figure(run)));
      row.push_back(mebibytes(peak));
      rows.push_back(row);
    };
    constexpr std::array kNames = {"    images", "    buffers", "    shared by values", "    staging and read-back"};
    const study::BenchMemory& memory = record_.memory;
    add(
        "  device", [](const study::BenchFigures& run) { return run.memory.total(); }, memory.device_peak_total);
    for (size_t i = 0; i < kNames.size(); ++i)
      add(
          kNames[i], [i](const study::BenchFigures& run) { return run.memory.of[i]; }, memory.device_peak.of[i]);
    Row process = {"  process", mebibytes(memory.host)};
    if (two_) process.emplace_back();
    process.push_back(mebibytes(memory.host_peak));
    rows.push_back(process);
    return rows;
  }

  void rays() {
    for (const study::BenchFigures& run : record_.runs) {
      if (!run.rays) continue;
      out_ << '\n'
           << run.name << ": " << number(run.rays->rays) << " rays a frame, " << number(run.rays->steps) << " steps";
      if (run.rays->rays > 0) out_ << " (" << number(run.rays->steps / run.rays->rays) << " a ray)";
      if (const double rate = study::per_second(run.rays->rays, run); rate > 0)
        out_ << "; " << number(rate * 1e-6) << " million rays and "
             << number(study::per_second(run.rays->steps, run) * 1e-6) << " million steps a second of its passes";
      out_ << '\n';
    }
  }

  std::vector<Row> rates() const {
    const study::DeviceRates& rates = *record_.rates;
    const auto giga = [](double rate) { return number(rate * 1e-9); };
    std::vector<Row> rows = {{"  copies [GB/s, read and written]", "in cache " + giga(rates.copy.in_cache),
                              "in memory " + giga(rates.copy.in_memory), "by transfer " + giga(rates.copy.transfer)},
                             {"  float operations [10^9/s]", giga(rates.flops)},
                             {"  invocations [10^9/s]", giga(rates.invocations)},
                             {"  a dispatch [ms]", number(rates.dispatch * 1e3)}};
    for (const auto& [format, rate] : rates.loads)
      rows.push_back({"  " + std::string(format_info(format).name) + " texels [10^9/s]", "read " + giga(rate),
                      "written " + giga(rates.stores.at(format))});
    for (const study::FetchRates& rate : rates.fetches)
      rows.push_back({"  fetches in turn, r8_unorm " + std::to_string(rate.side) + " cubed [10^9/s]",
                      "marching " + giga(rate.marching), "scattered " + giga(rate.scattered)});
    return rows;
  }

  static std::vector<Row> floors(const std::vector<study::PassFloor>& floors) {
    std::vector<Row> rows = {{"", "MB", "by bytes", "by texels", "by steps", "floor", "measured", "measured / floor"}};
    double floor_sum = 0, measured_sum = 0;
    for (const study::PassFloor& floor : floors) {
      floor_sum += floor.floor_ms();
      measured_sum += floor.measured_ms;
      rows.push_back({"  " + floor.pass, number(static_cast<double>(floor.bytes_read + floor.bytes_written) * 1e-6),
                      number(floor.bytes_ms), number(floor.texels_ms),
                      floor.steps_ms > 0 ? number(floor.steps_ms) : "-", number(floor.floor_ms()),
                      number(floor.measured_ms), number(floor.ratio())});
    }
    rows.push_back({"  all", "", "", "", "", number(floor_sum), number(measured_sum),
                    floor_sum > 0 ? number(measured_sum / floor_sum) : "-"});
    return rows;
  }

  const study::BenchRecord& record_;
  bool two_ = false;
  study::BenchComparison comparison_;
  std::ostringstream out_;
};

}  // namespace

std::string bench_report(const study::BenchRecord& record) {
  return Report(record).write();
}

}  // namespace lightloom::cli
