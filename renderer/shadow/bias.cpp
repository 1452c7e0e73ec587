#include "renderer/shadow/bias.h"

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

constexpr double kFloatRounding = 0x1p-24; ///< of a float operation, relative; also the step of floats below 1

} // namespace

double biasReach(const FilterKernel& kernel) {
  return kBiasReach + (kernel.moments ? kernel.reach : 0.0);
}

double radiusOffset(const FilterKernel& kernel) {
  return kernel.moments ? std::sqrt(2.0) * kernel.radius : 0.0;
}

double finestTexel(double magnitude) {
  return 4.0 * kFloatRounding / kTexelNoise * magnitude;
}

double normalOffset(double reach, const glm::dvec2& texelSize) {
  return reach * std::hypot(texelSize.x, texelSize.y);
}

double punctualNormalOffset(double reach, const glm::dvec2& texelSize, double radiusOffset) {
  const double c = std::min(normalOffset(reach, texelSize) + radiusOffset, 0.5);
  return c / (1.0 - c);
}

std::optional<double> manualOffset(const Bias& bias) {
  if (bias.mode == BiasMode::automatic) return std::nullopt;
  return bias.depth.value_or(0.0) * bias.normalOffsetScale.value_or(0.0);
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
