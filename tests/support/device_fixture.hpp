#pragma once

#include <gtest/gtest.h>

#include "framework/gpu/device.hpp"

namespace lightloom::test {

/// The device that all tests of a process share, opened at its first use with validation on. Tests that need it fail
/// where there is none.
[[nodiscard]] gpu::Device& shared_device();

/// Base of tests that use the shared device: after each test no validation message may have come.
class DeviceTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  [[nodiscard]] static gpu::Device& device() { return shared_device(); }
};

}  // namespace lightloom::test
