#include "renderer/scene/animation/sampling.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

namespace {

/// Cosine of the angle from which two rotations are too close for a division by its sine.
constexpr double kNearlySame = 1 - 1e-9;

void copyKeyframe(const Sampler& sampler, std::size_t keyframe, std::span<double> value) {
  std::copy_n(valueOf(sampler, keyframe), sampler.components, value.begin());
}

/// The shorter way around (glTF 2.0, C.4).
void slerp(const float* from, const float* to, double share, std::span<double> value) {
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i) cosine += double{from[i]} * double{to[i]};
  const double side = cosine < 0 ? -1 : 1;
  cosine = std::min(std::abs(cosine), 1.0);
  double first = 1 - share;
  double second = share;
  if (cosine < kNearlySame) {
    const double angle = std::acos(cosine);
    first = std::sin((1 - share) * angle) / std::sin(angle);
    second = std::sin(share * angle) / std::sin(angle);
  }
  for (std::size_t i = 0; i < 4; ++i) value[i] = first * double{from[i]} + side * second * double{to[i]};
}

/// Hermite's spline, tangents per second (glTF 2.0, C.5).
void spline(const Sampler& sampler, std::size_t keyframe, double share, double seconds, std::span<double> value) {
  const double t = share;
  const double t2 = t * t;
  const double t3 = t2 * t;
  const std::size_t count = sampler.components;
  const float* from = valueOf(sampler, keyframe);
  const float* to = valueOf(sampler, keyframe + 1);
  const float* outTangent = from + count;
  const float* inTangent = to - count;
  for (std::size_t i = 0; i < count; ++i) {
    value[i] = (2 * t3 - 3 * t2 + 1) * double{from[i]} + seconds * (t3 - 2 * t2 + t) * double{outTangent[i]} +
               (3 * t2 - 2 * t3) * double{to[i]} + seconds * (t3 - t2) * double{inTangent[i]};
  }
}

/// A spline may cross zero between two rotations: then there is no direction to keep, and the nearer keyframe counts.
void makeUnit(const float* nearest, std::span<double> value) {
  const double length = std::hypot(std::hypot(value[0], value[1]), std::hypot(value[2], value[3]));
  const bool usable = length > 1e-12 && std::isfinite(length);
  for (std::size_t i = 0; i < 4; ++i) value[i] = usable ? value[i] / length : double{nearest[i]};
}

} // namespace

const float* valueOf(const Sampler& sampler, std::size_t keyframe) {
  const std::size_t rows = sampler.interpolation == Interpolation::cubicSpline ? 3 : 1;
  return sampler.values.data() + (keyframe * rows + rows / 2) * sampler.components;
}

void sample(const Sampler& sampler, double timeSeconds, std::span<double> value) {
  const std::vector<float>& times = sampler.times;
  const auto after = std::upper_bound(times.begin(), times.end(), timeSeconds,
                                      [](double time, float keyframe) { return time < double{keyframe}; });
  if (after == times.begin()) return copyKeyframe(sampler, 0, value);
  const auto keyframe = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end() || sampler.interpolation == Interpolation::step) {
    return copyKeyframe(sampler, keyframe, value);
  }
  const double seconds = double{*after} - double{times[keyframe]};
  const double share = (timeSeconds - double{times[keyframe]}) / seconds;
  const float* from = valueOf(sampler, keyframe);
  const float* to = valueOf(sampler, keyframe + 1);
  if (sampler.interpolation == Interpolation::cubicSpline) {
    spline(sampler, keyframe, share, seconds, value);
    if (sampler.isRotation) makeUnit(share < 0.5 ? from : to, value);
  } else if (sampler.isRotation) {
    slerp(from, to, share, value);
  } else {
    for (std::size_t i = 0; i < sampler.components; ++i) value[i] = std::lerp(double{from[i]}, double{to[i]}, share);
  }
}

} // namespace gnomon
