#pragma once

#include <array>
#include <vector>

#include "protocol/spec/traits.h"
#include "renderer/core/camera_view.h"
#include "renderer/image/image.h"
#include "renderer/rays/trace.h"
#include "renderer/scene/scene.h"

/// Views of what each pixel's centre shows: numbers that come from the scene alone, in double precision, whatever
/// device found the triangles.
namespace gnomon {

struct EarlierMoment;

/// The triangles that a camera sees; first row on top.
struct ShownGeometry {
  const Scene& scene;
  const SceneView& view;
  const CameraView& camera;
  int width = 0; ///< pixels
  int height = 0;
  std::vector<PlacedTriangle> triangles{};
  const EarlierMoment* earlier = nullptr; ///< what view motion compares with; needed by that alone
};

/// A hue for each index, far from those of its neighbours: steps of the golden ratio. Black for -1.
glm::vec3 colorOf(int id);

/// A view of source `geometry`, as View says: numbers, or what they are seen as.
Image geometryView(const ShownGeometry& shown, View view, PixelType pixels);

/// The corners of a triangle of an instance, relative to `eye`.
std::array<glm::dvec3, 3> cornersOf(const Scene& scene, const Instance& instance, std::uint32_t triangle,
                                    const glm::dvec3& eye);

/// How much each corner counts in the point where the ray through a place on the picture meets the plane of a triangle;
/// their sum is 1. Of a triangle that is seen edge-on, the first alone. REQUIRES: there is a triangle.
glm::dvec3 seenWeights(const ShownGeometry& shown, const PlacedTriangle& triangle, glm::dvec2 place);

inline glm::dvec3 pointOf(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& weights) {
  return corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z;
}

/// What each pixel's centre shows, as rays meet it. `rays`: of the frame that `shown` is of.
std::vector<SurfacePoint> shownPoints(const ShownGeometry& shown, const TraceInput& rays);

/// View casterIds of a light whose shadow no map decides, by rays from what each pixel's centre shows: nodes, one a
/// pixel; -1 where none casts a shadow: see casterInstances. `rays`: of the frame that `shown` is of.
std::vector<int> casterNodes(const ShownGeometry& shown, const TraceInput& rays, int light);

/// The nodes as numbers; or each as its color, and what none shadows as grey, the lighter the more it faces the eye.
Image casterView(const ShownGeometry& shown, const std::vector<int>& nodes, PixelType pixels);

} // namespace gnomon
