#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace lightloom {

/// Runs jobs one after another, in the order in which they were added, on a thread of its own. For one thread that
/// adds them.
class BackgroundJobs {
 public:
  /// At most `room` jobs, at least one, are there at any time, the running one included.
  explicit BackgroundJobs(size_t room);
  BackgroundJobs(const BackgroundJobs&) = delete;
  BackgroundJobs& operator=(const BackgroundJobs&) = delete;
  /// Runs what was added to its end; what a job throws then is lost, so call `finish` before.
  ~BackgroundJobs();

  /// Waits until another job may be added. Throws what a job threw; those after it are dropped.
  void wait_for_room();
  /// Waits for room, and adds. Throws as above.
  void add(std::function<void()> job);
  /// Waits until all jobs are done. Throws as above.
  void finish();

 private:
  void work();
  void throw_failure();

  const size_t room_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;  ///< the first one is running
  std::exception_ptr failure_;
  bool ending_ = false;
  std::jthread thread_;  ///< last: it uses all of the others
};

}  // namespace lightloom
