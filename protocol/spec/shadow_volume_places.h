#pragma once

#include <string>
#include <vector>

#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// Where a spec, as it was asked for, names shadow volumes, which only OpenGL draws. JSON Pointers.
inline std::vector<std::string> placesOfShadowVolumes(const FrameSpec& spec) {
  std::vector<std::string> places;
  if (spec.shadow.technique == ShadowTechnique::shadowVolume) places.emplace_back("/shadow/technique");
  if (!spec.lights) return places;
  for (std::size_t i = 0; i < spec.lights->size(); ++i) {
    const std::optional<Shadow>& own = (*spec.lights)[i].shadow;
    if (own && own->technique == ShadowTechnique::shadowVolume) {
      places.push_back("/lights/" + std::to_string(i) + "/shadow/technique");
    }
  }
  return places;
}

} // namespace gnomon
