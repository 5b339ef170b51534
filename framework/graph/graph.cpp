#include "framework/graph/graph.hpp"

namespace lightloom {

std::string value_name(const Value& value) {
  return value.pass + "." + value.port + (value.part.empty() ? "" : "." + value.part);
}

uint64_t byte_size(const Value& value) {
  return byte_size(value.desc) * ring_layers(value);
}

}  // namespace lightloom
