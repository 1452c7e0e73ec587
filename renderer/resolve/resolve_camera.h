#pragma once

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A camera with nothing left open, and the same as the renderer uses it.
struct ResolvedCamera {
  Camera camera; ///< lookAt and one lens, all set: asking for it again gives the same view, bit for bit
  CameraView view;
};

/// Settles a camera on a scene. `aspect` = width / height. A node that has no camera is a problem at /camera/node.
Result<ResolvedCamera> resolveCamera(const Camera& camera, const SceneView& scene, double aspect);

} // namespace gnomon
