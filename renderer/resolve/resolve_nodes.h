#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The switches of every node of the file, by its index: of each switch the nearest entry up the tree counts, and of
/// two entries for one node the later. Empty where there are no entries and no ground, which casts nothing: every node
/// has the defaults. An entry that finds no node is a problem at /nodes/i/node.
Result<std::vector<NodeSwitches>> resolveNodes(std::span<const NodeOptions> entries, const Scene& scene);

/// The layers that some instance of a scene casts or receives in. `view`: one of the scene's; `nodes`: as resolveNodes
/// gives them.
LayersInUse layersInUse(const Scene& scene, const SceneView& view, std::span<const NodeSwitches> nodes);

/// One an instance of the view: 1 where it is seen and receives shadows.
std::vector<std::uint8_t> receivingInstances(const Scene& scene, const SceneView& view,
                                             std::span<const NodeSwitches> nodes);

/// The receiver groups of what is visible in a scene. More than there may be are a problem at /nodes.
Result<ReceiverGroups> resolveReceiverGroups(const Scene& scene, const SceneView& view,
                                             std::span<const NodeSwitches> nodes, std::span<const Light> lights);

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
