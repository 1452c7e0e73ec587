#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// What is known of the lights whose shadow rays find: now, at each sample of the picture, or when it was baked.
struct ExactLayers {
  /// Of one light: `values` as Layer::values, empty where there is a map.
  struct Known {
    UnfilledVector<std::uint16_t> values;
    std::optional<BakedMap> map;
  };
  std::vector<Known> known;       ///< one a light of FrameWork::layered
  std::vector<LayerFacts> lights; ///< those that rays were sent for

  std::size_t bytes() const; ///< of what was found for this picture
  std::vector<Layer> layers(const DepthBuffer& surfaces) const;
};

/// `surfaces`: numbered, and left as they are. What is baked is used in place; rays decide the rest.
Result<ExactLayers> exactLayers(const CameraRaster& camera, const FrameWork& work, const Survey& survey,
                                DepthBuffer& surfaces);

} // namespace gnomon::cpu
