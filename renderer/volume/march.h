#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "renderer/volume/medium.h"

namespace gnomon {

inline constexpr double kStepVoxels = 0.5;

/// What media send along a ray to its origin, and what they let through of the light behind them.
struct Marched {
  glm::dvec3 color{0};
  double transmittance = 1;
};

/// The light at a place (of the unit cube) of one of the media, as its color would scatter it.
using LightAt = std::function<glm::dvec3(std::size_t medium, const glm::dvec3& unit)>;

/// Front to back through all media at once, within a piece of the ray (metres; `to` may be infinite). Where several
/// overlap, each takes and scatters its share. A step is `stepVoxels` of the finest of them long, longer in ways
/// through more than 512 voxels, and ends where a medium begins or ends, so that a homogeneous one is exact at any step
/// (Beer-Lambert). Stops where hardly any light is left: transmittance is then 0.
Marched march(std::span<const Medium* const> media, const Ray& ray, const Interval& piece, const LightAt& lightAt,
              double stepVoxels = kStepVoxels);

/// The integral of the extinction of all media over a piece of the ray: what is let through is exp(-it).
double opticalDepth(std::span<const Medium* const> media, const Ray& ray, const Interval& piece,
                    double stepVoxels = kStepVoxels);

} // namespace gnomon
