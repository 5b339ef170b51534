#include "framework/reference/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace lightloom::reference {

void run_tasks(uint32_t count, uint32_t threads, const std::function<void(uint32_t)>& task) {
  const uint32_t wanted = threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
  const uint32_t workers = std::min(wanted, std::max(1u, count));
  std::atomic<uint32_t> next{0};
  std::vector<std::exception_ptr> failures(workers);
  const auto work = [&](uint32_t worker) {
    try {
      for (uint32_t i = next++; i < count; i = next++) task(i);
    } catch (...) {
      failures[worker] = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (uint32_t worker = 1; worker < workers; ++worker) helpers.emplace_back(work, worker);
    work(0);
  }
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace lightloom::reference
