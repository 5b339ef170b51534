#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "framework/gpu/reflection.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom::run {

/// Tells where a shader declares a name: "file:line".
using PlaceOf = std::function<std::string(std::string_view name)>;

/// What a pass type declares of its ports and params against what a shader that it runs does with them. Throws
/// Error(run_failed), naming the port or param with its declaration and the line of the shader, where
/// - an input is bound as an image that may be written, or an input that is sampled as a storage image, or one that
///   is loaded as a texture;
/// - a written port is not writable, or read where its access only writes;
/// - dimension, history range, numeric class, or the format that the shader names differ;
/// - a fragment output has no port that is a colour attachment, or another numeric class;
/// - a constant named like a param has a type that cannot hold it.
void require_declared_access(const PassType& type, const gpu::Reflection& shader, const PlaceOf& place);

/// Holds what passes record against what their types declare.
class AccessWatch {
 public:
  /// The pass runs a shader, which is checked once for each type. `shader` stays where it is.
  void runs(const GraphPass& pass, const gpu::Reflection& shader, const PlaceOf& place);
  void clears(const GraphPass& pass, std::string_view port);
  /// The pass has recorded a frame. Throws Error(run_failed) if it was its first and did not write an output that is
  /// read: no command that could was among what it recorded.
  void ends(const Graph& graph, const GraphPass& pass);
  /// Names of all that the shaders bound which passes ran in their first frame, by pass; none for those that ran no
  /// shader.
  [[nodiscard]] const std::map<std::string, std::set<std::string>>& bound() const { return bound_; }

 private:
  std::set<std::pair<const PassType*, const gpu::Reflection*>> checked_;
  std::set<const GraphPass*> ended_;
  std::map<std::string, std::set<std::string>> bound_;
  std::set<std::string> written_;  ///< shader names, by the pass that records its first frame
};

}  // namespace lightloom::run
