#include "tests/support/compare_images.h"

#include <algorithm>
#include <cstdlib>

namespace gnomon::testing {
namespace {

const std::vector<std::uint8_t>& texels(const Image& image) {
  return std::get<std::vector<std::uint8_t>>(image.pixels);
}

int pixelDifference(const Image& a, const Image& b, std::size_t pixel) {
  int worst = 0;
  for (std::size_t c = 0; c < 4; ++c)
    worst = std::max(worst, std::abs(texels(a)[pixel * 4 + c] - texels(b)[pixel * 4 + c]));
  return worst;
}

} // namespace

ImageDifference compareImages(const Image& a, const Image& b) {
  ImageDifference difference;
  difference.sameSize = a.width == b.width && a.height == b.height && texels(a).size() == texels(b).size();
  if (!difference.sameSize) return difference;
  double sum = 0;
  for (std::size_t i = 0; i < texels(a).size(); ++i) {
    const int delta = std::abs(texels(a)[i] - texels(b)[i]);
    sum += delta;
    if (delta <= difference.max) continue;
    difference.max = delta;
    const int pixel = static_cast<int>(i / 4);
    difference.worstX = pixel % a.width;
    difference.worstY = pixel / a.width;
  }
  difference.mean = texels(a).empty() ? 0 : sum / static_cast<double>(texels(a).size());
  return difference;
}

double shareBeyond(const Image& a, const Image& b, int levels) {
  const std::size_t pixels = texels(a).size() / 4;
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) count += pixelDifference(a, b, pixel) > levels ? 1 : 0;
  return pixels == 0 ? 0 : static_cast<double>(count) / static_cast<double>(pixels);
}

Image differenceMap(const Image& a, const Image& b) {
  Image map{a.width, a.height, {"R", "G", "B", "A"}, {}};
  std::vector<std::uint8_t> out(texels(a).size());
  for (std::size_t pixel = 0; pixel < out.size() / 4; ++pixel) {
    const int delta = std::min(255, 8 * pixelDifference(a, b, pixel));
    const auto grey = static_cast<std::uint8_t>(texels(a)[pixel * 4 + 1] / 4);
    out[pixel * 4] = delta > 0 ? 255 : grey;
    out[pixel * 4 + 1] = delta > 0 ? static_cast<std::uint8_t>(255 - delta) : grey;
    out[pixel * 4 + 2] = delta > 0 ? std::uint8_t{0} : grey;
    out[pixel * 4 + 3] = 255;
  }
  map.pixels = std::move(out);
  return map;
}

} // namespace gnomon::testing
