#pragma once

#include <cstdint>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/volume/volume_light.h"

namespace gnomon::cpu {

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
