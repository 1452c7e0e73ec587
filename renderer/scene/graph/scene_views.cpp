#include "renderer/scene/graph/scene_views.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/graph/cameras.h"
#include "renderer/scene/graph/lights.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

/// Volume of the unit cube's image per volume of a box with the same edges: below this, a transform is flat.
constexpr double kFlatVolume = 1e-12;

bool isFlat(const glm::dmat4& matrix) {
  double volume = glm::determinant(glm::dmat3(matrix));
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = glm::length(glm::dvec3(matrix[axis]));
    if (!(edge > 0) || !std::isfinite(edge)) return true;
    volume /= edge;
  }
  return !(std::abs(volume) > kFlatVolume);
}

bool finite(const Aabb& box) {
  const glm::dvec3 sum = box.min + box.max;
  return std::isfinite(sum.x) && std::isfinite(sum.y) && std::isfinite(sum.z);
}

class Flattening {
 public:
  Flattening(const GltfDocument& document, const std::vector<BuiltMesh>& meshes,
             const std::vector<Primitive>& primitives, const Limits& limits, Findings& findings)
      : document_(document),
        meshes_(meshes),
        primitives_(primitives),
        limits_(limits),
        findings_(findings),
        tree_(buildNodeTree(document, findings)) {}

  std::vector<int> roots() const {
    std::vector<int> roots;
    for (std::size_t node = 0; node < tree_.parents.size(); ++node) {
      if (tree_.parents[node] < 0) roots.push_back(static_cast<int>(node));
    }
    return roots;
  }

  SceneView flatten(const std::vector<int>& roots, const std::string& pointer) {
    SceneView view;
    const std::vector<int> nodes = reachedFrom(roots);
    for (const int node : nodes) {
      if (findings_.refused()) return view;
      place(static_cast<std::size_t>(node), view, pointer);
    }
    return view;
  }

 private:
  /// The nodes below the roots, ascending. The nodes are trees, so none is met twice.
  std::vector<int> reachedFrom(const std::vector<int>& roots) {
    std::vector<int> nodes = roots;
    for (std::size_t i = 0; i < nodes.size() && count(1, "/scenes"); ++i) {
      const auto& children = document_.model.nodes[static_cast<std::size_t>(nodes[i])].children;
      nodes.insert(nodes.end(), children.begin(), children.end());
    }
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void place(std::size_t node, SceneView& view, const std::string& pointer) {
    const tinygltf::Node& source = document_.model.nodes[node];
    if (source.mesh >= 0) placeMesh(node, meshes_[static_cast<std::size_t>(source.mesh)], view, pointer);
    if (source.camera >= 0) {
      if (auto camera = cameraOf(document_, tree_, node, findings_)) view.cameras.push_back(*std::move(camera));
    }
    if (auto light = lightOf(document_, tree_, node, findings_)) view.lights.push_back(*std::move(light));
  }

  void placeMesh(std::size_t node, const BuiltMesh& mesh, SceneView& view, const std::string& pointer) {
    const glm::dmat4& worldFromLocal = tree_.worldFromNode[node];
    if (isFlat(worldFromLocal)) {
      if (!mesh.primitives.empty()) {
        findings_.warn("The mesh at node " + std::to_string(node) + " is scaled to nothing and not drawn.");
      }
      return;
    }
    triangles_ += mesh.triangles;
    if (triangles_ > limits_.maxTriangles) {
      findings_.tooLarge(pointer, "The scenes have too many triangles.", std::to_string(limits_.maxTriangles),
                         std::to_string(triangles_));
      return;
    }
    if (!count(mesh.primitives.size(), pointer)) return;
    view.triangles += mesh.triangles;
    for (const int primitive : mesh.primitives) {
      Instance instance;
      instance.node = static_cast<int>(node);
      instance.primitive = primitive;
      instance.worldFromLocal = worldFromLocal;
      instance.bounds = transformed(worldFromLocal, primitives_[static_cast<std::size_t>(primitive)].bounds);
      if (!finite(instance.bounds)) {
        findings_.invalid(pointerTo("/nodes", node), "The mesh's place in the world is not finite.");
        return;
      }
      view.bounds.add(instance.bounds);
      view.instances.push_back(instance);
    }
  }

  /// Adds to the nodes and primitives placed so far; false, and a problem, past the limit.
  bool count(std::size_t more, const std::string& pointer) {
    placed_ += more;
    if (placed_ <= limits_.maxInstances) return true;
    findings_.tooLarge(pointer, "The scenes place too many nodes and primitives.", std::to_string(limits_.maxInstances),
                       std::to_string(placed_));
    return false;
  }

  const GltfDocument& document_;
  const std::vector<BuiltMesh>& meshes_;
  const std::vector<Primitive>& primitives_;
  const Limits& limits_;
  Findings& findings_;
  NodeTree tree_;
  std::uint64_t triangles_ = 0; ///< of all scenes
  std::size_t placed_ = 0;      ///< of all scenes
};

} // namespace

std::vector<SceneView> flattenScenes(const GltfDocument& document, const std::vector<BuiltMesh>& meshes,
                                     const std::vector<Primitive>& primitives, const Limits& limits,
                                     Findings& findings) {
  std::vector<SceneView> views;
  Flattening flattening(document, meshes, primitives, limits, findings);
  if (findings.refused()) return views;
  const auto& scenes = document.model.scenes;
  for (std::size_t i = 0; i < scenes.size() && !findings.refused(); ++i) {
    views.push_back(flattening.flatten(scenes[i].nodes, pointerTo("/scenes", i)));
  }
  if (scenes.empty()) views.push_back(flattening.flatten(flattening.roots(), "/nodes"));
  return views;
}

} // namespace gnomon
