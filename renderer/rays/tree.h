#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <embree3/rtcore.h>
#include <list>
#include <memory>
#include <type_traits>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/rays/lit_fronts.h"
#include "renderer/rays/traced_scene.h"
#include "renderer/rays/triangle.h"
#include "renderer/rays/triangle_boxes.h"
#include "renderer/scene/mask_coverage.h"

namespace gnomon {

template <auto release>
struct Release {
  template <class T>
  void operator()(T* owned) const {
    release(owned);
  }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release<rtcReleaseDevice>>;
using RayScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, Release<rtcReleaseScene>>;
using Geometry = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, Release<rtcReleaseGeometry>>;

/// Embree's numbers: geometry, or Embree's instance where there is one = index into SceneView::instances; primitive =
/// triangle of the scene's primitive.
struct TracedScene::Tree {
  std::shared_ptr<const Scene> scene;
  const SceneView* view = nullptr;
  glm::dvec3 anchor{0};

  /// What the coordinates are multiplied by for Embree: the power of two that brings the largest to 1..2. Exact, and
  /// keeps products of coordinates from running over or under in scenes of any size.
  double scale = 1;
  std::vector<glm::vec3> positions;       ///< times `scale`; one more at the end: Embree reads 16 bytes at once
  std::vector<std::size_t> firstPosition; ///< of each instance
  std::vector<std::size_t> firstIndex;    ///< of each instance, into the scene's
  /// Indices of primitives that are points in part, without those triangles: they stay where they are in memory.
  std::list<std::vector<std::uint32_t>> indices;
  std::vector<glm::vec3> shared;      ///< positions of primitives with a tree of their own, in their own space
  std::vector<std::uint8_t> mirrored; ///< one an instance: its triangles run the other way round
  /// By the image; none where no hole depends on it.
  std::vector<std::shared_ptr<const AlphaLevels>> masks;
  MaskCoverages coverages;
  Aabb bounds; ///< of the placed triangles, metres
  TriangleBoxes boxes;
  mutable KeptFronts fronts;
  std::atomic<std::int64_t> embreeBytes = 0;
  std::atomic<RTCError> error = RTC_ERROR_NONE;
  Device device;
  unsigned packets = 16; ///< as wide as its rays are traced together: widestPackets
  RayScene rays;         ///< after `device`: released first

  glm::dmat4 anchoredFromLocal(const Instance& instance) const {
    glm::dmat4 matrix = instance.worldFromLocal;
    matrix[3] -= glm::dvec4(anchor, 0.0);
    return matrix;
  }
  const Instance& instance(std::uint32_t index) const { return view->instances[index]; }
  const Primitive& primitive(std::uint32_t instanceIndex) const {
    return scene->primitives[static_cast<std::size_t>(instance(instanceIndex).primitive)];
  }
  const Material& material(std::uint32_t instanceIndex) const {
    return scene->materials[static_cast<std::size_t>(materialOf(*scene, instance(instanceIndex)))];
  }
  /// Of a triangle's corners.
  std::array<const VertexAttributes*, 3> vertices(std::uint32_t instanceIndex, std::uint32_t triangleIndex) const {
    const Primitive& of = primitive(instanceIndex);
    const std::uint32_t* corner = &scene->indices[of.firstIndex + 3 * std::size_t{triangleIndex}];
    const VertexAttributes* first = &scene->attributes[of.baseVertex];
    return {first + corner[0], first + corner[1], first + corner[2]};
  }
  /// Null where no coverage is lost.
  const MaskCoverage* coverage(std::uint32_t instanceIndex) const {
    return coverages[static_cast<std::size_t>(materialOf(*scene, instance(instanceIndex)))].get();
  }
  /// How packets of rays that lie close together are traced. Embree 3.13 follows them as one bundle, but there, with
  /// instances in the scene, it may never end.
  RTCIntersectContextFlags closeRays() const {
    return shared.empty() ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  /// Its corners, times `scale`. REQUIRES: a triangle of the scene.
  std::array<glm::vec3, 3> corners(const PlacedTriangle& of) const {
    const std::uint32_t* corner = &scene->indices[firstIndex[of.instance] + 3 * std::size_t{of.triangle}];
    const glm::vec3* placed = &positions[firstPosition[of.instance]];
    return {placed[corner[0]], placed[corner[1]], placed[corner[2]]};
  }
  Triangle triangle(std::uint32_t instanceIndex, std::uint32_t triangleIndex) const {
    const auto [a, b, c] = corners({instanceIndex, triangleIndex});
    const double metres = 1.0 / scale;
    return {glm::dvec3(a) * metres, glm::dvec3(b) * metres, glm::dvec3(c) * metres};
  }
};

/// Sorts a tree's placed triangles for rays: makes `device` and `rays`, or sets `error`.
/// A primitive of many triangles that several instances place is sorted once, in its own space, where the rounding of
/// rays that are turned into it is no worse than that of placed vertices. `rays` refers to the tree's vectors.
void sortTriangles(TracedScene::Tree& tree);

} // namespace gnomon
