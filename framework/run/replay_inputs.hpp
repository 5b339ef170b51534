#pragma once

#include <string>
#include <vector>

#include "framework/graph/cut.hpp"
#include "framework/run/executor_state.hpp"
#include "framework/run/run_record.hpp"

namespace lightloom::run {

/// Which passes of a graph match the globs, one entry a pass. Throws Error(usage) for a glob that none matches, saying
/// so where the pass is there but was left out.
[[nodiscard]] std::vector<bool> choose_passes(const Graph& graph, const std::vector<std::string>& globs);

/// Where an executor begins that is to run `part` as it ran in frame number `frame` of the run. Layers of frames before
/// the run's first are left as they are, zeros. Throws Error(invalid_input) that lists all that was not dumped, or for
/// a dump of another size or format.
[[nodiscard]] FrameStart start_from_dumps(const RecordedRun& run, const Cut& part, uint32_t frame);

}  // namespace lightloom::run
