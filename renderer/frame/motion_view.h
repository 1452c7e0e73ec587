#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/frame/geometry_views.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The moment that view `motion` compares a frame with.
struct EarlierMoment {
  std::shared_ptr<const Scene> scene; ///< posed as it was then
  int index = 0;                      ///< into Scene::scenes
  CameraView camera;
  Camera settledCamera;                 ///< the same with nothing left open
  std::vector<std::uint32_t> instances; ///< of each instance of the frame the one then; kNoSurface = it was not there
};

/// The frame's scene and camera with what `motionFrom` says instead. `now`: the frame's camera with nothing left open;
/// `view`: what the frame shows; `ground`: the frame's, which does not move. Problems point into /motionFrom where that
/// gives what is wrong. REQUIRES: the spec, as it was asked, has motionFrom.
Result<EarlierMoment> earlierMoment(const std::shared_ptr<const Scene>& loaded, const FrameSpec& asked,
                                    const Camera& now, const SceneView& view,
                                    const std::optional<GroundPlane>& ground = std::nullopt);

/// By how much the point of a triangle that a place on the picture (pixels, from the upper left corner) shows has moved
/// in the picture: pixels, x to the right, y down. Infinite where there is no triangle, where it was not there, or
/// where the point was not before the camera.
glm::dvec2 motionAt(const ShownGeometry& shown, const EarlierMoment& earlier, const PlacedTriangle& triangle,
                    glm::dvec2 place);

} // namespace gnomon
