#pragma once

#include <functional>

#include "framework/cli/program.hpp"
#include "framework/run/render.hpp"

namespace lightloom::cli {

/// Renders, and renders again into the same folder whenever a file changes that the pictures were made of, from the
/// first frame on, also in the midst of a render: the pictures are those of a fresh run. What is wrong with a file is
/// said; what was rendered before then stays, and so does the watch, until the process is ended by a signal. Messages
/// go to context.err. Throws Error(no_device) alone.
[[noreturn]] void watch(const run::RenderRequest& request, const CommandContext& context,
                        const std::function<void(const run::RenderSummary&)>& report);

}  // namespace lightloom::cli
