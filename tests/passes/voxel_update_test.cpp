#include <gtest/gtest.h>

#include "framework/graph/voxel_box.hpp"
#include "passes/distance_transform.hpp"
#include "passes/emissive_faces.hpp"
#include "passes/voxel_merge.hpp"
#include "passes/voxelize.hpp"

namespace lightloom::passes {
namespace {

constexpr Extent3 kGrid{64, 48, 40};

/// Writes down what a pass records, on a grid where `moved` moved.
class Notebook final : public PassContext {
 public:
  Notebook(const PassType& type, std::vector<VoxelBox> moved, bool kept) : moved_(std::move(moved)), kept_(kept) {
    for (const Param& param : type.params) params_.set(param, param.default_value);
  }
  void set(const PassType& type, const std::string& name, const ParamValue& value) {
    params_.set(*type.find_param(name), value);
  }

  [[nodiscard]] const ParamSet& params() const override { return params_; }
  [[nodiscard]] Extent3 input_extent(std::string_view /*port*/) const override { return kGrid; }
  [[nodiscard]] Extent3 output_extent(std::string_view /*port*/) const override { return kGrid; }
  [[nodiscard]] bool connected(std::string_view /*input_port*/) const override { return true; }
  [[nodiscard]] TriangleRange static_triangles() const override { return {0, 100}; }
  [[nodiscard]] TriangleRange dynamic_triangles() const override { return {100, 10}; }
  [[nodiscard]] std::vector<TriangleRange> triangles(TriangleKind /*kind*/) const override { return {{0, 110}}; }
  [[nodiscard]] bool kept(std::string_view /*port*/) const override { return kept_; }
  [[nodiscard]] bool wanted(std::string_view /*output_port*/) const override { return true; }
  [[nodiscard]] std::vector<VoxelBox> moved_boxes(const Extent3& /*grid*/) const override { return moved_; }
  void clear(std::string_view port, const ClearColor& /*color*/) override { cleared.emplace_back(port); }
  void dispatch(const Dispatch& dispatch) override { dispatches.push_back(dispatch); }
  void draw(const Draw& draw) override { draws.push_back(draw); }

  /// Boxes of the dispatches of one shader.
  [[nodiscard]] std::vector<VoxelBox> boxes(const std::string& shader) const {
    std::vector<VoxelBox> result;
    for (const Dispatch& dispatch : dispatches) {
      if (dispatch.shader != shader) continue;
      VoxelBox box;
      const std::array<std::string, 3> axes = {"x", "y", "z"};
      for (const ShaderValue& value : dispatch.values) {
        for (size_t axis = 0; axis < 3; ++axis) {
          if (value.name == "box_low_" + axes[axis]) box.low[axis] = std::get<int32_t>(value.value);
          if (value.name == "box_high_" + axes[axis]) box.high[axis] = std::get<int32_t>(value.value);
        }
      }
      result.push_back(box);
    }
    return result;
  }

  std::vector<std::string> cleared;
  std::vector<Dispatch> dispatches;
  std::vector<Draw> draws;

 private:
  ParamSet params_;
  std::vector<VoxelBox> moved_;
  bool kept_;
};

const std::vector<VoxelBox> kTwo = {{{2, 3, 4}, {9, 9, 9}}, {{50, 40, 30}, {63, 47, 39}}};

TEST(VoxelUpdate, MergeTouchesOnlyTheBoxes) {
  const PassType type = make_voxel_merge();
  Notebook notes(type, kTwo, true);
  type.record(notes);
  EXPECT_EQ(notes.boxes("voxel_merge.comp"), kTwo);
  EXPECT_EQ(notes.dispatches.at(0).threads, (Extent3{8, 7, 6}));
}

TEST(VoxelUpdate, NothingMovedMeansNothingToDo) {
  for (const PassType& type : {make_voxelize(), make_voxel_merge(), make_distance_transform(), make_emissive_faces()}) {
    Notebook notes(type, {}, true);
    type.record(notes);
    EXPECT_TRUE(notes.dispatches.empty() && notes.cleared.empty() && notes.draws.empty()) << type.name;
  }
}

TEST(VoxelUpdate, WithoutMemoryOrAskedToOrWhereMostMovedAllIsRewritten) {
  const std::vector<VoxelBox> most = {{{0, 0, 0}, {63, 47, 30}}};
  for (const PassType& type : {make_voxel_merge(), make_distance_transform()}) {
    Notebook forgotten(type, kTwo, false);
    Notebook asked(type, kTwo, true);
    asked.set(type, "update", std::string("all"));
    Notebook large(type, most, true);
    for (Notebook* notes : {&forgotten, &asked, &large}) {
      type.record(*notes);
      for (const Dispatch& dispatch : notes->dispatches) EXPECT_EQ(dispatch.threads, kGrid) << type.name;
      EXPECT_FALSE(notes->dispatches.empty());
    }
  }
}

TEST(VoxelUpdate, DistancesReachTheRadiusAlongTheAxesPassedSoFar) {
  const PassType type = make_distance_transform();
  Notebook notes(type, {{{20, 10, 30}, {21, 12, 38}}}, true);
  notes.set(type, "radius", int64_t{3});
  type.record(notes);
  EXPECT_EQ(
      notes.boxes("distance_transform.comp"),
      (std::vector<VoxelBox>{{{17, 10, 30}, {24, 12, 38}}, {{17, 7, 30}, {24, 15, 38}}, {{17, 7, 27}, {24, 15, 39}}}));
}

TEST(VoxelUpdate, FacesAreCountedInTheColumnsAroundWhatMoved) {
  const PassType type = make_emissive_faces();
  Notebook notes(type, {{{20, 10, 30}, {21, 12, 38}}}, true);
  type.record(notes);
  EXPECT_TRUE(notes.cleared.empty());
  EXPECT_EQ(notes.boxes("emissive_faces.comp"), (std::vector<VoxelBox>{{{19, 9, 29}, {22, 13, 39}}}));
  EXPECT_EQ(notes.dispatches.at(0).threads, (Extent3{4, 5, 1}));
  Notebook forgotten(type, kTwo, false);
  type.record(forgotten);
  EXPECT_EQ(forgotten.cleared.size(), 6u);
  EXPECT_EQ(forgotten.boxes("emissive_faces.comp"), (std::vector<VoxelBox>{{{0, 0, 0}, {63, 47, 39}}}));
}

TEST(VoxelUpdate, DynamicVoxelizationClearsAndResolvesOnlyTheBoxes) {
  const PassType type = make_voxelize();
  Notebook notes(type, kTwo, true);
  notes.set(type, "geometry", std::string("dynamic"));
  type.record(notes);
  EXPECT_TRUE(notes.cleared.empty());
  EXPECT_EQ(notes.boxes("voxelize_clear.comp"), kTwo);
  EXPECT_EQ(notes.boxes("voxelize_resolve.comp"), kTwo);
}

TEST(VoxelUpdate, StaticVoxelsAreMadeOnce) {
  const PassType type = make_voxelize();
  for (const bool kept : {false, true}) {
    Notebook notes(type, kTwo, kept);
    notes.set(type, "geometry", std::string("static"));
    type.record(notes);
    EXPECT_EQ(notes.boxes("voxelize_resolve.comp").size(), kept ? 0u : 1u);
  }
}

TEST(VoxelUpdate, VoxelizeReadsTheGeometryItVoxelizes) {
  const PassType type = make_voxelize();
  Notebook notes(type, {}, false);
  const auto reads = [&](const char* geometry, FrameState state) {
    notes.set(type, "geometry", std::string(geometry));
    return contains(type.reads_of(notes.params()), state);
  };
  EXPECT_TRUE(reads("static", FrameState::static_geometry));
  EXPECT_FALSE(reads("static", FrameState::dynamic_geometry));
  EXPECT_FALSE(reads("dynamic", FrameState::static_geometry));
  EXPECT_TRUE(reads("dynamic", FrameState::dynamic_geometry));
  EXPECT_TRUE(reads("all", FrameState::static_geometry | FrameState::dynamic_geometry | FrameState::materials));
  EXPECT_TRUE(reads("static", FrameState::materials));
}

}  // namespace
}  // namespace lightloom::passes
