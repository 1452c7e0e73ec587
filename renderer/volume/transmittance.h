#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/volume/medium.h"

namespace gnomon {

/// Rays that have no end, one a lane.
struct EndlessRays {
  static constexpr std::size_t kCount = 16;
  alignas(64) double from[3][kCount]; ///< metres, relative to the origin of what they are held against
  float toward[3][kCount];            ///< unit length
  int asked[kCount];                  ///< -1, or 0 for lanes that hold no ray, whose numbers may be any
};

/// What media let through of light from far away, for rays by the million: exp(-optical depth) over the media's
/// ExtinctionCells, in floats, in steps of a cell at most. A homogeneous medium is exact within rounding. What a ray
/// gets does not depend on those in other lanes. Immutable; any thread.
class Transmittance {
 public:
  /// Of the media that cast shadows. `origin`: of the places of rays, in the world.
  Transmittance(std::span<const Medium* const> media, const glm::dvec3& origin);
  ~Transmittance();

  bool empty() const; ///< nothing takes any light

  /// The share that arrives along each ray; 1 for lanes that hold none.
  std::array<float, EndlessRays::kCount> along(const EndlessRays& rays) const;

 private:
  struct Part; ///< a medium
  std::vector<Part> parts_;
};

} // namespace gnomon
