#include "framework/base/parallel.hpp"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

namespace lightloom {

void parallel_runs(size_t count, unsigned threads, const std::function<void(size_t, size_t)>& body) {
  const size_t wanted = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
  const size_t runs = std::min(wanted, count);
  if (runs <= 1) {
    if (count > 0) body(0, count);
    return;
  }
  std::vector<std::exception_ptr> failures(runs);
  const auto work = [&](size_t run) {
    try {
      body(count * run / runs, count * (run + 1) / runs);
    } catch (...) {
      failures[run] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    workers.reserve(runs - 1);
    for (size_t run = 1; run < runs; ++run) workers.emplace_back(work, run);
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace lightloom
