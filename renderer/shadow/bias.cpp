#include "renderer/shadow/bias.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kFloatRounding = 0x1p-24; ///< of a float operation, relative; also the step of floats below 1
constexpr double kSubpixel = 1.0 / 32.0;   ///< texels

} // namespace

FilterKernel kernelOf(const Filter& filter) {
  const int size = filter.type == FilterType::pcf ? filter.size : 1;
  const double reach = 0.5 * (size + 1);
  return {reach, static_cast<int>(std::ceil(reach)) + 1};
}

double biasReach(const FilterKernel& kernel) {
  return kernel.reach + kSubpixel + kTexelNoise;
}

double finestTexel(double magnitude) {
  return 4.0 * kFloatRounding / kTexelNoise * magnitude;
}

double normalOffset(double reach, const glm::dvec2& texelSize) {
  return reach * std::hypot(texelSize.x, texelSize.y);
}

double punctualNormalOffset(double reach, const glm::dvec2& texelSize) {
  const double c = std::min(normalOffset(reach, texelSize), 0.5);
  return c / (1.0 - c);
}

double depthRounding(double magnitude) {
  return 2.0 * 5.0 * kFloatRounding * 2.0 * magnitude;
}

double depthBias(double magnitude, double depthExtent) {
  return kFloatRounding + depthRounding(magnitude) / depthExtent;
}

double punctualDepthQuantum() {
  return 4.0 * kFloatRounding;
}

} // namespace gnomon
