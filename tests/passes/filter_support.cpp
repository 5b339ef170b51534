#include "tests/passes/filter_support.hpp"

#include <cmath>
#include <sstream>

namespace lightloom::test {

Images run_filters(const scene::Scene& scene, const FilterRun& run) {
  std::ostringstream passes;
  passes << R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")"
         << run.pattern << R"(", "scale": )" << run.scale << " } }";
  std::string variance;
  if (!run.variance_pattern.empty()) {
    passes << R"(, "variance": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")"
           << run.variance_pattern << R"(", "scale": )" << run.variance_scale << " } }";
    variance = R"(, "variance": "variance.radiance")";
  }
  if (run.packed) {
    passes
        << R"(, "guide": { "type": "filter_guide", "in": { "surface": "gather.surface", "radiance": "pattern.radiance")"
        << variance << " } }";
    variance = R"(, "guide": "guide.guide")";
  }
  std::string source = "pattern";
  for (size_t i = 0; i < run.stages.size(); ++i) {
    const std::string name = "filter" + std::to_string(i);
    passes << ", \"" << name << R"(": { "type": ")" << run.stages[i].type << R"(", "in": { "radiance": ")" << source
           << R"(.radiance", "surface": "gather.surface")" << variance << R"( }, "params": { )" << run.stages[i].params
           << " } }";
    source = name;
  }
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  options.capture = {"gather.surface.position", "gather.surface.normal"};
  const std::string outputs = "\"radiance\": \"" + source + R"(.radiance", "pattern": "pattern.radiance")";
  return run_graph(graph_text(run.size, run.size, run.size, run.size, passes.str(), outputs), scene, options).front();
}

std::string fixed_reach(const scene::Scene& scene, double metres) {
  std::ostringstream text;
  text.precision(17);
  text << R"("distance_fraction": 0, "floor_fraction": )"
       << metres / glm::length(glm::dvec3(scene.bounds.max) - glm::dvec3(scene.bounds.min));
  return text.str();
}

PinholeOracle::PinholeOracle(const glm::dvec3& eye_, const glm::dvec3& target, double vertical_fov, double size_)
    : eye(eye_), half_height(std::tan(vertical_fov / 2)), size(size_) {
  forward = glm::normalize(target - eye);
  right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
  up = glm::cross(right, forward);
}

glm::dvec2 PinholeOracle::project(const glm::dvec3& point) const {
  const glm::dvec3 seen = point - eye;
  const double scale = size / 2 / (glm::dot(seen, forward) * half_height);
  return {size / 2 + glm::dot(seen, right) * scale, size / 2 - glm::dot(seen, up) * scale};
}

}  // namespace lightloom::test
