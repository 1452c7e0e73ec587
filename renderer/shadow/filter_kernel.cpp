#include "renderer/shadow/filter_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/spec/enum_rows.h"
#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

/// How a filter reads the map.
struct FilterReading {
  FilterType type;
  MapReadingKind bySize;   ///< where a size in texels is given
  MapReadingKind byRadius; ///< the same for a radius in metres
};

constexpr std::array kFilterReadings{
    FilterReading{FilterType::hard, MapReadingKind::texels, MapReadingKind::texels},
    FilterReading{FilterType::pcf, MapReadingKind::texels, MapReadingKind::disc},
    FilterReading{FilterType::vsm, MapReadingKind::vsm, MapReadingKind::vsm},
    FilterReading{FilterType::evsm, MapReadingKind::evsm, MapReadingKind::evsm},
    FilterReading{FilterType::msm, MapReadingKind::msm, MapReadingKind::msm},
    FilterReading{FilterType::pcss, MapReadingKind::pcss, MapReadingKind::pcss},
};
static_assert(rowsAreComplete(kFilterReadings, &FilterReading::type));

constexpr double kFloatRounding = 0x1p-24; ///< of a float operation, relative; also the step of floats below 1

} // namespace

FilterKernel kernelOf(const Filter& filter, double lightRadius) {
  const FilterTraits& traits = traitsOf(filter.type);
  const FilterReading& reading = kFilterReadings[static_cast<std::size_t>(filter.type)];
  FilterKernel kernel;
  kernel.moments = traits.moments;
  if (traits.sized && filter.radius) {
    kernel.kind = reading.byRadius;
    kernel.radius = *filter.radius;
  } else {
    kernel.kind = reading.bySize;
    kernel.size = traits.sized ? filter.size : 1;
  }
  if (kernel.kind == MapReadingKind::pcss) {
    kernel.lightRadius = lightRadius;
    if (!(lightRadius > 0)) kernel.kind = MapReadingKind::texels;
  }
  kernel.reach = 0.5 * (kernel.size + 1);
  kernel.border = static_cast<int>(std::ceil(kernel.reach)) + 1;
  return kernel;
}

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
