#include "tests/run/integer_graph.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace lightloom::run::toy {
namespace {

constexpr uint32_t kWidth = 5;
constexpr uint32_t kHeight = 3;
constexpr uint32_t kVolumeWidth = 4;
constexpr uint32_t kVolumeHeight = 3;
constexpr uint32_t kVolumeDepth = 2;

uint32_t mixed(uint32_t hash, uint32_t value) {
  hash ^= value + 0x9e3779b9U + (hash << 6U) + (hash >> 2U);
  hash *= 0x85ebca6bU;
  return hash ^ (hash >> 13U);
}

/// An image of what `texel` gives for each place.
template <class Texel>
IntegerGraph::Texels image(Texel texel) {
  IntegerGraph::Texels texels;
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x) texels.push_back(texel(x, y));
  return texels;
}

/// Of what `texel` gives for the number of each texel.
template <class Texel>
IntegerGraph::Texels each(size_t count, Texel texel) {
  IntegerGraph::Texels texels;
  for (size_t i = 0; i < count; ++i) texels.push_back(texel(i));
  return texels;
}

constexpr size_t kTexels = size_t{kWidth} * kHeight;
constexpr size_t kVoxels = size_t{kVolumeWidth} * kVolumeHeight * kVolumeDepth;

bool is_volume(std::string_view type) {
  return type == "grow" || type == "carve";
}

bool has_bypass(std::string_view type) {
  for (const std::string_view name : {"mix", "trail", "echo", "stamp", "paint", "carve", "split"})
    if (type == name) return true;
  return false;
}

}  // namespace

IntegerGraph::IntegerGraph(uint32_t seed, uint32_t passes) : random_(seed) {
  constexpr std::array kTypes = {"noise", "still",    "mix",   "mix",   "trail", "trail", "echo",
                                 "echo",  "frontier", "stamp", "blank", "paint", "splat", "grow",
                                 "carve", "fold",     "fold",  "split", "join",  "host"};
  types_ = {"noise", "grow", "split"};
  while (types_.size() < passes) types_.emplace_back(kTypes[draw() % kTypes.size()]);
  for (const std::string& type : types_) add(type);
  outputs_["last"] = {images_.back(), 0, 0};
  outputs_["any"] = any(images_, 3);
  outputs_["other"] = any(images_, 5);
  outputs_["volume"] = any(volumes_, 3);
}

IntegerGraph::Edge IntegerGraph::any(const std::vector<std::string>& values, uint32_t aged_one_in) {
  // Mostly of the last few, so that little is left that nobody reads.
  const size_t recent = one_in(4) ? values.size() : std::min<size_t>(values.size(), 3);
  Edge edge{values[values.size() - 1 - draw() % recent], 0, 0};
  if (one_in(aged_one_in)) edge.first = edge.last = 1 + draw() % 2;
  return edge;
}

/// A value of an earlier frame, maybe of a pass that comes later.
IntegerGraph::Edge IntegerGraph::earlier(bool volume) {
  while (true) {
    const size_t i = draw() % types_.size();
    if (is_volume(types_[i]) != volume || types_[i] == "split") continue;
    const uint32_t first = 1 + draw() % 2;
    return {"p" + std::to_string(i) + (volume ? ".v" : ".a"), first, first + draw() % 3};
  }
}

void IntegerGraph::add(const std::string& type) {
  Node node{.name = "p" + std::to_string(nodes_.size()), .type = type, .salt = draw() % 1000000U};
  const bool source = type == "noise" || type == "still" || type == "frontier" || type == "blank";
  if (type == "carve" || type == "fold") {
    node.in["v"] = any(volumes_, 5);
  } else if (type == "join") {
    node.in["p"] = any(pairs_, 4);
  } else if (!source) {
    node.in["x"] = any(images_, 5);
  }
  if (type == "mix" && one_in(2)) node.in["y"] = any(images_, 4);
  if (type == "trail") node.in["past"] = earlier(false);
  if (type == "echo") node.in["last"] = {node.name + ".a", 1, 1};
  if (type == "carve") {
    node.in["old"] = earlier(true);
    node.in["old"].last = node.in["old"].first;
  }
  node.enabled = !has_bypass(type) || nodes_.size() < 3 || !one_in(4);
  if (is_volume(type)) {
    volumes_.push_back(node.name + ".v");
  } else if (type == "split") {
    pairs_.push_back(node.name + ".p");
    images_.push_back(node.name + ".p.u");
  } else {
    images_.push_back(node.name + ".a");
  }
  nodes_.push_back(std::move(node));
}

std::string IntegerGraph::text() const {
  std::ostringstream out;
  const auto write = [&](const std::string& name, const Edge& edge) {
    out << "\"" << name << "\": \"" << edge.value;
    if (edge.last > 0) out << "@" << edge.first;
    if (name == "past") out << ".." << edge.last;
    out << "\"";
  };
  out << R"({"lightloom": 1, "name": "integers", "view": {"width": 5, "height": 3}, "passes": {)";
  for (const Node& node : nodes_) {
    out << (&node == &nodes_.front() ? "\n\"" : ",\n\"") << node.name << "\": {\"type\": \"integer_" << node.type
        << "\", \"params\": {\"salt\": " << node.salt << "}" << (node.enabled ? "" : ", \"enabled\": false");
    for (auto edge = node.in.begin(); edge != node.in.end(); ++edge) {
      out << (edge == node.in.begin() ? ", \"in\": {" : ", ");
      write(edge->first, edge->second);
    }
    out << (node.in.empty() ? "}" : "}}");
  }
  out << "},\n\"outputs\": {";
  for (auto output = outputs_.begin(); output != outputs_.end(); ++output) {
    if (output != outputs_.begin()) out << ", ";
    write(output->first, output->second);
  }
  out << "}}\n";
  return out.str();
}

const IntegerGraph::Node& IntegerGraph::node_of(const std::string& value) const {
  return nodes_.at(std::stoul(value.substr(1, value.find('.') - 1)));
}

IntegerGraph::Texels IntegerGraph::fetch(const std::string& value, uint32_t age, uint32_t frame) const {
  const Node& node = node_of(value);
  if (!node.enabled) {
    if (node.type == "stamp") return Texels(kTexels, 5);
    if (node.type == "split") return Texels(kTexels, 3);
    const Edge& source = node.in.at(node.type == "carve" ? "v" : "x");
    return fetch(source.value, source.first + age, frame);
  }
  if (age > frame) return Texels(is_volume(node.type) ? kVoxels : kTexels, 0);
  return frames_.at(frame - age).at(value);
}

IntegerGraph::Texels IntegerGraph::fetch(const Node& node, const std::string& port, uint32_t frame) const {
  const Edge& edge = node.in.at(port);
  return fetch(edge.value, edge.first, frame);
}

IntegerGraph::Texels IntegerGraph::output(const std::string& name, uint32_t frame) const {
  return fetch(outputs_.at(name).value, outputs_.at(name).first, frame);
}

const IntegerGraph::Texels& IntegerGraph::value(const std::string& name, uint32_t frame) const {
  return frames_.at(frame).at(name);
}

void IntegerGraph::play(uint32_t frames) {
  for (uint32_t frame = 0; frame < frames; ++frame) {
    frames_.emplace_back();
    for (const Node& node : nodes_) {
      if (!node.enabled) continue;
      Frame results;
      if (is_volume(node.type) || node.type == "fold")
        run_volume(node, frame, results);
      else
        run(node, frame, results);
      for (auto& [port, texels] : results) frames_[frame][node.name + "." + port] = std::move(texels);
    }
  }
}

void IntegerGraph::run(const Node& node, uint32_t frame, Frame& results) const {
  const uint32_t salt = node.salt;
  const auto place = [&](uint32_t x, uint32_t y) { return mixed(mixed(salt, x), y); };
  const Texels x = node.in.contains("x") ? fetch(node, "x", frame) : Texels();
  const auto hashed_x = [&](size_t i) { return mixed(salt, x[i]); };
  if (node.type == "noise") {
    results["a"] = image([&](uint32_t column, uint32_t row) { return mixed(place(column, row), frame); });
  } else if (node.type == "still") {
    results["a"] = image(place);
  } else if (node.type == "blank") {
    results["a"] = Texels(kTexels, salt % 1000);
  } else if (node.type == "frontier") {
    results["memo"] =
        image([&](uint32_t column, uint32_t row) { return column + row <= frame ? place(column, row) : 0; });
    results["a"] = each(kTexels, [&](size_t i) { return mixed(salt + 1, results["memo"][i]); });
  } else if (node.type == "mix") {
    results["tmp"] = each(kTexels, hashed_x);
    const Texels y = node.in.contains("y") ? fetch(node, "y", frame) : Texels(kTexels, 77);
    results["a"] = image([&](uint32_t column, uint32_t row) {
      const uint32_t neighbour = results["tmp"][size_t{row} * kWidth + (column + 1) % kWidth];
      return mixed(mixed(salt + 1, neighbour), y[size_t{row} * kWidth + column]);
    });
  } else if (node.type == "trail") {
    Texels hash = each(kTexels, hashed_x);
    const Edge& past = node.in.at("past");
    for (uint32_t age = past.first; age <= past.last; ++age) {
      const Texels old = fetch(past.value, age, frame);
      for (size_t i = 0; i < kTexels; ++i) hash[i] = mixed(hash[i], old[i]);
    }
    results["a"] = hash;
  } else if (node.type == "echo") {
    const Texels last = fetch(node, "last", frame);
    results["a"] = each(kTexels, [&](size_t i) { return mixed(hashed_x(i), last[i]); });
  } else if (node.type == "stamp") {
    results["a"] = image([&](uint32_t column, uint32_t row) {
      return (column + row) % 2 == 1 ? 7 : hashed_x(size_t{row} * kWidth + column);
    });
  } else if (node.type == "splat") {
    results["hits"] = each(kTexels, hashed_x);
    results["a"] = each(kTexels, [&](size_t i) { return mixed(salt + 1, hashed_x(i)); });
  } else if (node.type == "split") {
    results["p.u"] = each(kTexels, hashed_x);
    results["p.v"] = each(kTexels, [&](size_t i) { return mixed(salt + 1, x[i]); });
  } else if (node.type == "join") {
    const Edge& pair = node.in.at("p");
    const Texels u = fetch(pair.value + ".u", pair.first, frame);
    const Texels v = fetch(pair.value + ".v", pair.first, frame);
    results["a"] = each(kTexels, [&](size_t i) { return mixed(mixed(salt, u[i]), v[i]); });
  } else {  // paint, host
    results["a"] = each(kTexels, hashed_x);
  }
}

void IntegerGraph::run_volume(const Node& node, uint32_t frame, Frame& results) const {
  constexpr size_t kSlice = size_t{kVolumeWidth} * kVolumeHeight;
  if (node.type == "grow") {
    const Texels x = fetch(node, "x", frame);
    results["v"] = each(kVoxels, [&](size_t i) {
      const size_t column = i % kVolumeWidth;
      const size_t row = i % kSlice / kVolumeWidth;
      return mixed(mixed(node.salt, x[row * kWidth + column]), static_cast<uint32_t>(i / kSlice));
    });
    return;
  }
  const Texels v = fetch(node, "v", frame);
  if (node.type == "carve") {
    const Texels old = fetch(node, "old", frame);
    results["v"] = each(kVoxels, [&](size_t i) { return mixed(mixed(node.salt, v[i]), old[i]); });
    return;
  }
  results["a"] = image([&](uint32_t column, uint32_t row) {
    uint32_t hash = node.salt;
    for (size_t z = 0; z < kVolumeDepth; ++z)
      hash = mixed(hash, v[z * kSlice + size_t{row % kVolumeHeight} * kVolumeWidth + column % kVolumeWidth]);
    return hash;
  });
}

}  // namespace lightloom::run::toy
