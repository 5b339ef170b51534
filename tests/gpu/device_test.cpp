#include "framework/gpu/device.hpp"

#include <cstdlib>

#include "framework/gpu/device_selection.hpp"
#include "framework/gpu/result.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

using test::error_of;
using ::testing::HasSubstr;

DeviceSummary summary(std::string name, DeviceType type, std::string missing = {}) {
  DeviceSummary result;
  result.info.name = std::move(name);
  result.info.type = type;
  result.usable = missing.empty();
  result.missing = std::move(missing);
  return result;
}

const std::vector<DeviceSummary>& example_devices() {
  static const std::vector<DeviceSummary> devices{
      summary("llvmpipe (LLVM 15)", DeviceType::cpu),
      summary("Iris Xe", DeviceType::integrated_gpu),
      summary("Old Card", DeviceType::discrete_gpu, "Vulkan 1.3 (it has 1.1.0)"),
      summary("Radeon RX", DeviceType::discrete_gpu),
      summary("Virtio", DeviceType::virtual_gpu),
  };
  return devices;
}

/// Sets an environment variable for one test.
class ScopedEnvironment {
 public:
  ScopedEnvironment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    had_ = std::getenv(name) != nullptr;
    setenv(name, value, 1);
  }
  ~ScopedEnvironment() {
    if (had_) {
      setenv(name_, old_.c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }
  ScopedEnvironment(const ScopedEnvironment&) = delete;
  ScopedEnvironment& operator=(const ScopedEnvironment&) = delete;

 private:
  const char* name_;
  bool had_ = false;
  std::string old_;
};

TEST(DeviceChoice, PrefersUsableDiscreteThenIntegratedThenVirtualThenCpu) {
  std::vector<DeviceSummary> devices = example_devices();
  for (const char* expected : {"Radeon RX", "Iris Xe", "Virtio", "llvmpipe (LLVM 15)"}) {
    const size_t chosen = choose_device(devices, "");
    EXPECT_EQ(devices[chosen].info.name, expected);
    devices.erase(devices.begin() + static_cast<std::ptrdiff_t>(chosen));
  }
}

TEST(DeviceChoice, TakesPartOfNameInAnyCaseOrIndex) {
  EXPECT_EQ(choose_device(example_devices(), "radeon"), 3u);
  EXPECT_EQ(choose_device(example_devices(), "LLVMPIPE"), 0u);
  EXPECT_EQ(choose_device(example_devices(), "1"), 1u);
}

TEST(DeviceChoice, UnknownNameListsWhatIsThere) {
  const Error error = error_of([] { static_cast<void>(choose_device(example_devices(), "GeForce")); });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  EXPECT_THAT(error.what(), HasSubstr("no device fits 'GeForce'"));
  EXPECT_THAT(error.what(), HasSubstr("[1] Iris Xe"));
  EXPECT_THAT(error.what(), HasSubstr("[2] Old Card (not usable, lacks Vulkan 1.3 (it has 1.1.0))"));
}

TEST(DeviceChoice, IndexOutOfRangeAndUnusableNameAreErrors) {
  EXPECT_THAT(error_of([] { static_cast<void>(choose_device(example_devices(), "9")); }).what(),
              HasSubstr("no device fits '9'"));
  const Error error = error_of([] { static_cast<void>(choose_device(example_devices(), "old")); });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  EXPECT_STREQ(error.what(), "device 'Old Card' cannot be used, it lacks Vulkan 1.3 (it has 1.1.0)");
}

TEST(DeviceChoice, NoDeviceNamesThePackage) {
  const Error error = error_of([] { static_cast<void>(choose_device({}, "")); });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  EXPECT_THAT(error.hint(), HasSubstr("mesa-vulkan-drivers"));
  const std::vector<DeviceSummary> unusable{example_devices()[2]};
  EXPECT_THAT(error_of([&] { static_cast<void>(choose_device(unusable, "")); }).what(),
              HasSubstr("no Vulkan device can be used"));
}

TEST(Device, ListNamesEveryDeviceWithItsDriver) {
  const std::vector<DeviceSummary> devices = list_devices();
  ASSERT_FALSE(devices.empty());
  for (const DeviceSummary& device : devices) {
    EXPECT_FALSE(device.info.name.empty());
    EXPECT_EQ(device.usable, device.missing.empty());
    if (device.usable) {
      EXPECT_FALSE(device.info.driver.empty());
      EXPECT_GE(device.info.api_version, VK_API_VERSION_1_3);
    }
  }
}

TEST(Device, EnvironmentChoosesWhereNoNameIsGiven) {
  const ScopedEnvironment environment("LIGHTLOOM_DEVICE", "no such device");
  const Error error = error_of([] { const Device device; });
  EXPECT_EQ(error.code(), ExitCode::no_device);
  EXPECT_THAT(error.what(), HasSubstr("no device fits 'no such device'"));
  EXPECT_EQ(Device({.name = "0", .validate = false}).info().name, list_devices().front().info.name);
}

using DeviceInfoTest = test::DeviceTest;

TEST_F(DeviceInfoTest, TellsVersionAndUuid) {
  const DeviceInfo& info = device().info();
  EXPECT_THAT(info.api_version_text(), ::testing::StartsWith("1."));
  EXPECT_EQ(info.uuid_text().size(), 32u);
  EXPECT_GE(info.limits.maxColorAttachments, 8u);
  EXPECT_GE(info.limits.maxStorageBufferRange, 128u << 20);
  EXPECT_GT(info.max_allocation_bytes, 0u);
}

TEST_F(DeviceInfoTest, RunsCommandsAgainAndAgain) {
  int recorded = 0;
  for (int i = 0; i < 3; ++i) device().run_commands([&](VkCommandBuffer) { ++recorded; });
  EXPECT_EQ(recorded, 3);
}

TEST_F(DeviceInfoTest, IsUsableAfterARecordingThatFailed) {
  EXPECT_THROW(device().run_commands([](VkCommandBuffer) { throw Error(ExitCode::run_failed, "stop"); }), Error);
  EXPECT_NO_THROW(device().run_commands([](VkCommandBuffer) {}));
}

TEST(Result, CheckNamesCallAndResult) {
  EXPECT_NO_THROW(check(VK_SUCCESS, "vkSomething"));
  const Error error = error_of([] { check(VK_ERROR_DEVICE_LOST, "vkQueueSubmit2"); });
  EXPECT_STREQ(error.what(), "vkQueueSubmit2 failed with VK_ERROR_DEVICE_LOST");
  EXPECT_FALSE(error.hint().empty());
  EXPECT_EQ(result_name(static_cast<VkResult>(-12345)), "VkResult -12345");
}

}  // namespace
}  // namespace lightloom::gpu
