#include "renderer/passes/node_switches.h"

#include <algorithm>

namespace gnomon {

bool ReceiverGroups::matter() const {
  return std::any_of(ofLight.begin(), ofLight.end(), [](const LitGroups& groups) { return groups != LitGroups{}; });
}

void keepNodes(std::span<const NodeSwitches> nodes, const SceneView& view, const FrameGeometry& geometry,
               const std::function<bool(const NodeSwitches&)>& pass, std::vector<std::uint8_t>& slots) {
  if (nodes.empty() && pass(NodeSwitches{})) return;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    const auto node = static_cast<std::size_t>(view.instances[i].node);
    if (pass(nodes.empty() ? NodeSwitches{} : nodes[node])) continue;
    std::fill(slots.begin() + geometry.firstSlot[i], slots.begin() + geometry.firstSlot[i + 1], 0);
  }
}

} // namespace gnomon
