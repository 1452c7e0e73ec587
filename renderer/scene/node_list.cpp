#include "renderer/scene/node_list.h"

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t kNameBytes = 4 << 20; ///< a page with more of them ends

/// Triangles that each node places, by index, in the scene that shows the most of it.
std::vector<std::uint64_t> trianglesOfNodes(const Scene& scene) {
  std::vector<std::uint64_t> most(scene.nodes.size());
  for (int file = 0; file < fileScenes(scene); ++file) {
    std::vector<std::uint64_t> here(scene.nodes.size());
    for (const Instance& instance : scene.scenes[static_cast<std::size_t>(file)].instances) {
      here[static_cast<std::size_t>(instance.node)] +=
          scene.primitives[static_cast<std::size_t>(instance.primitive)].indexCount / 3;
    }
    for (std::size_t i = 0; i < most.size(); ++i) most[i] = std::max(most[i], here[i]);
  }
  return most;
}

} // namespace

NodeList nodesOf(const Scene& scene, const NodePage& page) {
  const std::vector<std::uint64_t> triangles = trianglesOfNodes(scene);
  NodeList list;
  std::size_t nameBytes = 0;
  for (std::size_t i = static_cast<std::size_t>(page.after + 1); i < scene.nodes.size(); ++i) {
    if (list.nodes.size() == static_cast<std::size_t>(page.limit) || nameBytes > kNameBytes) {
      list.next = list.nodes.back().node;
      break;
    }
    const SceneNode& node = scene.nodes[i];
    nameBytes += node.name.size();
    list.nodes.push_back(
        {static_cast<int>(i), node.name, node.parent < 0 ? std::nullopt : std::optional(node.parent), triangles[i]});
  }
  return list;
}

} // namespace gnomon
