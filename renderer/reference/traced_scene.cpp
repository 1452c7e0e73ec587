#include "renderer/reference/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "renderer/reference/sort_triangles.h"
#include "renderer/reference/tree.h"
#include "renderer/scene/texture_images.h"

namespace gnomon {
namespace {

using Tree = TracedScene::Tree;

bool isFinite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Calls `each(place)` for every vertex of every instance, in order, relative to the anchor.
template <class Each>
void forEachVertex(const Tree& tree, Each each) {
  for (const Instance& instance : tree.view->instances) {
    const glm::dmat4 matrix = tree.anchoredFromLocal(instance);
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(instance.primitive)];
    const glm::vec3* local = tree.scene->positions.data() + primitive.baseVertex;
    std::for_each_n(local, primitive.vertexCount,
                    [&](const glm::vec3& p) { each(glm::dvec3(matrix * glm::dvec4(p, 1.0))); });
  }
}

double scaleFor(const Tree& tree) {
  double largest = 0;
  forEachVertex(tree, [&](const glm::dvec3& p) {
    if (isFinite(p)) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  });
  return largest > 0 ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

void placeVertices(Tree& tree) {
  tree.scale = scaleFor(tree);
  std::size_t count = 0;
  for (const Instance& instance : tree.view->instances) {
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(instance.primitive)];
    tree.firstPosition.push_back(count);
    tree.firstIndex.push_back(primitive.firstIndex);
    tree.mirrored.push_back(glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0 ? 1 : 0);
    count += primitive.vertexCount;
  }
  tree.positions.reserve(count + 1);
  forEachVertex(tree, [&](const glm::dvec3& p) {
    tree.positions.emplace_back(p * tree.scale);
    const glm::dvec3 placed = glm::dvec3(tree.positions.back()) / tree.scale;
    if (isFinite(placed)) tree.bounds.add(placed);
  });
  tree.positions.emplace_back(0.0f);
}

Problem outOfMemory() {
  return {ProblemCode::unavailable, "", "Memory ran out while the scene was prepared for ray tracing."};
}

} // namespace

TracedScene::TracedScene(std::unique_ptr<const Tree> tree) : tree_(std::move(tree)) {}
TracedScene::TracedScene(TracedScene&&) noexcept = default;
TracedScene& TracedScene::operator=(TracedScene&&) noexcept = default;
TracedScene::~TracedScene() = default;

Result<TracedScene> TracedScene::build(std::shared_ptr<const Scene> scene, int index) {
  try {
    const SceneView& view = scene->scenes[static_cast<std::size_t>(index)];
    if (Status decoded = decodeImages(scene->images, alphaImages(*scene, view)); !decoded) {
      return std::move(decoded).problems();
    }
    auto tree = std::make_unique<Tree>();
    tree->view = &scene->scenes[static_cast<std::size_t>(index)];
    tree->scene = std::move(scene);
    tree->anchor = anchorOf(*tree->view);
    placeVertices(*tree);
    sortTriangles(*tree);
    if (tree->error == RTC_ERROR_OUT_OF_MEMORY) return outOfMemory();
    if (tree->error != RTC_ERROR_NONE) {
      return Problem{ProblemCode::internal, "", "The scene could not be prepared for ray tracing.", "",
                     "Embree error " + std::to_string(tree->error)};
    }
    return TracedScene(std::move(tree));
  } catch (const std::bad_alloc&) {
    return outOfMemory();
  }
}

const Scene& TracedScene::scene() const {
  return *tree_->scene;
}

const SceneView& TracedScene::view() const {
  return *tree_->view;
}

std::size_t TracedScene::bytes() const {
  return static_cast<std::size_t>(tree_->embreeBytes.load()) + tree_->positions.capacity() * sizeof(glm::vec3) +
         tree_->firstPosition.capacity() * sizeof(std::size_t) + tree_->firstIndex.capacity() * sizeof(std::size_t) +
         tree_->mirrored.capacity();
}

} // namespace gnomon
