#include "renderer/cpu/volume_layers.h"

#include "renderer/core/parallel.h"
#include "renderer/cpu/raster/raster.h"
#include "renderer/volume/volume_picture.h"

namespace gnomon::cpu {
namespace {

/// The places of a pixel's samples, and what they show.
struct Seen {
  std::vector<glm::vec2> places;
  SeenSurfaces surfaces;

  Seen(const CameraView& view, const DepthBuffer& buffer, const VolumeLayers& layers) {
    for (const glm::ivec2& place : samplePlaces(buffer.samples)) places.push_back(glm::vec2(place) / 256.0f);
    surfaces = {view, buffer.width, buffer.height, places, layers.depths};
  }
};

} // namespace

VolumeLayers volumeLayers(const CameraView& view, const DepthBuffer& surfaces) {
  const auto samples = static_cast<std::size_t>(surfaces.samples);
  const auto width = static_cast<std::size_t>(surfaces.width);
  VolumeLayers layers;
  layers.depths.resize(width * static_cast<std::size_t>(surfaces.height) * samples);
  forEach(static_cast<std::size_t>(surfaces.height), [&](std::size_t y) {
    for (std::size_t i = 0; i < width * samples; ++i) {
      const std::size_t place =
          surfaces.at(static_cast<int>(i / samples), static_cast<int>(y), static_cast<int>(i % samples));
      layers.depths[y * width * samples + i] = seenDepth(view, surfaces.depths[place]);
    }
  });
  return layers;
}

void addPicture(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces,
                VolumeLayers& layers) {
  const Seen seen(view, surfaces, layers);
  layers.picture = marchPicture(seen.surfaces, volumes.mapped(), volumes.ambient);
}

void addShadow(const FrameVolumes& volumes, const CameraView& view, const DepthBuffer& surfaces, VolumeLayers& layers) {
  const Seen seen(view, surfaces, layers);
  layers.shadow = volumeShadowPicture(seen.surfaces, volumes.mapped(), volumes.towards);
  layers.shadow.push_back(65535); // as Layer wants it
}

} // namespace gnomon::cpu
