#pragma once

#include <cstdint>
#include <functional>

namespace lightloom::reference {

/// Runs task(0) … task(count - 1) on `threads` threads (0: all cores), each as soon as one is free; rethrows what a
/// task threw.
void run_tasks(uint32_t count, uint32_t threads, const std::function<void(uint32_t)>& task);

}  // namespace lightloom::reference
