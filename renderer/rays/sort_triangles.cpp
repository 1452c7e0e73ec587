#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <span>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"
#include "renderer/rays/trace_packet.h"

namespace gnomon {
namespace {

using Tree = TracedScene::Tree;

std::atomic<RayVectors> usedVectors = RayVectors::widest;

bool countBytes(void* tree, ssize_t bytes, bool /*after*/) {
  static_cast<Tree*>(tree)->embreeBytes += bytes;
  return true;
}

/// Called often by Embree, from any of its threads; false ends the build.
bool goesOn(void* stop, double /*share*/) {
  return !static_cast<Stop*>(stop)->asked();
}

void build(RTCScene scene) {
  stopIfAsked();
  if (Stop* const stop = Stop::current()) rtcSetSceneProgressMonitorFunction(scene, goesOn, stop);
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  stopIfAsked();
}

void keepError(void* tree, RTCError code, const char* /*text*/) {
  RTCError none = RTC_ERROR_NONE;
  static_cast<Tree*>(tree)->error.compare_exchange_strong(none, code);
}

RayScene emptyScene(const Tree& tree, RTCBuildQuality quality) {
  RayScene scene(rtcNewScene(tree.device.get()));
  // Watertight at edges, and filters where a ray asks for one.
  rtcSetSceneFlags(scene.get(),
                   static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  rtcSetSceneBuildQuality(scene.get(), quality);
  return scene;
}

/// The places of a primitive's vertices, from the `first`.
struct Positions {
  const std::vector<glm::vec3>& all;
  std::size_t first = 0;
};

/// A triangle that is nowhere larger than this, in the tree's units, is a point to rays. Embree's builder for many
/// triangles asserts that what it takes apart has an extent, and divides by it, in floats without denormal numbers.
constexpr float kLeastExtent = 0x1p-100f;

bool isPoint(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 extent = glm::max(glm::max(a, b), c) - glm::min(glm::min(a, b), c);
  return !(std::max({extent.x, extent.y, extent.z}) > kLeastExtent);
}

/// The indices of a primitive as Embree takes them: the scene's own, or a copy in which the triangles that are points
/// name vertices that there are not, so that Embree leaves them out. None where all are points.
std::span<const std::uint32_t> tracedIndices(Tree& tree, const Primitive& primitive, const Positions& positions) {
  constexpr std::size_t kPiece = 1 << 12;
  constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();
  const auto indices =
      std::span<const std::uint32_t>(tree.scene->indices).subspan(primitive.firstIndex, primitive.indexCount);
  const std::size_t triangles = indices.size() / 3;
  const glm::vec3* places = positions.all.data() + positions.first;
  const auto isPointAt = [&](std::size_t i) {
    const std::uint32_t* corner = &indices[3 * i];
    return isPoint(places[corner[0]], places[corner[1]], places[corner[2]]);
  };
  std::atomic<std::size_t> points = 0;
  forEachPiece(triangles, kPiece, [&](std::size_t first, std::size_t last) {
    std::size_t here = 0;
    for (std::size_t i = first; i < last; ++i) here += isPointAt(i) ? 1 : 0;
    points += here;
  });
  if (points == triangles) return {};
  if (points == 0) return indices;
  std::vector<std::uint32_t>& copy = tree.indices.emplace_back(indices.begin(), indices.end());
  for (std::size_t i = 0; i < triangles; ++i) {
    if (isPointAt(i)) std::fill_n(&copy[3 * i], 3, kNoVertex);
  }
  return copy;
}

/// False, and nothing is added, where all of the primitive's triangles are points.
bool addTriangles(Tree& tree, RTCScene scene, const Primitive& primitive, const Positions& positions,
                  std::uint32_t number) {
  const std::span<const std::uint32_t> indices = tracedIndices(tree, primitive, positions);
  if (indices.empty()) return false;
  const Geometry geometry(rtcNewGeometry(tree.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.all.data(),
                             positions.first * sizeof(glm::vec3), sizeof(glm::vec3), primitive.vertexCount);
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices.data(), 0,
                             3 * sizeof(std::uint32_t), indices.size() / 3);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene, geometry.get(), number);
  return true;
}

bool isWorthSharing(const Primitive& primitive, std::size_t uses) {
  constexpr std::size_t kLeastTriangles = 256;
  constexpr std::size_t kLeastPlaced = 1 << 15; ///< by all instances together
  const std::size_t triangles = primitive.indexCount / 3;
  return triangles >= kLeastTriangles && uses > 1 && triangles * uses >= kLeastPlaced;
}

double frobenius(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

/// Whether a ray that is turned into the instance's space in floats is rounded there about as much as the vertices are
/// where they are placed: the matrix must neither stretch much nor cancel large coordinates.
bool turnsWell(const Tree& tree, const Instance& instance, const Primitive& primitive) {
  constexpr double kMostStretch = 16; // 3 = none
  constexpr double kMostRounding = 4; // 1 = that of placed vertices
  constexpr double kMostSize = 1 << 20;
  const glm::dmat4 matrix = tree.anchoredFromLocal(instance);
  const glm::dmat3 turn(matrix);
  const double length = frobenius(turn);
  const double stretch = length * frobenius(glm::inverse(turn));
  const double half = glm::length(primitive.bounds.halfExtent());
  const glm::dvec3 center = primitive.bounds.center();
  const double placed = glm::length(glm::dvec3(matrix * glm::dvec4(center, 1))) + length * half;
  const double passed = length * (glm::length(center) + half) + glm::length(glm::dvec3(matrix[3]));
  return stretch <= kMostStretch && passed <= kMostRounding * placed && half <= kMostSize && half * kMostSize >= 1 &&
         length * tree.scale * kMostSize >= 1;
}

/// For each instance its primitive where that has a tree of its own, or else -1.
std::vector<int> sharedPrimitives(const Tree& tree) {
  std::map<int, std::size_t> uses;
  for (const Instance& instance : tree.view->instances) ++uses[instance.primitive];
  std::vector<int> shared;
  for (const Instance& instance : tree.view->instances) {
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(instance.primitive)];
    const bool shares = isWorthSharing(primitive, uses[instance.primitive]) && turnsWell(tree, instance, primitive);
    shared.push_back(shares ? instance.primitive : -1);
  }
  return shared;
}

/// The trees of `shared` primitives, by their index; none where all triangles are points.
std::map<int, RayScene> sortShared(Tree& tree, const std::vector<int>& shared) {
  std::map<int, std::size_t> first; // of each primitive among the tree's shared positions
  for (const int index : shared) {
    if (index < 0 || first.contains(index)) continue;
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(index)];
    const auto from = tree.scene->positions.begin() + primitive.baseVertex;
    first[index] = tree.shared.size();
    tree.shared.insert(tree.shared.end(), from, from + primitive.vertexCount);
  }
  if (!tree.shared.empty()) tree.shared.emplace_back(0.0f); // Embree reads 16 bytes at once
  std::map<int, RayScene> trees;
  for (const auto& [index, start] : first) {
    RayScene scene = emptyScene(tree, RTC_BUILD_QUALITY_MEDIUM);
    const Primitive& primitive = tree.scene->primitives[static_cast<std::size_t>(index)];
    if (!addTriangles(tree, scene.get(), primitive, {tree.shared, start}, 0)) continue;
    build(scene.get());
    trees.emplace(index, std::move(scene));
  }
  return trees;
}

void addInstance(const Tree& tree, RTCScene shared, std::uint32_t number) {
  const Geometry geometry(rtcNewGeometry(tree.device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
  rtcSetGeometryInstancedScene(geometry.get(), shared);
  const glm::mat4x3 matrix(glm::dmat4x3(tree.anchoredFromLocal(tree.instance(number)) * tree.scale));
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &matrix);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(tree.rays.get(), geometry.get(), number);
}

std::size_t trianglesApart(const Tree& tree, const std::vector<int>& shared) {
  std::size_t triangles = 0;
  for (std::uint32_t i = 0; i < shared.size(); ++i) triangles += shared[i] < 0 ? tree.primitive(i).indexCount / 3 : 0;
  return triangles;
}

void sortAll(Tree& tree) {
  constexpr std::size_t kSortedWell = 1 << 14; // more triangles are sorted quickly: rays take about as long
  const std::vector<int> shared = sharedPrimitives(tree);
  const bool many = trianglesApart(tree, shared) > kSortedWell;
  tree.rays = emptyScene(tree, many ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
  const std::map<int, RayScene> trees = sortShared(tree, shared);
  for (std::uint32_t i = 0; i < shared.size(); ++i) {
    const Primitive& primitive = tree.primitive(i);
    if (primitive.indexCount == 0) continue;
    const auto own = trees.find(shared[i]);
    if (own != trees.end()) {
      addInstance(tree, own->second.get(), i);
    } else if (shared[i] < 0) {
      addTriangles(tree, tree.rays.get(), primitive, {tree.positions, tree.firstPosition[i]}, i);
    }
  }
  build(tree.rays.get());
}

} // namespace

void useRayVectors(RayVectors vectors) {
  usedVectors = vectors;
}

const char* rayDeviceOptions() {
  switch (usedVectors) {
    case RayVectors::widest:
      break;
    case RayVectors::avx2:
      return "set_affinity=0,max_isa=avx2";
    case RayVectors::sse4:
      return "set_affinity=0,max_isa=sse4.2";
  }
  return "set_affinity=0";
}

void sortTriangles(Tree& tree) {
  tree.device.reset(rtcNewDevice(rayDeviceOptions()));
  if (!tree.device) {
    tree.error = rtcGetDeviceError(nullptr);
    return;
  }
  tree.packets = widestPackets(tree.device.get());
  rtcSetDeviceErrorFunction(tree.device.get(), keepError, &tree);
  rtcSetDeviceMemoryMonitorFunction(tree.device.get(), countBytes, &tree);
  onAllCores([&] { sortAll(tree); });
}

} // namespace gnomon
