#pragma once

#include <cstddef>
#include <functional>

namespace lightloom {

/// Cuts 0..count into `threads` runs of about equal length (0: one a core; never more than `count`) and calls
/// `body(begin, end)` for each, at the same time; returns when all have returned. What a call throws is thrown here,
/// the lowest run's if there are several. For results that are the same whatever the number of threads, a call must
/// write only what belongs to its own indices.
void parallel_runs(size_t count, unsigned threads, const std::function<void(size_t begin, size_t end)>& body);

}  // namespace lightloom
