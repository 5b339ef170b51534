#include "framework/run/frame_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "framework/base/error.hpp"

namespace lightloom::run {
namespace {

const scene::Bounds kRoom{{-5, 0, -5}, {5, 4, 5}};

scene::Camera camera_at(const glm::vec3& eye, const glm::vec3& target) {
  scene::Camera camera;
  camera.world_from_camera = glm::inverse(glm::lookAtRH(eye, target, glm::vec3(0, 1, 0)));
  camera.vertical_fov = 1.0f;
  return camera;
}

glm::vec3 project(const View& view, const glm::vec3& point) {
  const glm::vec4 clip = view.view_projection * glm::vec4(point, 1);
  return glm::vec3(clip) / clip.w;
}

TEST(ViewOf, TargetIsInTheMiddleAndUpIsUpInTheImage) {
  const View view = view_of(camera_at({0, 1, 4}, {0, 1, 0}), {640, 480, 1}, kRoom);
  const glm::vec3 target = project(view, {0, 1, 0});
  EXPECT_NEAR(target.x, 0, 1e-5);
  EXPECT_NEAR(target.y, 0, 1e-5);
  EXPECT_LT(project(view, {0, 2, 0}).y, 0) << "Vulkan's clip space has y down";
  EXPECT_GT(project(view, {1, 1, 0}).x, 0);
}

TEST(ViewOf, VerticalFieldOfViewIsTheCameras) {
  // At 4 m, half the height seen is 4 tan(fov / 2), whatever the width.
  const float half_height = 4 * std::tan(0.5f);
  for (const Extent3 extent : {Extent3{640, 480, 1}, Extent3{100, 400, 1}, Extent3{3, 1, 1}}) {
    const View view = view_of(camera_at({0, 1, 4}, {0, 1, 0}), extent, kRoom);
    EXPECT_NEAR(project(view, {0, 1 - half_height, 0}).y, 1, 1e-4);
    const float half_width = half_height * static_cast<float>(extent.width) / static_cast<float>(extent.height);
    EXPECT_NEAR(project(view, {half_width, 1, 0}).x, 1, 1e-4);
  }
}

TEST(ViewOf, DepthGrowsFromZeroToOneOverTheRoom) {
  const View view = view_of(camera_at({0, 1, 4}, {0, 1, 0}), {640, 480, 1}, kRoom);
  const float near_depth = project(view, {0, 1, 3.9f}).z;
  const float far_depth = project(view, {0, 1, -5}).z;
  EXPECT_GE(near_depth, 0);
  EXPECT_LT(near_depth, far_depth);
  EXPECT_LE(far_depth, 1);
}

TEST(ViewOf, OrthographicHasADirectionForAnEye) {
  scene::Camera camera = camera_at({0, 1, 4}, {0, 1, 0});
  camera.perspective = false;
  camera.half_height = 2;
  const View view = view_of(camera, {200, 100, 1}, kRoom);
  EXPECT_NEAR(project(view, {0, -1, 0}).y, 1, 1e-5);
  EXPECT_NEAR(project(view, {4, 1, -3}).x, 1, 1e-5) << "the same at any depth";
  EXPECT_EQ(view.eye.w, 0);
  EXPECT_NEAR(view.eye.z, 1, 1e-6) << "towards the viewer";
}

TEST(FrameBlock, OldestKnownViewStandsForAgesBefore) {
  const scene::Scene scene;
  FrameInputs inputs;
  for (float x : {3.0f, 2.0f}) {
    View view;
    view.eye.x = x;
    inputs.views.push_back(view);
  }
  const FrameBlock block = make_frame_block(scene, inputs);
  EXPECT_EQ(block.eye[0].x, 3);
  EXPECT_EQ(block.eye[1].x, 2);
  EXPECT_EQ(block.eye[kHistoryLimit - 1].x, 2);
}

TEST(FrameBlock, SmallSunKeepsItsDigits) {
  scene::Scene scene;
  scene.sun = scene::Sun{{0, -1, 0}, glm::vec3(1), 0.00465303f};  // 0.2666 degrees
  FrameInputs inputs;
  inputs.views = {view_of(camera_at({1, 2, 3}, {-2, 0.5f, 0}), {640, 480, 1}, kRoom)};
  const double angle = 0.00465303;  // 1 - cos = angle^2 / 2 - angle^4 / 24 + …
  const double expected = angle * angle / 2 - std::pow(angle, 4) / 24;
  EXPECT_NEAR(static_cast<double>(make_frame_block(scene, inputs).sun_irradiance.w) / expected, 1, 1e-6);
}

TEST(FrameBlock, InverseUndoesTheProjection) {
  const scene::Scene scene;
  FrameInputs inputs;
  inputs.views = {view_of(camera_at({1, 2, 3}, {-2, 0.5f, 0}), {640, 480, 1}, kRoom)};
  const FrameBlock block = make_frame_block(scene, inputs);
  const glm::mat4 identity = block.inverse_view_projection * block.view_projection[0];
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) EXPECT_NEAR(identity[column][row], column == row ? 1 : 0, 2e-3);
}

TEST(Punctual, SpotConeGoesFromOneInsideToZeroOutside) {
  scene::PunctualLight light;
  light.type = scene::PunctualType::spot;
  light.inner_cone = 0.3f;
  light.outer_cone = 0.5f;
  const PunctualEntry entry = make_punctual_entries({light}).front();
  const auto attenuation = [&](float angle) { return std::cos(angle) * entry.cone.x + entry.cone.y; };
  EXPECT_NEAR(attenuation(0.3f), 1, 1e-5);
  EXPECT_NEAR(attenuation(0.5f), 0, 1e-5);
}

TEST(Punctual, MoreThanABlockHoldsIsRefused) {
  EXPECT_THROW(make_punctual_entries(std::vector<scene::PunctualLight>(kPunctualLimit + 1)), Error);
}

}  // namespace
}  // namespace lightloom::run
