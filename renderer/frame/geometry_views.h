#pragma once

#include <vector>

#include "protocol/spec/format_traits.h"
#include "renderer/core/camera_view.h"
#include "renderer/image/image.h"
#include "renderer/scene/scene.h"

/// Views of what each pixel's centre shows: numbers that come from the scene alone, in double precision, whatever
/// device found the triangles.
namespace gnomon {

/// The triangles that a camera sees; first row on top.
struct ShownGeometry {
  const Scene& scene;
  const SceneView& view;
  const CameraView& camera;
  int width = 0; ///< pixels
  int height = 0;
  std::vector<PlacedTriangle> triangles{};
};

/// A view of source `geometry`, as View says: numbers, or what they are seen as.
Image geometryView(const ShownGeometry& shown, View view, PixelType pixels);

/// Where the ray through a place on the picture (pixels, from the upper left corner) meets the plane of a triangle, in
/// the world. Infinite where it does not.
glm::dvec3 seenPoint(const ShownGeometry& shown, const PlacedTriangle& triangle, glm::dvec2 place);

} // namespace gnomon
