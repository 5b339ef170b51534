#include "framework/graph/voxel_box.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

namespace lightloom {
namespace {

constexpr int kLevels = 6;  // beyond 64 boxes, all pairs would be too many to look at

std::array<int32_t, 3> last_voxel(const Extent3& grid) {
  return {static_cast<int32_t>(grid.width) - 1, static_cast<int32_t>(grid.height) - 1,
          static_cast<int32_t>(grid.depth) - 1};
}

bool worth_uniting(const VoxelBox& a, const VoxelBox& b) {
  return overlap(a, b) || volume(united(a, b)) <= volume(a) + volume(b);
}

/// Takes the two boxes out whose union adds the fewest voxels, and returns the union.
VoxelBox take_cheapest_pair(std::vector<VoxelBox>& boxes) {
  std::pair<size_t, size_t> best{0, 1};
  int64_t least = std::numeric_limits<int64_t>::max();
  for (size_t i = 0; i < boxes.size(); ++i) {
    for (size_t j = i + 1; j < boxes.size(); ++j) {
      const int64_t added = volume(united(boxes[i], boxes[j])) - volume(boxes[i]) - volume(boxes[j]);
      if (added >= least) continue;
      least = added;
      best = {i, j};
    }
  }
  const VoxelBox both = united(boxes[best.first], boxes[best.second]);
  boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(best.second));
  boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(best.first));
  return both;
}

/// Puts a box among disjoint ones, united with those it should not stand beside.
void insert(std::vector<VoxelBox>& boxes, VoxelBox box) {
  for (auto other = boxes.begin(); other != boxes.end();) {
    other = std::find_if(boxes.begin(), boxes.end(),
                         [&](const VoxelBox& candidate) { return worth_uniting(candidate, box); });
    if (other == boxes.end()) break;
    box = united(box, *other);
    boxes.erase(other);
    other = boxes.begin();
  }
  boxes.push_back(box);
}

size_t longest_axis(const VoxelBox& box) {
  size_t longest = 0;
  for (size_t axis = 1; axis < 3; ++axis)
    if (box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest]) longest = axis;
  return longest;
}

/// Unites neighbours until at most 2^levels are left: halves the boxes along the longest axis of what holds them all.
void unite_neighbours(std::span<VoxelBox> boxes, int levels, std::vector<VoxelBox>& out) {
  if (boxes.empty()) return;
  const VoxelBox all = std::accumulate(boxes.begin() + 1, boxes.end(), boxes.front(), united);
  if (levels == 0 || boxes.size() == 1) {
    out.push_back(all);
    return;
  }
  const size_t axis = longest_axis(all);
  const size_t half = boxes.size() / 2;
  std::nth_element(
      boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(half), boxes.end(),
      [&](const VoxelBox& a, const VoxelBox& b) { return a.low[axis] + a.high[axis] < b.low[axis] + b.high[axis]; });
  unite_neighbours(boxes.first(half), levels - 1, out);
  unite_neighbours(boxes.subspan(half), levels - 1, out);
}

}  // namespace

int64_t volume(const VoxelBox& box) {
  int64_t product = 1;
  for (size_t axis = 0; axis < 3; ++axis) product *= std::max<int64_t>(int64_t{box.high[axis]} - box.low[axis] + 1, 0);
  return product;
}

int64_t volume(const std::vector<VoxelBox>& boxes) {
  int64_t sum = 0;
  for (const VoxelBox& box : boxes) sum += volume(box);
  return sum;
}

VoxelBox whole_grid(const Extent3& grid) {
  return {{0, 0, 0}, last_voxel(grid)};
}

bool overlap(const VoxelBox& a, const VoxelBox& b) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (std::max(a.low[axis], b.low[axis]) > std::min(a.high[axis], b.high[axis])) return false;
  return true;
}

VoxelBox united(const VoxelBox& a, const VoxelBox& b) {
  VoxelBox both;
  for (size_t axis = 0; axis < 3; ++axis) {
    both.low[axis] = std::min(a.low[axis], b.low[axis]);
    both.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return both;
}

VoxelBox dilated(const VoxelBox& box, const std::array<int32_t, 3>& margin, const Extent3& grid) {
  const std::array<int32_t, 3> last = last_voxel(grid);
  VoxelBox wide;
  for (size_t axis = 0; axis < 3; ++axis) {
    wide.low[axis] = std::max(box.low[axis] - margin[axis], 0);
    wide.high[axis] = std::min(box.high[axis] + margin[axis], last[axis]);
  }
  return wide;
}

std::vector<VoxelBox> merged(const std::vector<VoxelBox>& boxes, size_t limit) {
  std::vector<VoxelBox> filled;
  std::copy_if(boxes.begin(), boxes.end(), std::back_inserter(filled),
               [](const VoxelBox& box) { return volume(box) > 0; });
  std::vector<VoxelBox> fewer;
  unite_neighbours(filled, kLevels, fewer);
  std::vector<VoxelBox> result;
  for (const VoxelBox& box : fewer) insert(result, box);
  while (result.size() > std::max<size_t>(limit, 1)) insert(result, take_cheapest_pair(result));
  return result;
}

}  // namespace lightloom
