#include "tests/support/device_fixture.hpp"

#include <string>

namespace lightloom::test {

gpu::Device& shared_device() {
  static gpu::Device device({.name = "", .validate = true});
  return device;
}

void DeviceTest::SetUp() {
  device().clear_validation_messages();
}

void DeviceTest::TearDown() {
  std::string texts;
  for (const gpu::ValidationMessage& message : device().validation_messages()) texts += message.text + "\n";
  EXPECT_TRUE(texts.empty()) << "the validation layer reports:\n" << texts;
  device().clear_validation_messages();
}

}  // namespace lightloom::test
