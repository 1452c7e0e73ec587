#include "renderer/scene/graph/scene_views.h"

#include <algorithm>

#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/reach.h"

namespace gnomon {

namespace {

class Flattening {
 public:
  Flattening(const LoadContext& load, const LoadedMeshes& loaded, bool animated)
      : load_(load), loaded_(loaded), tree_(loaded.tree), findings_(load.findings), animated_(animated) {}

  std::vector<int> roots() const {
    std::vector<int> roots;
    for (std::size_t node = 0; node < tree_.parents.size(); ++node) {
      if (tree_.parents[node] < 0) roots.push_back(static_cast<int>(node));
    }
    return roots;
  }

  void flatten(const std::vector<int>& roots, const std::string& pointer) {
    SceneView& view = scenes_.views.emplace_back();
    view.roots = roots;
    scenes_.moving.emplace_back();
    const std::vector<int> nodes = reachedFrom(roots);
    for (const int node : nodes) {
      if (findings_.refused()) return;
      place(static_cast<std::size_t>(node), view, pointer);
    }
  }

  FlatScenes take() { return std::move(scenes_); }

 private:
  /// The nodes below the roots, ascending. The nodes are trees, so none is met twice.
  std::vector<int> reachedFrom(const std::vector<int>& roots) {
    std::vector<int> nodes = roots;
    for (std::size_t i = 0; i < nodes.size() && count(1, 1, "/scenes"); ++i) {
      const auto& children = load_.document.model.nodes[static_cast<std::size_t>(nodes[i])].children;
      nodes.insert(nodes.end(), children.begin(), children.end());
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  /// What hangs on a node is kept for every pose, also where that at rest leaves it out.
  void place(std::size_t node, SceneView& view, const std::string& pointer) {
    const gltf::Node& source = load_.document.model.nodes[node];
    if (source.mesh >= 0 && (animated_ || !tree_.hidden[node])) placeMesh(node, view, pointer);
    if (const auto camera = cameraAt(load_.document.model, node, findings_)) {
      scenes_.moving.back().cameras.push_back(*camera);
      if (auto placed = placedAt(tree_.worldFromUnscaled[node], camera->camera)) {
        view.cameras.push_back(*std::move(placed));
      } else {
        warnOfNoScale("camera", node);
      }
    }
    if (const auto light = lightAt(load_.document.model, node, findings_)) {
      scenes_.moving.back().lights.push_back(*light);
      if (tree_.hidden[node]) return;
      if (auto placed = placedAt(tree_.worldFromUnscaled[node], light->light)) {
        view.lights.push_back(*std::move(placed));
      } else {
        warnOfNoScale("light", node);
      }
    }
  }

  void warnOfNoScale(const char* what, std::size_t node) {
    findings_.warn("The " + std::string(what) + " at node " + std::to_string(node) +
                   " has a degenerate transform and is left out.");
  }

  void addPlacements(std::size_t node, int skin, int copy, const glm::dmat4& nodeFromCopy,
                     const std::vector<int>& primitives) {
    for (const int primitive : primitives) {
      scenes_.moving.back().placements.push_back({static_cast<int>(node), primitive, skin, copy, nodeFromCopy});
    }
  }

  void placeMesh(std::size_t node, SceneView& view, const std::string& pointer) {
    const BuiltMesh& mesh = loaded_.meshes[static_cast<std::size_t>(load_.document.model.nodes[node].mesh)];
    std::vector<int> primitives = mesh.primitives;
    primitives.insert(primitives.end(), loaded_.posed[node].followingNode.begin(),
                      loaded_.posed[node].followingNode.end());
    const auto instancing = instancingOf(load_, node);
    if (findings_.refused()) return;
    if (!loaded_.posed[node].followingSkin.empty()) {
      if (instancing) {
        findings_.warn("The mesh at node " + std::to_string(node) + " is skinned; its instances are not drawn.");
      }
      if (!count(loaded_.posed[node].followingSkin.size(), 1, pointer)) return;
      addPlacements(node, load_.document.model.nodes[node].skin, 0, glm::dmat4(1), loaded_.posed[node].followingSkin);
      placeCopy(node, 0, loaded_.posed[node].worldFromSkin, loaded_.posed[node].followingSkin, view, pointer);
    }
    const std::uint64_t copies = instancing ? instancing->count : 1;
    if (findings_.refused() || !count(primitives.size(), copies, pointer)) return;
    for (std::uint64_t copy = 0; copy < copies && !findings_.refused(); ++copy) {
      const auto nodeFromCopy = instancing ? instancing->nodeFromCopy(copy) : glm::dmat4(1);
      if (nodeFromCopy) {
        addPlacements(node, -1, static_cast<int>(copy), *nodeFromCopy, primitives);
        placeCopy(node, static_cast<int>(copy), tree_.worldFromNode[node] * *nodeFromCopy, primitives, view, pointer);
      } else {
        findings_.repair(
            {"An instance has a rotation of length 0 or a number that is not finite", "it is left out", true},
            pointerTo("/nodes", node) + "/extensions/EXT_mesh_gpu_instancing/attributes", {},
            "copy " + std::to_string(copy));
      }
    }
  }

  void placeCopy(std::size_t node, int copy, const glm::dmat4& worldFromLocal, const std::vector<int>& primitives,
                 SceneView& view, const std::string& pointer) {
    if (primitives.empty()) return;
    const bool leftOut = hasNoArea(worldFromLocal);
    if (leftOut && !animated_) {
      findings_.warn("The mesh at node " + std::to_string(node) +
                     " is scaled by 0 along two axes or more and is not drawn.");
    }
    for (const int index : primitives) {
      const Primitive& primitive = loaded_.primitives[static_cast<std::size_t>(index)];
      const std::uint64_t triangles = primitive.indexCount / 3;
      triangles_ += triangles; // what another pose may show counts as well
      if (triangles_ > load_.limits.maxTriangles) {
        findings_.tooLarge(pointer, "The scenes have too many triangles.", std::to_string(load_.limits.maxTriangles),
                           std::to_string(triangles_));
        return;
      }
      if (leftOut || tree_.hidden[node]) continue;
      view.triangles += triangles;
      Instance instance;
      instance.node = static_cast<int>(node);
      instance.primitive = index;
      instance.copy = copy;
      instance.worldFromLocal = worldFromLocal;
      instance.bounds = transformed(worldFromLocal, primitive.bounds);
      if (!isWithinReach(instance.bounds)) {
        findings_.invalid(pointerTo("/nodes", node), "The box around the node's mesh, in world space, reaches too far.",
                          reachLimit(), nodeTitle(node, load_.document.model.nodes[node].name));
        return;
      }
      view.bounds.add(instance.bounds);
      view.instances.push_back(instance);
    }
  }

  /// Counts `copies` of so many nodes or primitives, empty copies too; false, and a problem, past the limit.
  bool count(std::uint64_t primitives, std::uint64_t copies, const std::string& pointer) {
    const std::uint64_t each = copies > 1 ? std::max<std::uint64_t>(primitives, 1) : primitives;
    if (each == 0 || copies <= (load_.limits.maxInstances - placed_) / each) {
      placed_ += each * copies;
      return true;
    }
    findings_.tooLarge(
        pointer, "The scenes place too many nodes and primitives.", std::to_string(load_.limits.maxInstances),
        copies > 1
            ? std::to_string(copies) + " copies of " + std::to_string(primitives) + " after " + std::to_string(placed_)
            : std::to_string(placed_ + primitives));
    return false;
  }

  const LoadContext& load_;
  const LoadedMeshes& loaded_;
  const NodeTree& tree_;
  Findings& findings_;
  bool animated_;
  FlatScenes scenes_;
  std::uint64_t triangles_ = 0; ///< of all scenes
  std::uint64_t placed_ = 0;    ///< of all scenes; <= maxInstances
};

} // namespace

FlatScenes flattenScenes(const LoadContext& load, const LoadedMeshes& loaded, bool animated) {
  Flattening flattening(load, loaded, animated);
  const auto& scenes = load.document.model.scenes;
  for (std::size_t i = 0; i < scenes.size() && !load.findings.refused(); ++i) {
    flattening.flatten(scenes[i].nodes, pointerTo("/scenes", i));
  }
  if (scenes.empty()) flattening.flatten(flattening.roots(), "/nodes");
  return flattening.take();
}

} // namespace gnomon
