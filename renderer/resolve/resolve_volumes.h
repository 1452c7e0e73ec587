#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/volume_options.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// Visibility and shadows of a volume, by its node.
struct VolumePlace {
  std::optional<glm::dmat4> worldFromNode{}; ///< nothing = it is placed in the world
  bool visible = true;                       ///< to the camera
  bool castShadow = true;
  bool receiveShadow = true;

  /// Without any effect on the picture.
  bool hidden() const { return !visible && !castShadow; }
  bool operator==(const VolumePlace&) const = default;
};

/// One a volume. A node that the scene of the frame does not have, or a name that several have, is a problem at
/// /volumes/i/node. `view`: that scene. `nodes`: as resolveNodes gives them.
Result<std::vector<VolumePlace>> resolveVolumes(std::span<const VolumeOptions> volumes, const Scene& scene,
                                                const SceneView& view, std::span<const NodeSwitches> nodes);

} // namespace gnomon
