#include "renderer/rays/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <span>

#include "renderer/core/aabb.h"
#include "renderer/core/parallel.h"
#include "renderer/rays/tree.h"
#include "renderer/scene/texture_reads.h"

namespace gnomon {
namespace {

using Tree = TracedScene::Tree;

/// Some vertices of an instance, few enough to share them out.
struct Stretch {
  std::uint32_t instance = 0;
  std::uint32_t first = 0; ///< of its primitive's
  std::uint32_t count = 0;
};

std::vector<Stretch> stretchesOf(const Tree& tree) {
  constexpr std::uint32_t kMost = 1 << 13;
  std::vector<Stretch> stretches;
  for (std::uint32_t i = 0; i < tree.view->instances.size(); ++i) {
    const std::uint32_t count = tree.primitive(i).vertexCount;
    for (std::uint32_t first = 0; first < count; first += kMost) {
      stretches.push_back({i, first, std::min(kMost, count - first)});
    }
  }
  return stretches;
}

/// Calls `each(number, place)` for the stretch's vertices, relative to the anchor.
template <class Each>
void forEachVertex(const Tree& tree, const Stretch& stretch, Each each) {
  const glm::dmat4 matrix = tree.anchoredFromLocal(tree.instance(stretch.instance));
  const glm::vec3* local = tree.scene->positions.data() + tree.primitive(stretch.instance).baseVertex;
  for (std::uint32_t i = stretch.first; i < stretch.first + stretch.count; ++i) {
    each(i, glm::dvec3(matrix * glm::dvec4(local[i], 1.0)));
  }
}

double largestIn(const Tree& tree, const Stretch& stretch) {
  double largest = 0;
  forEachVertex(tree, stretch, [&](std::uint32_t, const glm::dvec3& p) {
    if (finite(p)) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  });
  return largest;
}

double scaleFor(const Tree& tree, std::span<const Stretch> stretches) {
  std::vector<double> largest(stretches.size());
  forEach(stretches.size(), [&](std::size_t i) { largest[i] = largestIn(tree, stretches[i]); });
  const double most = largest.empty() ? 0.0 : *std::max_element(largest.begin(), largest.end());
  return most > 0 ? std::ldexp(1.0, -std::ilogb(most)) : 1.0;
}

Aabb placeStretch(const Tree& tree, const Stretch& stretch, std::span<glm::vec3> positions) {
  Aabb bounds;
  forEachVertex(tree, stretch, [&](std::uint32_t i, const glm::dvec3& p) {
    positions[i] = glm::vec3(p * tree.scale);
    const glm::dvec3 placed = glm::dvec3(positions[i]) / tree.scale;
    if (finite(placed)) bounds.add(placed);
  });
  return bounds;
}

void placeVertices(Tree& tree) {
  const std::vector<Stretch> stretches = stretchesOf(tree);
  tree.scale = scaleFor(tree, stretches);
  std::size_t count = 0;
  for (const Instance& instance : tree.view->instances) {
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(instance.primitive)];
    tree.firstPosition.push_back(count);
    tree.firstIndex.push_back(primitive.firstIndex);
    tree.mirrored.push_back(glm::determinant(glm::dmat3(instance.worldFromLocal)) < 0 ? 1 : 0);
    count += primitive.vertexCount;
  }
  tree.positions.assign(count + 1, glm::vec3(0));
  std::vector<Aabb> bounds(stretches.size());
  forEach(stretches.size(), [&](std::size_t i) {
    const std::size_t first = tree.firstPosition[stretches[i].instance];
    bounds[i] = placeStretch(tree, stretches[i], std::span(tree.positions).subspan(first));
  });
  for (const Aabb& each : bounds) tree.bounds.add(each);
}

Problem outOfMemory() {
  return noMemory("", "There is not enough memory to prepare the scene for ray tracing.");
}

} // namespace

TracedScene::TracedScene(std::unique_ptr<const Tree> tree) : tree_(std::move(tree)) {}
TracedScene::TracedScene(TracedScene&&) noexcept = default;
TracedScene& TracedScene::operator=(TracedScene&&) noexcept = default;
TracedScene::~TracedScene() = default;

Result<TracedScene> TracedScene::build(std::shared_ptr<const Scene> scene, int index) {
  try {
    const SceneView& view = scene->scenes[static_cast<std::size_t>(index)];
    const std::vector<int> masks = alphaImages(*scene, view);
    if (Status decoded = decodeImages(scene->images, masks); !decoded) return std::move(decoded).problems();
    auto tree = std::make_unique<Tree>();
    tree->masks.resize(scene->images.size());
    forEach(masks.size(), [&](std::size_t i) {
      const auto image = static_cast<std::size_t>(masks[i]);
      tree->masks[image] = scene->images[image]->alpha();
    });
    tree->coverages = KeptCoverages().of(*scene, view);
    tree->view = &scene->scenes[static_cast<std::size_t>(index)];
    tree->scene = std::move(scene);
    tree->anchor = anchorOf(*tree->view);
    placeVertices(*tree);
    tree->boxes = TriangleBoxes(*tree);
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
  std::size_t masks = 0;
  for (const auto& mask : tree_->masks) masks += mask ? mask->bytes() : 0;
  std::size_t indices = 0;
  for (const auto& copy : tree_->indices) indices += copy.capacity() * sizeof(std::uint32_t);
  return masks + indices + static_cast<std::size_t>(tree_->embreeBytes.load()) +
         (tree_->positions.capacity() + tree_->shared.capacity()) * sizeof(glm::vec3) +
         tree_->firstPosition.capacity() * sizeof(std::size_t) + tree_->firstIndex.capacity() * sizeof(std::size_t) +
         tree_->mirrored.capacity() + tree_->boxes.bytes() +
         KeptFronts::mostBytes(tree_->boxes.runs(), tree_->view->instances.size());
}

} // namespace gnomon
