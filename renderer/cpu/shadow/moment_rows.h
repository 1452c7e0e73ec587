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

struct MomentTaps {
  BoxTaps x, y;
};

/// Texels from the lower left one, x0 y0.
struct TexelBox {
  int x0 = 0, y0 = 0;
  int width = 0, height = 0;
};

/// What a box of texels is blurred in: moments, each by itself. Rows begin as far before the box as the blur reaches,
/// and end as far behind it.
struct MomentWindow {
  std::size_t width;                     ///< of the box, whole packets of lanes
  std::size_t sourceWidth;               ///< of a row before it is blurred, whole packets of lanes
  std::size_t rows;                      ///< of the box and beyond
  std::vector<float> depths;             ///< a row, of one sample
  std::vector<std::vector<float>> row;   ///< a row before it is blurred, by moment
  std::vector<std::vector<float>> along; ///< rows blurred along x, by moment

  MomentWindow(const TexelBox& box, const BoxTaps& alongX, const BoxTaps& alongY, std::size_t moments);
  float* alongRow(std::size_t moment, std::size_t y) { return along[moment].data() + y * width; }
  const float* alongRow(std::size_t moment, std::size_t y) const { return along[moment].data() + y * width; }
};

} // namespace gnomon::cpu
