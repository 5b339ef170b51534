// Each Vulkan function that can fail does so, at one call after the other, until a run of two frames succeeds.
#include <array>

#include "tests/faults/fault_fixture.hpp"

namespace lightloom::cli {
namespace {

struct FailingFunction {
  const char* function;
  const char* result;
  int exit = 1;
  bool onwards =
      false;  ///< every later call fails as well: the loader and layers call it too, and let one failure pass
};

void PrintTo(const FailingFunction& row, std::ostream* out) {
  *out << row.function << " " << row.result;
}

constexpr const char* kHost = "VK_ERROR_OUT_OF_HOST_MEMORY";
constexpr const char* kDevice = "VK_ERROR_OUT_OF_DEVICE_MEMORY";
constexpr const char* kLost = "VK_ERROR_DEVICE_LOST";

constexpr std::array kFunctions{
    FailingFunction{"vkCreateInstance", "VK_ERROR_INCOMPATIBLE_DRIVER", 4},
    FailingFunction{"vkEnumeratePhysicalDevices", "VK_ERROR_INITIALIZATION_FAILED", 4},
    FailingFunction{"vkEnumerateDeviceExtensionProperties", kHost, 4, true},
    FailingFunction{"vkCreateDevice", "VK_ERROR_INITIALIZATION_FAILED", 4},
    FailingFunction{"vkCreateCommandPool", kHost},
    FailingFunction{"vkAllocateCommandBuffers", kDevice},
    FailingFunction{"vkCreateFence", kHost},
    FailingFunction{"vkCreateQueryPool", kDevice},
    FailingFunction{"vkAllocateMemory", kDevice},
    FailingFunction{"vkAllocateMemory", kHost},
    FailingFunction{"vkAllocateMemory", "VK_ERROR_TOO_MANY_OBJECTS"},
    FailingFunction{"vkMapMemory", "VK_ERROR_MEMORY_MAP_FAILED"},
    FailingFunction{"vkCreateBuffer", kDevice},
    FailingFunction{"vkBindBufferMemory", kDevice},
    FailingFunction{"vkCreateImage", kDevice},
    FailingFunction{"vkBindImageMemory", kDevice},
    FailingFunction{"vkCreateImageView", kHost},
    FailingFunction{"vkCreateSampler", "VK_ERROR_TOO_MANY_OBJECTS"},
    FailingFunction{"vkCreateShaderModule", kHost},
    FailingFunction{"vkCreateDescriptorSetLayout", kHost},
    FailingFunction{"vkCreatePipelineLayout", kHost},
    FailingFunction{"vkCreateComputePipelines", kDevice},
    FailingFunction{"vkCreateGraphicsPipelines", "VK_ERROR_UNKNOWN"},
    FailingFunction{"vkCreateDescriptorPool", kHost},
    FailingFunction{"vkAllocateDescriptorSets", kDevice},
    FailingFunction{"vkResetCommandPool", kDevice},
    FailingFunction{"vkBeginCommandBuffer", kHost},
    FailingFunction{"vkEndCommandBuffer", kDevice},
    FailingFunction{"vkResetFences", kDevice},
    FailingFunction{"vkQueueSubmit2", kLost},
    FailingFunction{"vkQueueSubmit2", kDevice},
    FailingFunction{"vkWaitForFences", kLost},
    FailingFunction{"vkWaitForFences", kDevice},
    FailingFunction{"vkGetQueryPoolResults", kLost},
};

class EveryCall : public FaultTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(render("", "good"), 0) << err_;
    expect_clean();
    good_calls_ = calls_;
  }

  void fail_at(const FailingFunction& row, uint64_t call) {
    const std::string out = std::string(row.function) + row.result + std::to_string(call);
    SCOPED_TRACE(out + " of " + std::to_string(good_calls_[row.function]));
    const int code = render(
        "fail=" + std::string(row.function) + ":" + std::to_string(call) + (row.onwards ? "+:" : ":") + row.result,
        out);
    // How many sets of read-back buffers there are depends on how fast files are written.
    if (call > 1 && struck_ == 0) {
      EXPECT_EQ(code, 0) << err_;
      return expect_clean();
    }
    ASSERT_EQ(struck_, 1u);
    expect_clear_failure(code, row.exit);
    expect_nothing_half_written(out, "good");
  }

  std::map<std::string, uint64_t> good_calls_;
};

TEST_F(EveryCall, FirstAndLastOfEachFunctionFailWithOneSentence) {
  for (const FailingFunction& row : kFunctions) {
    const uint64_t calls = good_calls_[row.function];
    ASSERT_GT(calls, 0u) << "the tiny graph does not call " << row.function;
    fail_at(row, 1);
    if (calls > 1 && !row.onwards) fail_at(row, calls);
  }
}

class EveryCallOf : public EveryCall, public ::testing::WithParamInterface<FailingFunction> {};

TEST_P(EveryCallOf, FailsWithOneSentenceAndLeavesNothingHalfWritten) {
  const FailingFunction& row = GetParam();
  for (uint64_t call = 1; call <= good_calls_[row.function] && !HasFailure(); ++call) fail_at(row, call);
  // With nothing failing any more a folder that a failure left is as good as new.
  const std::string first = std::string(row.function) + row.result + "1";
  ASSERT_EQ(render("", first), 0) << err_;
  EXPECT_TRUE(read_text_file(folder_ / first / "radiance.0001.exr") ==
              read_text_file(folder_ / "good/radiance.0001.exr"));
}

INSTANTIATE_TEST_SUITE_P(Slow, EveryCallOf, ::testing::ValuesIn(kFunctions),
                         [](const auto& row) { return std::string(row.param.function) + "_" + row.param.result; });

}  // namespace
}  // namespace lightloom::cli
