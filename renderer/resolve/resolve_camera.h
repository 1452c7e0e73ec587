#pragma once

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/resolve/framing.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A camera with nothing left open, and the same as the renderer uses it.
struct ResolvedCamera {
  /// A pose, as it was asked for, or else lookAt; and one lens. All set: asking for it again gives the same view, bit
  /// for bit.
  Camera camera;
  CameraView view;
};

/// Settles a camera on a scene and a picture of `size` pixels; what an orbit frames is `seen`, by default the box of
/// the scene. A pose keeps its view axis; the others are made perpendicular to it. Problems: a camera that the scene
/// does not have at /camera/node; at /camera/orbit/distance an orbit without one whose lens shows the whole scene from
/// no distance.
Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, const glm::ivec2& size,
                                     const FramedSubject& seen);
Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, const glm::ivec2& size);

} // namespace gnomon
