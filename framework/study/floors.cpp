#include "framework/study/floors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "framework/study/statistics.hpp"

namespace lightloom::study {
namespace {

std::array<std::pair<std::string_view, double>, 4> bounds(const PassFloor& floor) {
  return {{{"bytes", floor.bytes_ms},
           {"texels", floor.texels_ms},
           {"steps", floor.steps_ms},
           {"dispatch", floor.dispatch_ms}}};
}

std::pair<std::string_view, double> highest(const PassFloor& floor) {
  const auto all = bounds(floor);
  return *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
}

/// Texels of a format that was not measured do not count.
double texels_ms(const PassTraffic& traffic, const DeviceRates& rates) {
  double milliseconds = 0;
  const auto add = [&](uint64_t texels, const std::map<Format, double>& by_format, Format format) {
    const auto rate = by_format.find(format);
    if (rate != by_format.end() && rate->second > 0) milliseconds += static_cast<double>(texels) / rate->second * 1e3;
  };
  for (const TexelTraffic& entry : traffic.texels) {
    add(entry.read, rates.loads, entry.format);
    add(entry.written, rates.stores, entry.format);
  }
  return milliseconds;
}

/// The rate for the distances that the pass marches through; 0 where there are none.
double marching_rate(const Graph& graph, const GraphPass& pass, const DeviceRates& rates) {
  for (const Use& use : pass.inputs) {
    const ImageDesc& desc = graph.values[use.value].desc;
    if (desc.dimension != Dimension::d3 || desc.format != Format::r8_unorm || rates.fetches.empty()) continue;
    const double side = std::cbrt(static_cast<double>(byte_size(desc)));
    const auto distance = [&](const FetchRates& rate) { return std::abs(std::log(side / rate.side)); };
    return std::min_element(rates.fetches.begin(), rates.fetches.end(),
                            [&](const auto& a, const auto& b) { return distance(a) < distance(b); })
        ->marching;
  }
  return 0;
}

double steps_of(const BenchFigures& figures, const std::string& pass) {
  if (!figures.rays) return 0;
  const auto found = std::find(figures.rays->passes.begin(), figures.rays->passes.end(), pass);
  if (found == figures.rays->passes.end()) return 0;
  return figures.rays->steps_by_pass.at(static_cast<size_t>(found - figures.rays->passes.begin()));
}

double measured_ms(const BenchFigures& figures, const std::string& pass) {
  const auto found = std::find(figures.passes.begin(), figures.passes.end(), pass);
  if (found == figures.passes.end() || figures.pass_ms.empty()) return 0;
  return percentile(figures.pass_ms[static_cast<size_t>(found - figures.passes.begin())], 0.5);
}

}  // namespace

double PassFloor::floor_ms() const {
  return highest(*this).second;
}

std::string_view PassFloor::bound() const {
  return highest(*this).first;
}

double PassFloor::ratio() const {
  return floor_ms() > 0 ? measured_ms / floor_ms() : 0;
}

std::set<Format> formats_of(const Plan& plan) {
  std::set<Format> formats;
  for (const PlanStep& step : plan.steps)
    for (const TexelTraffic& entry : traffic_of(plan.graph, plan.graph.passes[step.pass]).texels)
      formats.insert(entry.format);
  return formats;
}

std::vector<PassFloor> floors_of(const Plan& plan, const BenchFigures& figures, const DeviceRates& rates) {
  std::vector<PassFloor> floors;
  for (const PlanStep& step : plan.steps) {
    const GraphPass& pass = plan.graph.passes[step.pass];
    const auto bound = figures.bound_names.find(pass.name);
    const PassTraffic traffic =
        traffic_of(plan.graph, pass, bound == figures.bound_names.end() ? nullptr : &bound->second);
    PassFloor floor{.pass = pass.name, .bytes_read = traffic.bytes_read(), .bytes_written = traffic.bytes_written()};
    if (rates.copy.best() > 0)
      floor.bytes_ms = static_cast<double>(floor.bytes_read + floor.bytes_written) / rates.copy.best() * 1e3;
    if (!pass.type->host) {
      floor.texels_ms = texels_ms(traffic, rates);
      floor.dispatch_ms = rates.dispatch * 1e3;
      if (const double rate = marching_rate(plan.graph, pass, rates); rate > 0)
        floor.steps_ms = steps_of(figures, pass.name) / rate * 1e3;
    }
    floor.measured_ms = measured_ms(figures, pass.name);
    floors.push_back(std::move(floor));
  }
  return floors;
}

nlohmann::ordered_json floors_json(const std::vector<PassFloor>& floors) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const PassFloor& floor : floors) {
    json[floor.pass] = {{"bytes_read", floor.bytes_read},   {"bytes_written", floor.bytes_written},
                        {"bytes_ms", floor.bytes_ms},       {"texels_ms", floor.texels_ms},
                        {"steps_ms", floor.steps_ms},       {"dispatch_ms", floor.dispatch_ms},
                        {"floor_ms", floor.floor_ms()},     {"bound", floor.bound()},
                        {"measured_ms", floor.measured_ms}, {"ratio", floor.ratio()}};
  }
  return json;
}

}  // namespace lightloom::study
