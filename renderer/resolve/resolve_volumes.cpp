#include "renderer/resolve/resolve_volumes.h"

#include <algorithm>
#include <string>

#include "renderer/core/collect.h"
#include "renderer/core/flat_transform.h"
#include "renderer/scene/found_nodes.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {
namespace {

bool isInView(const Scene& scene, const SceneView& view, std::size_t node) {
  while (scene.nodes[node].parent >= 0) node = static_cast<std::size_t>(scene.nodes[node].parent);
  return std::find(view.roots.begin(), view.roots.end(), static_cast<int>(node)) != view.roots.end();
}

Result<std::size_t> nodeOfIndex(int index, const Scene& scene, const SceneView& view, const std::string& pointer) {
  const auto node = static_cast<std::size_t>(index);
  if (node >= scene.nodes.size()) return noNodeOfIndex(index, scene, pointer);
  if (isInView(scene, view, node)) return node;
  return Problem{ProblemCode::invalidValue, pointer, "That node is not in the scene of this frame.", "",
                 std::to_string(index)};
}

Result<std::size_t> nodeOfName(const std::string& name, const Scene& scene, const SceneView& view,
                               const std::string& pointer) {
  std::vector<std::size_t> found;
  for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
    if (scene.nodes[node].name == name && isInView(scene, view, node)) found.push_back(node);
  }
  if (found.empty()) {
    return Problem{ProblemCode::invalidValue, pointer, "The scene of this frame has no node of that name.",
                   nodeNames(scene), name};
  }
  if (found.size() == 1) return found.front();
  return Problem{ProblemCode::invalidValue, pointer, "Several nodes have that name; give an index.",
                 std::to_string(found[0]) + " | " + std::to_string(found[1]) + (found.size() > 2 ? " | ..." : ""),
                 name};
}

VolumePlace placeAt(std::size_t node, const Scene& scene, std::span<const NodeSwitches> nodes) {
  const PlacedNode placed = scene.placedNodes.empty() ? PlacedNode{} : scene.placedNodes[node];
  const NodeSwitches switches = switchesOf(nodes, static_cast<int>(node));
  const bool there = !placed.hidden && !isFlat(placed.worldFromNode);
  return {placed.worldFromNode, there && switches.visible, there && switches.castShadow, switches.receiveShadow};
}

} // namespace

Result<std::vector<VolumePlace>> resolveVolumes(std::span<const VolumeOptions> volumes, const Scene& scene,
                                                const SceneView& view, std::span<const NodeSwitches> nodes) {
  std::vector<VolumePlace> places;
  ProblemList problems;
  for (std::size_t i = 0; i < volumes.size(); ++i) {
    places.emplace_back();
    if (!volumes[i].node) continue;
    const std::string pointer = "/volumes/" + std::to_string(i) + "/node";
    const int* index = std::get_if<int>(&*volumes[i].node);
    const auto node =
        collect(index != nullptr ? nodeOfIndex(*index, scene, view, pointer)
                                 : nodeOfName(std::get<std::string>(*volumes[i].node), scene, view, pointer),
                problems);
    if (node) places.back() = placeAt(*node, scene, nodes);
  }
  if (!problems.empty()) return std::move(problems).take();
  return places;
}

} // namespace gnomon
