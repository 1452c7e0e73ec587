#include <algorithm>
#include <vector>

#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

/// The roots and all below, by their numbers; the nodes need not be trees.
std::vector<bool> reachedFrom(const std::vector<int>& roots, const std::vector<gltf::Node>& nodes) {
  std::vector<bool> reached(nodes.size());
  std::vector<int> open = roots;
  while (!open.empty()) {
    const auto node = static_cast<std::size_t>(open.back());
    open.pop_back();
    if (reached[node]) continue;
    reached[node] = true;
    open.insert(open.end(), nodes[node].children.begin(), nodes[node].children.end());
  }
  return reached;
}

/// Whether any node is above itself or below two others, which is refused later.
bool isNoForest(const std::vector<gltf::Node>& nodes, const std::vector<int>& parents) {
  std::size_t children = 0;
  for (const gltf::Node& node : nodes) children += node.children.size();
  if (children != static_cast<std::size_t>(std::ranges::count_if(parents, [](int parent) { return parent >= 0; }))) {
    return true;
  }
  std::vector<int> roots;
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    if (parents[node] < 0) roots.push_back(static_cast<int>(node));
  }
  return std::ranges::count(reachedFrom(roots, nodes), true) != static_cast<std::ptrdiff_t>(nodes.size());
}

std::vector<int> parentsOf(const std::vector<gltf::Node>& nodes) {
  std::vector<int> parents(nodes.size(), -1);
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    for (const int child : nodes[node].children) parents[static_cast<std::size_t>(child)] = static_cast<int>(node);
  }
  return parents;
}

} // namespace

void settleSceneRoots(gltf::Model& model, const Limits& limits, Findings& findings) {
  const std::vector<int> parents = parentsOf(model.nodes);
  const auto parentOf = [&](int node) { return parents[static_cast<std::size_t>(node)]; };
  const auto listsChild = [&](const gltf::Scene& scene) {
    return std::ranges::any_of(scene.nodes, [&](int node) { return parentOf(node) >= 0; });
  };
  if (std::ranges::none_of(model.scenes, listsChild) || isNoForest(model.nodes, parents)) return;

  std::vector<int> listed;
  for (const gltf::Scene& scene : model.scenes) listed.insert(listed.end(), scene.nodes.begin(), scene.nodes.end());
  const std::vector<bool> drawn = reachedFrom(listed, model.nodes);
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    const std::vector<int>& roots = model.scenes[i].nodes;
    for (std::size_t root = 0; root < roots.size(); ++root) {
      const int parent = parentOf(roots[root]);
      if (parent < 0) continue;
      findings.repair({"A scene lists a node that is a child of another",
                       "it is drawn once, and its parent moves it only where a scene has that one"},
                      pointerTo(pointerTo("/scenes", i) + "/nodes", root), {},
                      "a child of node " + std::to_string(parent));
      if (!drawn[static_cast<std::size_t>(parent)]) {
        std::erase(model.nodes[static_cast<std::size_t>(parent)].children, roots[root]);
      }
    }
  }
  std::size_t placed = 0;
  std::vector<std::size_t> belowOfScene(model.nodes.size()); // below a root of scene n - 1
  for (std::size_t i = 0; i < model.scenes.size(); ++i) {
    if (!listsChild(model.scenes[i])) continue;
    std::vector<int> open = model.scenes[i].nodes;
    while (!open.empty()) {
      if (++placed > limits.maxInstances) return; // refused later
      const auto node = static_cast<std::size_t>(open.back());
      open.pop_back();
      for (const int child : model.nodes[node].children) {
        std::size_t& below = belowOfScene[static_cast<std::size_t>(child)];
        if (below != i + 1) open.push_back(child);
        below = i + 1;
      }
    }
    std::erase_if(model.scenes[i].nodes,
                  [&](int root) { return belowOfScene[static_cast<std::size_t>(root)] == i + 1; });
  }
}

void checkSkinRoots(const gltf::Model& model, const std::vector<int>& parents, const std::vector<int>& order,
                    Findings& findings) {
  std::vector<std::size_t> rootOf(model.nodes.size());
  for (const int index : order) {
    const auto node = static_cast<std::size_t>(index);
    rootOf[node] = parents[node] < 0 ? node : rootOf[static_cast<std::size_t>(parents[node])];
  }
  std::vector<bool> listed(model.nodes.size(), model.scenes.empty());
  for (const gltf::Scene& scene : model.scenes) {
    for (const int root : scene.nodes) listed[rootOf[static_cast<std::size_t>(root)]] = true;
  }
  std::vector<bool> inNoScene(model.skins.size());
  for (std::size_t i = 0; i < model.skins.size(); ++i) {
    const auto rootOfJoint = [&](int joint) { return rootOf[static_cast<std::size_t>(joint)]; };
    const std::vector<int>& joints = model.skins[i].joints;
    inNoScene[i] = std::ranges::any_of(joints, [&](int joint) { return !listed[rootOfJoint(joint)]; });
    if (std::ranges::all_of(joints, [&](int joint) { return rootOfJoint(joint) == rootOfJoint(joints[0]); })) continue;
    findings.repair({"The joints of a skin have no common root", "each moves what it moves"},
                    pointerTo("/skins", i) + "/joints");
  }
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    const int skin = model.nodes[node].skin;
    if (skin < 0 || model.nodes[node].mesh < 0 || !listed[rootOf[node]]) continue;
    if (!inNoScene[static_cast<std::size_t>(skin)]) continue;
    findings.repair({"A scene has a skinned mesh and not its joints", "they move it from where they stand"},
                    pointerTo("/nodes", node) + "/skin");
  }
}

} // namespace gnomon
