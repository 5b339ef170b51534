#include "framework/base/background_jobs.hpp"

#include <algorithm>
#include <utility>

namespace lightloom {

BackgroundJobs::BackgroundJobs(size_t room) : room_(std::max<size_t>(room, 1)), thread_([this] { work(); }) {}

BackgroundJobs::~BackgroundJobs() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
}

void BackgroundJobs::wait_for_room() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || jobs_.size() < room_; });
  throw_failure();
}

void BackgroundJobs::add(std::function<void()> job) {
  wait_for_room();
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_all();
}

void BackgroundJobs::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || jobs_.empty(); });
  throw_failure();
}

void BackgroundJobs::throw_failure() {
  if (failure_) std::rethrow_exception(failure_);
}

void BackgroundJobs::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    std::function<void()> job = jobs_.front();
    lock.unlock();
    std::exception_ptr failure;
    try {
      job();
    } catch (...) {
      failure = std::current_exception();
    }
    job = nullptr;
    lock.lock();
    if (failure) {
      failure_ = failure;
      jobs_.clear();
    } else {
      jobs_.pop_front();
    }
    changed_.notify_all();
  }
}

}  // namespace lightloom
