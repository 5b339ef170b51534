#include "framework/base/background_jobs.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <vector>

namespace lightloom {
namespace {

TEST(BackgroundJobs, RunInOrderOnAnotherThread) {
  std::vector<int> order;
  std::thread::id thread;
  BackgroundJobs jobs(3);
  for (int i = 0; i < 20; ++i)
    jobs.add([&, i] {
      order.push_back(i);
      thread = std::this_thread::get_id();
    });
  jobs.finish();
  ASSERT_EQ(order.size(), 20U);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(order[static_cast<size_t>(i)], i);
  EXPECT_NE(thread, std::this_thread::get_id());
}

TEST(BackgroundJobs, NoMoreThanThereIsRoomFor) {
  std::promise<void> gate;
  std::atomic<bool> third_added{false};
  std::atomic<int> done{0};
  BackgroundJobs jobs(2);
  jobs.add([&] {
    gate.get_future().wait();
    ++done;
  });
  jobs.add([&] { ++done; });
  std::thread opener([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    EXPECT_FALSE(third_added) << "two jobs were there already";
    gate.set_value();
  });
  jobs.add([&] { ++done; });
  third_added = true;
  EXPECT_GE(done, 1);
  opener.join();
  jobs.finish();
  EXPECT_EQ(done, 3);
}

TEST(BackgroundJobs, AFailureIsThrownWhereJobsAreAddedAndDropsTheRest) {
  std::atomic<int> done{0};
  std::promise<void> gate;
  BackgroundJobs jobs(8);
  jobs.add([&] {
    gate.get_future().wait();
    ++done;
  });
  jobs.add([] { throw std::runtime_error("disk full"); });
  jobs.add([&] { ++done; });
  gate.set_value();  // not before: to add behind a failure throws
  EXPECT_THROW(jobs.finish(), std::runtime_error);
  EXPECT_THROW(jobs.wait_for_room(), std::runtime_error);
  EXPECT_THROW(jobs.add([&] { ++done; }), std::runtime_error);
  EXPECT_EQ(done, 1);
}

TEST(BackgroundJobs, WhoWaitsForRoomHearsOfAFailure) {
  std::promise<void> gate;
  BackgroundJobs jobs(1);
  jobs.add([&] {
    gate.get_future().wait();
    throw std::runtime_error("disk full");
  });
  std::thread opener([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    gate.set_value();
  });
  EXPECT_THROW(jobs.wait_for_room(), std::runtime_error);
  opener.join();
}

TEST(BackgroundJobs, WhatWasAddedIsDoneWhenTheyEnd) {
  std::atomic<int> done{0};
  {
    BackgroundJobs jobs(5);
    for (int i = 0; i < 5; ++i)
      jobs.add([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ++done;
      });
  }
  EXPECT_EQ(done, 5);
}

}  // namespace
}  // namespace lightloom
