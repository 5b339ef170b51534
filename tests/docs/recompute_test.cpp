// samples/recompute.py computes stages again from the dumps of a run alone, and finds what is wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "framework/base/file.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

struct Outcome {
  int status = 0;
  std::string output;
};

class Recompute : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "lightloom recompute XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  Outcome shell(const std::string& command) const {
    const fs::path log = folder_ / "log.txt";
    const int status = std::system((command + " >'" + log.string() + "' 2>&1 </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text_file(log)};
  }

  /// Renders the sample scene small, everything dumped, into the folder `run`.
  void render(const std::string& options, const std::string& graph = "paper") const {
    const std::string source = source_dir().string();
    const Outcome rendered =
        shell(std::string("'") + LIGHTLOOM_PROGRAM + "' render '" + source + "/graphs/" + graph + ".json' --scene '" +
              source +
              "/samples/scenes/atrium.scene.json' --size 128x96 --trace-size 128x96 --set resolution=40 --dump '*' " +
              "--dump-format npy --out '" + (folder_ / "run").string() + "' " + options);
    ASSERT_EQ(rendered.status, 0) << rendered.output;
  }

  Outcome recompute(const std::string& options = "") const {
    return shell("'" + (source_dir() / "samples/recompute.py").string() + "' '" + (folder_ / "run").string() + "' " +
                 options);
  }

  fs::path dump(const std::string& file) const { return folder_ / "run/dumps" / file; }

  /// Gives `change` the data of an array, after its header.
  template <typename Change>
  void corrupt(const std::string& file, const Change& change) const {
    std::string bytes = read_text_file(dump(file));
    const size_t header = 10 + static_cast<uint8_t>(bytes[8]) + 256u * static_cast<uint8_t>(bytes[9]);
    ASSERT_GT(bytes.size(), header);
    change(bytes.data() + header, bytes.size() - header);
    std::ofstream(dump(file), std::ios::binary) << bytes;
  }

  /// Multiplies the floats with these indices, which must not be 0.
  void scale_floats(const std::string& file, size_t first, size_t count, float factor) const {
    corrupt(file, [&](char* data, size_t size) {
      ASSERT_LE((first + count) * sizeof(float), size);
      for (size_t index = first; index < first + count; ++index) {
        float value = 0;
        std::memcpy(&value, data + index * sizeof value, sizeof value);
        value *= factor;
        std::memcpy(data + index * sizeof value, &value, sizeof value);
      }
    });
  }

  fs::path folder_;
};

const char* const kWalk = "--camera-path '%/samples/scenes/atrium.path.json' --frames 0..9 --fps 10";

std::string walk() {
  std::string options = kWalk;
  return options.replace(options.find('%'), 1, source_dir().string());
}

TEST_F(Recompute, AgreesAlongAMovingCameraAndFindsWhatWasChanged) {
  render(walk());
  const Outcome whole = recompute();
  ASSERT_EQ(whole.status, 0) << whole.output;
  EXPECT_THAT(whole.output, HasSubstr("agrees  distance (distance_transform): largest difference 0 absolute"));
  for (const char* pass : {"temporal", "denoise_box_x", "denoise_box_y", "modulate", "tonemap"})
    EXPECT_THAT(whole.output, HasSubstr(std::string("agrees  ") + pass + " "));
  EXPECT_EQ(recompute("--frame 4").status, 0) << "a shorter history";

  // One result of each stage, then one thing that it was made from.
  const size_t middle = size_t{4} * (48 * 128 + 64);
  scale_floats("0009/temporal.radiance.npy", middle, 1, 1.001f);
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS temporal "));
  EXPECT_EQ(recompute().status, 1);
  scale_floats("0009/temporal.radiance.npy", middle, 1, 1 / 1.001f);
  EXPECT_EQ(recompute().status, 0) << "put back, but for the last bit";

  scale_floats("0005/trace.radiance.npy", middle, 4 * 128, 1.01f);
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS temporal "));
  scale_floats("0005/trace.radiance.npy", middle, 4 * 128, 1 / 1.01f);

  scale_floats("0009/denoise_box_x.radiance.npy", middle, 1, 1.001f);
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS denoise_box_x "));
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS denoise_box_y "));
  scale_floats("0009/denoise_box_x.radiance.npy", middle, 1, 1 / 1.001f);

  scale_floats("0009/gather.surface.emission.npy", 0, 4 * 128 * 96, 1.01f);
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS modulate "));
  scale_floats("0009/gather.surface.emission.npy", 0, 4 * 128 * 96, 1 / 1.01f);

  corrupt("0009/tonemap.image.npy", [](char* data, size_t size) { data[size / 2] ^= 1; });
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS tonemap (tonemap): largest difference 1 absolute"));
  corrupt("0009/tonemap.image.npy", [](char* data, size_t size) { data[size / 2] ^= 1; });

  corrupt("0009/distance.distance.npy", [](char* data, size_t size) { data[size / 2] ^= 1; });
  const Outcome distance = recompute();
  EXPECT_EQ(distance.status, 1);
  EXPECT_THAT(distance.output, HasSubstr("DIFFERS distance (distance_transform): largest difference 1 absolute"));
  EXPECT_THAT(distance.output, Not(HasSubstr("DIFFERS temporal")));
}

TEST_F(Recompute, AgreesOnWhatMovesItself) {
  render("--camera detail --frames 0..5 --fps 10");
  const Outcome whole = recompute();
  ASSERT_EQ(whole.status, 0) << whole.output;
  // Without the motion of the gem its history is another one.
  corrupt("0005/moving_positions.npy", [this](char* data, size_t size) {
    const std::string before = read_text_file(dump("0000/moving_positions.npy"));
    std::memcpy(data, before.data() + before.size() - size, size);
  });
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS temporal "));
}

TEST_F(Recompute, AgreesOnLobesApartAndOnEachCurveAndSaysWhatItLeavesOut) {
  for (const char* curve : {"reinhard", "linear"}) {
    render(std::string("--frames 0 --set tonemap.curve=") + curve, "lightloom");
    const Outcome whole = recompute();
    ASSERT_EQ(whole.status, 0) << whole.output;
    for (const char* pass : {"distance", "modulate", "tonemap"})
      EXPECT_THAT(whole.output, HasSubstr(std::string("agrees  ") + pass + " "));
    EXPECT_THAT(whole.output, HasSubstr("left out denoise_diffuse_box_x (box_blur): its input `guide`"));
  }
  scale_floats("0000/denoise_specular_box_y.radiance.npy", size_t{4} * (48 * 128 + 64), 4 * 128, 1.01f);
  EXPECT_THAT(recompute().output, HasSubstr("DIFFERS modulate "));
}

TEST_F(Recompute, SaysWhatIsMissing) {
  EXPECT_EQ(recompute().status, 2) << "no run folder";
  render("--frames 0..1");
  EXPECT_EQ(recompute("--frame 7").status, 2);
  EXPECT_THAT(recompute("--frame 7").output, HasSubstr("frame 7 has no dumps"));
  fs::remove(dump("0000/trace.radiance.npy"));
  EXPECT_EQ(recompute().status, 2);
  EXPECT_THAT(recompute().output, HasSubstr("trace.radiance.npy' is missing"));
}

}  // namespace
}  // namespace lightloom
