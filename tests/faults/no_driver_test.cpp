// Machines without a driver, or with one that cannot be used.
#include "tests/faults/fault_fixture.hpp"

namespace lightloom::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class NoDriver : public FaultTest {
 protected:
  NoDriver() { unsetenv("VK_INSTANCE_LAYERS"); }
  ~NoDriver() override {
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES", "VK_LAYER_PATH"}) unsetenv(name);
  }

  void use_driver(const std::string& manifest, const std::string& text) const {
    std::ofstream(folder_ / manifest) << text;
    for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) setenv(name, (folder_ / manifest).c_str(), 1);
  }

  void expect_no_device(const std::vector<std::string>& more = {}) {
    const int code = render("", "out", 1, more);
    EXPECT_EQ(code, 4) << err_;
    EXPECT_TRUE(err_.starts_with("error: ")) << err_;
    EXPECT_THAT(err_, HasSubstr("hint: "));
    EXPECT_TRUE(names_in("out").empty());
  }
};

TEST_F(NoDriver, AFolderWithoutManifests) {
  std::filesystem::create_directory(folder_ / "empty");
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) setenv(name, (folder_ / "empty").c_str(), 1);
  expect_no_device();
  EXPECT_THAT(err_, HasSubstr("mesa-vulkan-drivers"));
  EXPECT_EQ(run_with("", {"devices"}), 4) << out_ << err_;
}

TEST_F(NoDriver, ManifestsThatAreBroken) {
  for (const char* text : {"", "{", R"({"file_format_version": "1.0.0"})", "\xff\xfe",
                           R"({"file_format_version": "1.0.0", "ICD": {"library_path": "/nowhere/lib.so",
                               "api_version": "1.3.0"}})"}) {
    SCOPED_TRACE(text);
    use_driver("broken.json", text);
    expect_no_device();
    EXPECT_THAT(err_, HasSubstr("mesa-vulkan-drivers"));
  }
}

TEST_F(NoDriver, OneWithoutVulkan13OrANeededFeature) {
  setenv("VK_INSTANCE_LAYERS", "VK_LAYER_LIGHTLOOM_faults", 1);
  EXPECT_EQ(render("api=1.2", "out"), 4);
  EXPECT_THAT(err_, AllOf(HasSubstr("lacks Vulkan 1.3 (it has 1.2.0)"), HasSubstr("hint: ")));
  for (const char* feature : {"synchronization2", "dynamicRendering", "maintenance4", "fragmentStoresAndAtomics",
                              "shaderStorageImageExtendedFormats"}) {
    EXPECT_EQ(render(std::string("hide=") + feature, "out"), 4);
    EXPECT_THAT(err_, AllOf(HasSubstr(std::string("lacks the feature ") + feature), HasSubstr("hint: ")));
  }
  EXPECT_TRUE(names_in("out").empty());
}

TEST_F(NoDriver, ValidationThatIsNotInstalledNamesItsPackage) {
  std::filesystem::create_directory(folder_ / "empty");
  unsetenv("VK_ADD_LAYER_PATH");
  setenv("VK_LAYER_PATH", (folder_ / "empty").c_str(), 1);
  expect_no_device({"--validate"});
  EXPECT_THAT(err_, AllOf(HasSubstr("VK_LAYER_KHRONOS_validation"), HasSubstr("vulkan-validationlayers")));
}

TEST_F(NoDriver, AnUnknownDeviceListsThoseThereAre) {
  expect_no_device({"--device", "abacus"});
  EXPECT_THAT(err_, AllOf(HasSubstr("no device fits 'abacus'; there is [0] "), HasSubstr("--device")));
}

}  // namespace
}  // namespace lightloom::cli
