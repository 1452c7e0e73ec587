#pragma once

#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/scene_options.h"
#include "renderer/scene/node_switches.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The switches of every node of the file, by its index: of each switch the nearest entry up the tree counts, and of
/// two entries for one node the later. Empty where there are no entries: every node has the defaults. An entry that
/// finds no node is a problem at /nodes/i/node.
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

} // namespace gnomon
