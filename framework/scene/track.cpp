#include <algorithm>
#include <cmath>

#include "framework/scene/source.hpp"

namespace lightloom::scene {
namespace {

glm::quat quaternion(const float* xyzw) {
  return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
}

void normalise_quaternion(std::vector<float>& xyzw) {
  const glm::quat q = quaternion(xyzw.data());
  const float length = glm::length(q);
  if (length > 0) {
    for (float& value : xyzw) value /= length;
  } else {
    xyzw = {0, 0, 0, 1};
  }
}

std::vector<float> slerp(const float* a, const float* b, float amount) {
  const glm::quat result =
      glm::normalize(glm::slerp(glm::normalize(quaternion(a)), glm::normalize(quaternion(b)), amount));
  return {result.x, result.y, result.z, result.w};
}

std::vector<float> hermite(const Track& track, size_t key, float amount, float seconds) {
  const size_t width = track.width;
  const float* from = &track.values[key * 3 * width];
  const float* to = from + 3 * width;
  const float t = amount, t2 = t * t, t3 = t2 * t;
  std::vector<float> result(width);
  for (size_t k = 0; k < width; ++k) {
    const float value0 = from[width + k], out_tangent = from[2 * width + k] * seconds;
    const float value1 = to[width + k], in_tangent = to[k] * seconds;
    result[k] = (2 * t3 - 3 * t2 + 1) * value0 + (t3 - 2 * t2 + t) * out_tangent + (3 * t2 - 2 * t3) * value1 +
                (t3 - t2) * in_tangent;
  }
  return result;
}

std::vector<float> key_value(const Track& track, size_t key) {
  const size_t group = track.interpolation == Interpolation::cubic ? 3 : 1;
  const auto begin = track.values.begin() + static_cast<std::ptrdiff_t>((key * group + group / 2) * track.width);
  return {begin, begin + static_cast<std::ptrdiff_t>(track.width)};
}

}  // namespace

std::vector<float> sample_track(const Track& track, double time) {
  const auto next = std::upper_bound(track.times.begin(), track.times.end(), time,
                                     [](double wanted, float key) { return wanted < static_cast<double>(key); });
  const auto after = static_cast<size_t>(next - track.times.begin());
  std::vector<float> result;
  if (after == 0 || after == track.times.size() || track.interpolation == Interpolation::step) {
    result = key_value(track, after == 0 ? 0 : after - 1);
  } else {
    const double start = static_cast<double>(track.times[after - 1]), end = static_cast<double>(track.times[after]);
    const auto amount = static_cast<float>((time - start) / (end - start));
    if (track.interpolation == Interpolation::cubic) {
      result = hermite(track, after - 1, amount, static_cast<float>(end - start));
    } else if (track.path == TrackPath::rotation) {
      return slerp(&track.values[(after - 1) * 4], &track.values[after * 4], amount);
    } else {
      result = key_value(track, after - 1);
      const std::vector<float> target = key_value(track, after);
      for (size_t k = 0; k < track.width; ++k) result[k] += (target[k] - result[k]) * amount;
    }
  }
  if (track.path == TrackPath::rotation) normalise_quaternion(result);
  return result;
}

double clip_time(const Clip& clip, double time) {
  const double wrapped = std::fmod(time + clip.offset, clip.duration);
  return wrapped < 0 ? wrapped + clip.duration : wrapped;
}

}  // namespace lightloom::scene
