#include "renderer/reference/traced_scene.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "renderer/core/parallel.h"
#include "renderer/reference/tree.h"
#include "renderer/scene/texture_images.h"

namespace gnomon {
namespace {

using Tree = TracedScene::Tree;

glm::dmat4 anchoredFromLocal(const Tree& tree, const Instance& instance) {
  glm::dmat4 matrix = instance.worldFromLocal;
  matrix[3] -= glm::dvec4(tree.anchor, 0.0);
  return matrix;
}

bool isFinite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Calls `each(place)` for every vertex of every instance, in order, relative to the anchor.
template <class Each>
void forEachVertex(const Tree& tree, Each each) {
  for (const Instance& instance : tree.view->instances) {
    const glm::dmat4 matrix = anchoredFromLocal(tree, instance);
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

bool countBytes(void* tree, ssize_t bytes, bool /*after*/) {
  static_cast<Tree*>(tree)->embreeBytes += bytes;
  return true;
}

void keepError(void* tree, RTCError code, const char* /*text*/) {
  RTCError none = RTC_ERROR_NONE;
  static_cast<Tree*>(tree)->error.compare_exchange_strong(none, code);
}

void addGeometries(Tree& tree) {
  for (std::uint32_t i = 0; i < tree.view->instances.size(); ++i) {
    const Primitive& primitive = tree.primitive(i);
    if (primitive.indexCount == 0) continue;
    const Geometry geometry(rtcNewGeometry(tree.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, tree.positions.data(),
                               tree.firstPosition[i] * sizeof(glm::vec3), sizeof(glm::vec3), primitive.vertexCount);
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, tree.scene->indices.data(),
                               primitive.firstIndex * sizeof(std::uint32_t), 3 * sizeof(std::uint32_t),
                               primitive.indexCount / 3);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(tree.rays.get(), geometry.get(), i);
  }
}

void sortTriangles(Tree& tree) {
  tree.device.reset(rtcNewDevice("set_affinity=0"));
  if (!tree.device) {
    tree.error = rtcGetDeviceError(nullptr);
    return;
  }
  rtcSetDeviceErrorFunction(tree.device.get(), keepError, &tree);
  rtcSetDeviceMemoryMonitorFunction(tree.device.get(), countBytes, &tree);
  tree.rays.reset(rtcNewScene(tree.device.get()));
  // Watertight at edges, and filters where a ray asks for one.
  rtcSetSceneFlags(tree.rays.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(tree.rays.get(), RTC_BUILD_QUALITY_MEDIUM);
  addGeometries(tree);
  onAllCores([&] { rtcCommitScene(tree.rays.get()); });
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
