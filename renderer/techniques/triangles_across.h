#pragma once

#include <array>

#include "renderer/techniques/picture_points.h"

namespace gnomon {

/// What the triangles that a few pixels side by side show see of a light, where one answer holds for all of a triangle.
class TrianglesAcross {
 public:
  TrianglesAcross(const PicturePoints& points, const TracedLight& light) : points_(points), light_(light) {
    numbers_.fill(kNoNumber);
  }

  /// REQUIRES: the number of a triangle that is shown.
  LightAcross of(std::uint32_t number) {
    if (!light_.knowsTriangles()) return LightAcross::unsure;
    const std::size_t at = number % kRemembered;
    if (numbers_[at] != number) {
      numbers_[at] = number;
      across_[at] = light_.across(points_.placed(number));
    }
    return across_[at];
  }

 private:
  static constexpr std::size_t kRemembered = 8;

  const PicturePoints& points_;
  const TracedLight& light_;
  std::array<std::uint32_t, kRemembered> numbers_; ///< by their last bits
  std::array<LightAcross, kRemembered> across_;
};

} // namespace gnomon
