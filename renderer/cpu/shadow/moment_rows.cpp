#include "renderer/cpu/shadow/moment_rows.h"

#include <algorithm>
#include <cmath>

#include "renderer/shaders/shared/frame_types.h"

namespace gnomon::cpu {
namespace {

constexpr std::size_t kPacket = 16;

std::size_t wholePackets(std::size_t count) {
  return (count + kPacket - 1) / kPacket * kPacket;
}

} // namespace

BoxTaps boxTaps(float texels) {
  const int stride = std::max(1, static_cast<int>(std::ceil((2.0f * texels + 1.0f) / GNOMON_BLUR_TAPS)));
  const int reach = static_cast<int>(std::ceil(texels)) / stride + 1;
  BoxTaps taps;
  taps.stride = static_cast<std::size_t>(stride);
  for (int i = -reach; i <= reach; ++i) {
    taps.weights.push_back(std::clamp(texels + 1.0f - static_cast<float>(std::abs(i * stride)), 0.0f, 1.0f));
    taps.sum += taps.weights.back();
  }
  // Ends that weigh nothing are not read.
  while (taps.weights.size() > 1 && taps.weights.front() == 0.0f) {
    taps.weights.erase(taps.weights.begin());
    taps.weights.pop_back();
  }
  return taps;
}

MomentWindow::MomentWindow(const TexelBox& box, const BoxTaps& alongX, const BoxTaps& alongY, std::size_t moments)
    : width(wholePackets(static_cast<std::size_t>(box.width))),
      sourceWidth(wholePackets(width + 2 * alongX.reach())),
      rows(static_cast<std::size_t>(box.height) + 2 * alongY.reach()),
      depths(sourceWidth),
      row(moments, std::vector<float>(sourceWidth)),
      along(moments, std::vector<float>(rows * width)) {}

} // namespace gnomon::cpu
