#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/report/frame_report.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/core/camera_view.h"
#include "renderer/resolve/resolve_nodes.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A spec settled on a scene.
struct ResolvedFrame {
  FrameSpec spec; ///< effective: every default resolved
  CameraView view;
  int scene = 0; ///< index into Scene::scenes
  std::vector<std::string> warnings;
  std::vector<NodeSwitches> nodes;  ///< one a node of the file; empty = every node has the defaults
  std::vector<VolumePlace> volumes; ///< one a volume of the spec
  LayersInUse layers;
  ReceiverGroups groups;
  /// What technique auto chose, one a light; empty = no light asks for auto. resolveFrame leaves it to
  /// chooseTechniques, as it does not know the device.
  std::vector<std::optional<TechniqueChoice>> choices{};
};

/// The lights of the file, without a frame's shadow.
std::vector<Light> lightsOf(const SceneView& scene);

/// Index into Scene::scenes; -1 where the file does not have that scene or that variant, which is a problem.
int resolveScene(const FrameSpec& spec, const Scene& scene, ProblemList& problems);

/// Fills in what depends on the scene. The spec has passed protocol/validate. All that the scene refuses is added to
/// `problems`; where that is anything, the frame says only what its lights are, and `scene` is -1 if it is the index
/// that the file does not have. `ofEnvironment`: the sun that was found in the frame's environment, if any.
ResolvedFrame resolveFrame(const Scene& scene, const FrameSpec& spec, ProblemList& problems,
                           std::span<const Light> ofEnvironment = {});
Result<ResolvedFrame> resolveFrame(const Scene& scene, const FrameSpec& spec);

} // namespace gnomon
