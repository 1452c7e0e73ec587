#pragma once

#include <cstdint>
#include <vector>

#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"

namespace gnomon::cpu {

/// What rays say of the lights whose technique is exact, at each sample of the picture.
struct ExactLayers {
  std::vector<UnfilledVector<std::uint16_t>> values; ///< as Layer::values; one a light of FrameWork::layered
  std::vector<LayerFacts> lights;                    ///< parallel

  std::vector<Layer> layers(const DepthBuffer& surfaces) const;
};

/// `surfaces`: numbered. Rays decide all of it, those of technique hybrid too: on a processor they take less time than
/// a map that spares some of them.
Result<ExactLayers> exactLayers(const CameraRaster& camera, const FrameWork& work, const Survey& survey,
                                const DepthBuffer& surfaces);

} // namespace gnomon::cpu
