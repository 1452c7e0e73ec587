#pragma once

#include <memory>
#include <vector>

#include "renderer/volume/volume_light.h"

namespace gnomon {

/// The volumes of a frame, with the light in them.
struct FrameVolumes {
  std::vector<std::shared_ptr<const Medium>> media;
  std::vector<std::shared_ptr<const VolumeLight>> lights; ///< parallel
  int light = -1;        ///< the frame's light that they shade surfaces from, a directional one; -1 = none
  glm::dvec3 towards{0}; ///< that light, unit length
  glm::dvec3 ambient{0}; ///< radiance from all around

  bool empty() const { return media.empty(); }
  std::vector<MappedMedium> mapped() const {
    std::vector<MappedMedium> all;
    for (std::size_t i = 0; i < media.size(); ++i) all.push_back({media[i].get(), lights[i].get()});
    return all;
  }
};

} // namespace gnomon
