#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/cpu/camera_survey.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/device/device.h"
#include "renderer/techniques/picture_points.h"
#include "renderer/volume/volume_light.h"

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

/// The samples of a picture's surfaces, and what they show, which are numbered.
SampleGrid gridOf(const DepthBuffer& surfaces);
ShownNumbers shownNumbers(const DepthBuffer& surfaces);

/// `surfaces`: numbered, and left as they are. What is baked is used in place; rays decide the rest.
Result<ExactLayers> exactLayers(const CameraRaster& camera, const FrameWork& work, const Survey& survey,
                                DepthBuffer& surfaces);

/// What volumes are to a picture. Made for the surfaces of one number of samples a pixel.
struct VolumeLayers {
  std::vector<float> depths;         ///< SeenSurfaces::depths
  std::vector<glm::vec4> picture;    ///< marchPicture; empty until a view asks for it
  std::vector<std::uint16_t> shadow; ///< as Layer::values; empty until a view asks for it
};

/// The depths alone.
VolumeLayers volumeLayers(const CameraView& view, const DepthBuffer& surfaces);

void addPicture(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces, VolumeLayers& layers);
void addShadow(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces, VolumeLayers& layers);

} // namespace gnomon::cpu
