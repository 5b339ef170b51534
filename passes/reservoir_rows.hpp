#pragma once

#include <string>
#include <vector>

#include "framework/graph/param.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/graph/port.hpp"

// What passes that choose light samples for voxel_path_trace have in common.
namespace lightloom::passes {

/// `surface`, and what emissive faces are drawn and weighed by: `voxels`, `faces`, `power`.
[[nodiscard]] std::vector<Port> reservoir_inputs();

/// The output `reservoir`, as large as `surface`; a pass that is off leaves reservoirs that know nothing.
[[nodiscard]] Port reservoir_output();

/// An input `name` that holds such reservoirs.
[[nodiscard]] Port reservoir_input(const std::string& name, const std::string& doc);

/// `own`, and the params of voxel_path_trace by which it weighs a light sample.
[[nodiscard]] std::vector<Param> with_share_params(const std::vector<Param>& own);

/// A thread for each reservoir.
void dispatch_reservoirs(PassContext& context, const std::string& shader);

}  // namespace lightloom::passes
