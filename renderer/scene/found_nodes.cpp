#include "renderer/scene/found_nodes.h"

#include <algorithm>
#include <utility>

#include "protocol/base/text.h"

namespace gnomon {

std::string nodeNames(const Scene& scene) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < fileNodes(scene); ++i) {
    if (!scene.nodes[i].name.empty()) names.push_back(scene.nodes[i].name);
  }
  return names.empty() ? "no node has a name" : oneOf(names);
}

Problem noNodeOfIndex(int index, const Scene& scene, std::string pointer) {
  return {ProblemCode::invalidValue, std::move(pointer), "The file has no node of that index.",
          fileNodes(scene) == 0 ? "the file has no nodes" : "0.." + std::to_string(fileNodes(scene) - 1),
          std::to_string(index)};
}

Result<std::vector<std::size_t>> NodeFinder::find(const std::variant<int, std::string>& node,
                                                  const std::string& pointer) {
  if (const int* index = std::get_if<int>(&node)) {
    if (*index < 0 || static_cast<std::size_t>(*index) >= fileNodes(scene_)) {
      return noNodeOfIndex(*index, scene_, pointer);
    }
    return std::vector{static_cast<std::size_t>(*index)};
  }
  if (!byName_) {
    byName_.emplace();
    for (std::size_t i = 0; i < fileNodes(scene_); ++i) byName_->emplace(scene_.nodes[i].name, i);
  }
  const std::string& name = std::get<std::string>(node);
  const auto [first, last] = byName_->equal_range(name);
  std::vector<std::size_t> found;
  std::transform(first, last, std::back_inserter(found), [](const auto& each) { return each.second; });
  if (!found.empty()) return found;
  return Problem{ProblemCode::invalidValue, pointer, "The file has no node of that name.", nodeNames(scene_), name};
}

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
