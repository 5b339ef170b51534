#include "framework/scene/camera_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/base/error.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

glm::vec3 eye_of(const Camera& camera) {
  return glm::vec3(camera.world_from_camera[3]);
}

glm::vec3 forward_of(const Camera& camera) {
  return -glm::vec3(camera.world_from_camera[2]);
}

void expect_near(const glm::vec3& value, const glm::vec3& expected, float tolerance = 1e-5f) {
  EXPECT_NEAR(glm::distance(value, expected), 0, tolerance)
      << value.x << " " << value.y << " " << value.z << " instead of " << expected.x << " " << expected.y << " "
      << expected.z;
}

/// Keyframes of a curve at uneven times, looking along -z by rotation.
CameraPath path_along(const std::function<glm::dvec3(double)>& curve, const std::vector<double>& times,
                      PathInterpolation interpolation) {
  CameraPath path;
  path.interpolation = interpolation;
  for (const double time : times)
    path.keys.push_back({.time = time, .position = curve(time), .aim = glm::dquat(1, 0, 0, 0), .vertical_fov = {}});
  return path;
}

const std::vector<double> kUneven = {0, 0.5, 2, 2.25, 5};

TEST(CameraPath, PassesThroughItsKeyframesAndRestsBeyondThem) {
  const auto curve = [](double t) { return glm::dvec3(std::sin(t), t * t, std::cos(3 * t)); };
  for (const auto interpolation : {PathInterpolation::linear, PathInterpolation::catmull_rom}) {
    const CameraPath path = path_along(curve, kUneven, interpolation);
    for (const double time : kUneven) expect_near(eye_of(camera_on_path(path, time, {})), curve(time));
    expect_near(eye_of(camera_on_path(path, -7, {})), curve(0));
    expect_near(eye_of(camera_on_path(path, 1e9, {})), curve(5));
  }
}

TEST(CameraPath, EvenMotionStaysEvenWhateverTheTimes) {
  const auto line = [](double t) { return glm::dvec3(1 - t, 2 * t, 3); };
  for (const auto interpolation : {PathInterpolation::linear, PathInterpolation::catmull_rom}) {
    const CameraPath path = path_along(line, kUneven, interpolation);
    for (double time = 0; time <= 5; time += 0.01) expect_near(eye_of(camera_on_path(path, time, {})), line(time));
  }
}

TEST(CameraPath, CatmullRomFollowsAParabolaBetweenInnerKeyframes) {
  const auto parabola = [](double t) { return glm::dvec3(t * t - 3 * t, 5 - 0.5 * t * t, t); };
  const CameraPath path = path_along(parabola, kUneven, PathInterpolation::catmull_rom);
  for (double time = 0.5; time <= 2.25; time += 0.01)
    expect_near(eye_of(camera_on_path(path, time, {})), parabola(time));
}

TEST(CameraPath, CatmullRomHasNoJumpInVelocityAndLinearHas) {
  const auto curve = [](double t) { return glm::dvec3(std::sin(4 * t), std::cos(3 * t), t); };
  // In double precision around the keyframe; camera matrices are float, so the step is not too small.
  const auto velocity_jump = [&](PathInterpolation interpolation, double key) {
    const CameraPath path = path_along(curve, kUneven, interpolation);
    const double step = 1e-3;
    const auto at = [&](double time) { return glm::dvec3(eye_of(camera_on_path(path, time, {}))); };
    return glm::length((at(key + step) - at(key)) - (at(key) - at(key - step))) / step;
  };
  for (const double key : {0.5, 2.0, 2.25}) {
    EXPECT_LT(velocity_jump(PathInterpolation::catmull_rom, key), 0.1) << key;
    EXPECT_GT(velocity_jump(PathInterpolation::linear, key), 0.5) << key;
  }
}

TEST(CameraPath, OfEvenTimesIsTheUniformCatmullRomSpline) {
  const std::vector<glm::dvec3> points = {{0, 0, 0}, {1, 3, 0}, {4, 2, 1}, {5, -1, 2}};
  CameraPath path;
  for (size_t i = 0; i < points.size(); ++i)
    path.keys.push_back(
        {.time = 10.0 + double(i), .position = points[i], .aim = glm::dquat(1, 0, 0, 0), .vertical_fov = {}});
  for (double u = 0; u <= 1; u += 0.125) {
    // The basis matrix of the published spline with tension 1/2.
    const glm::dvec3 expected = 0.5 * ((2.0 * points[1]) + (points[2] - points[0]) * u +
                                       (2.0 * points[0] - 5.0 * points[1] + 4.0 * points[2] - points[3]) * (u * u) +
                                       (3.0 * points[1] - points[0] - 3.0 * points[2] + points[3]) * (u * u * u));
    expect_near(eye_of(camera_on_path(path, 11 + u, {})), expected);
  }
}

TEST(CameraPath, TargetsAreLookedAtWithALevelHorizon) {
  CameraPath path;
  path.keys = {{.time = 0, .position = {0, 1, 5}, .aim = glm::dvec3(0, 0, 0), .vertical_fov = {}},
               {.time = 1, .position = {5, 2, 0}, .aim = glm::dvec3(0, 1, 0), .vertical_fov = {}},
               {.time = 3, .position = {0, 4, -5}, .aim = glm::dvec3(0, 0, 0), .vertical_fov = {}}};
  path.interpolation = PathInterpolation::linear;
  expect_near(forward_of(camera_on_path(path, 0.5, {})), glm::normalize(glm::vec3(-2.5f, -1, -2.5f)));
  for (double time = 0; time <= 3; time += 0.1) {
    const Camera camera = camera_on_path(path, time, {});
    EXPECT_NEAR(camera.world_from_camera[0].y, 0, 1e-6) << "the image's x axis is horizontal";
    EXPECT_GT(camera.world_from_camera[1].y, 0) << "up is up";
    EXPECT_NEAR(glm::determinant(camera.world_from_camera), 1, 1e-5);
  }
  // As the usual look-at matrix has it.
  const glm::mat4 expected = glm::inverse(glm::lookAtRH(glm::vec3(5, 2, 0), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0)));
  const Camera camera = camera_on_path(path, 1, {});
  for (int column = 0; column < 4; ++column)
    EXPECT_NEAR(glm::distance(camera.world_from_camera[column], expected[column]), 0, 1e-5);
}

TEST(CameraPath, RotationsTurnEvenlyTheShorterWay) {
  const auto about_y = [](double degrees) { return glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 1, 0)); };
  CameraPath path;
  path.keys = {{.time = 0, .position = {}, .aim = about_y(0), .vertical_fov = {}},
               {.time = 2, .position = {}, .aim = -about_y(80), .vertical_fov = {}}};
  for (double time = 0; time <= 2; time += 0.25) {
    const double angle = glm::radians(40 * time);
    expect_near(forward_of(camera_on_path(path, time, {})), glm::vec3(-std::sin(angle), 0, -std::cos(angle)));
  }
}

TEST(CameraPath, TheFieldOfViewIsThePathsOrTheCameras) {
  Camera camera;
  camera.vertical_fov = 0.7f;
  CameraPath path;
  path.keys = {{.time = 0, .position = {}, .aim = glm::dquat(1, 0, 0, 0), .vertical_fov = {}}};
  EXPECT_EQ(camera_on_path(path, 0, camera).vertical_fov, 0.7f);
  path.keys = {{.time = 0, .position = {}, .aim = glm::dquat(1, 0, 0, 0), .vertical_fov = 0.5},
               {.time = 1, .position = {}, .aim = glm::dquat(1, 0, 0, 0), .vertical_fov = 1.0}};
  EXPECT_FLOAT_EQ(camera_on_path(path, 0.5, camera).vertical_fov, 0.75f);
}

TEST(CameraPath, AViewThatCurvesOntoItsTargetIsStillAView) {
  CameraPath path;
  path.interpolation = PathInterpolation::linear;
  path.keys = {{.time = 0, .position = {0, 0, 1}, .aim = glm::dvec3(0, 0, 0), .vertical_fov = {}},
               {.time = 1, .position = {0, 0, -1}, .aim = glm::dvec3(0, 0, 0), .vertical_fov = {}}};
  const Camera camera = camera_on_path(path, 0.5, {});
  EXPECT_NEAR(glm::determinant(camera.world_from_camera), 1, 1e-6);
}

class CameraPathFile : public ::testing::Test {
 protected:
  CameraPath load(const std::string& json) const { return read_camera_path(folder.write("p.json", json)); }

  std::string error_of(const std::string& json) const {
    try {
      (void)load(json);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      return error.what() + std::string(" | ") + error.hint();
    }
    return "no error";
  }

  TemporaryFolder folder;
};

TEST_F(CameraPathFile, ReadsEverything) {
  const CameraPath path = load(R"({
    "lightloom_camera_path": 1, "interpolation": "linear", "up": [0, 0, 1],
    "keyframes": [
      {"time": -1, "position": [1, 2, 3], "target": [0, 0, 0], "vertical_fov_degrees": 90},
      {"time": 2.5, "position": [4, 5, 6], "target": [0, 0, 1], "vertical_fov_degrees": 45}]})");
  EXPECT_EQ(path.interpolation, PathInterpolation::linear);
  EXPECT_EQ(path.up, glm::dvec3(0, 0, 1));
  ASSERT_EQ(path.keys.size(), 2u);
  EXPECT_EQ(path.keys[1].time, 2.5);
  EXPECT_EQ(path.keys[1].position, glm::dvec3(4, 5, 6));
  EXPECT_EQ(std::get<glm::dvec3>(path.keys[1].aim), glm::dvec3(0, 0, 1));
  EXPECT_DOUBLE_EQ(path.keys[0].vertical_fov.value(), glm::half_pi<double>());
  const CameraPath turned = load(
      R"({"lightloom_camera_path": 1, "keyframes": [{"time": 0, "position": [0, 0, 0], "rotation": [0, 1, 0, 0]}]})");
  EXPECT_EQ(turned.interpolation, PathInterpolation::catmull_rom);
  expect_near(forward_of(camera_on_path(turned, 3, {})), {0, 0, 1});
}

TEST_F(CameraPathFile, ErrorsNameThePlace) {
  const auto with_keys = [](const std::string& keys) {
    return "{\"lightloom_camera_path\": 1,\n \"keyframes\": [" + keys + "]}";
  };
  const std::string good = R"({"time": 0, "position": [0, 0, 1], "target": [0, 0, 0]})";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"{", "p.json:1:2"},
      {"[]", "p.json:1:1: the camera path is an array, expected an object"},
      {R"({"keyframes": []})", "lightloom_camera_path is missing"},
      {R"({"lightloom_camera_path": 2, "keyframes": []})", ":1:27: lightloom_camera_path is 2, expected 1"},
      {R"({"lightloom_camera_path": 1})", "keyframes is missing"},
      {with_keys(""), "keyframes is empty"},
      {R"({"lightloom_camera_path": 1, "interpolation": "cubic", "keyframes": []})",
       ":1:47: interpolation is 'cubic', expected 'linear' or 'catmull_rom'"},
      {R"({"lightloom_camera_path": 1, "keyframe": []})", "keyframes is missing"},
      {R"({"lightloom_camera_path": 1, "keyframes": [], "interpolate": 1})", "did you mean 'interpolation'?"},
      {R"({"lightloom_camera_path": 1, "up": [0, 0, 0], "keyframes": []})", "up is zero"},
      {with_keys(R"({"position": [0, 0, 1], "target": [0, 0, 0]})"), ":2:16: keyframes[0].time is missing"},
      {with_keys(R"({"time": "0", "position": [0, 0, 1], "target": [0, 0, 0]})"),
       "time is a string, expected a number"},
      {with_keys(R"({"time": 0, "position": [0, 1], "target": [0, 0, 0]})"), "not an array of 3 numbers"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1]})"), "neither target nor rotation"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "target": [0, 0, 0], "rotation": [0, 0, 0, 1]})"),
       "both target and rotation"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "target": [0, 0, 1]})"), "the same position and target"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "target": [0, 5, 1]})"), "looks along up"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "rotation": [0, 0, 0, 2]})"), "is not of length 1"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "target": [0, 0, 0], "vertical_fov_degrees": 180})"),
       "expected a value from 0.01 to 179.9"},
      {with_keys(R"({"time": 0, "position": [0, 0, 1], "target": [0, 0, 0], "fov": 3})"),
       "keyframes[0].fov is not a known member"},
      {with_keys(good + ",\n" + good), ":3:1: keyframes[1] is not later than the one before"},
      {with_keys(good + R"(, {"time": 1, "position": [0, 0, 1], "rotation": [0, 0, 0, 1]})"),
       "keyframes[1] has a rotation unlike the first"},
      {with_keys(good + R"(, {"time": 1, "position": [0, 0, 1], "target": [0, 0, 0], "vertical_fov_degrees": 9})"),
       "keyframes[1] has a vertical_fov_degrees unlike the first"},
  };
  for (const auto& [json, expected] : cases) {
    SCOPED_TRACE(json);
    EXPECT_THAT(error_of(json), HasSubstr(expected));
  }
  EXPECT_THROW((void)read_camera_path(folder.path() / "absent.json"), Error);
}

}  // namespace
}  // namespace lightloom::scene
