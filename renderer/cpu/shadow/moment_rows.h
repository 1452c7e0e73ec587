#pragma once

#include <cstddef>
#include <vector>

namespace gnomon::cpu {

/// One direction of a box blur: texels `stride` apart, the middle one in the middle, and what each weighs. Most weigh
/// 1, which rounds nothing; moments bear little.
struct BoxTaps {
  std::size_t stride = 1;
  std::vector<float> weights; ///< an odd number of them
  float sum = 0;              ///< of the weights

  /// Texels to each side.
  std::size_t reach() const { return weights.size() / 2 * stride; }
};

/// `texels`: to each side that the box takes whole; the next ones get what is left of it.
BoxTaps boxTaps(float texels);

/// A row of texels while it is blurred, a moment after the other.
struct MomentRow {
  std::size_t width = 0;                   ///< whole packets of lanes
  std::vector<float> depths;               ///< of one sample
  std::vector<std::vector<float>> moments; ///< with as many texels before and behind as the blur reaches

  MomentRow(std::size_t width, std::size_t reach, std::size_t momentCount);
};

/// Rows of moments, each moment by itself.
struct MomentPlanes {
  std::size_t width = 0; ///< whole packets of lanes
  int height = 0;
  std::vector<std::vector<float>> planes;

  MomentPlanes(int texelsAcross, int height, std::size_t momentCount);
  float* row(std::size_t moment, int y) { return planes[moment].data() + static_cast<std::size_t>(y) * width; }
  const float* row(std::size_t moment, int y) const {
    return planes[moment].data() + static_cast<std::size_t>(y) * width;
  }
};

} // namespace gnomon::cpu
