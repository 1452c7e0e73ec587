#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/prepare/frame_geometry.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// What a draw list is for: it decides which state and which textures its groups need.
enum class DrawUse {
  survey,        ///< culled by facing; textures only for materials with holes
  cast,          ///< both faces cast, but of solids only the front ones; textures only for materials that light passes
  castFromPoint, ///< both faces cast: the light may be inside a solid; textures only for materials that light passes
  surface        ///< culled by facing; a group for each material
};

/// A run of an indexed triangle list, drawn for one instance. Laid out as devices read indirect draws (OpenGL 4.5,
/// section 10.4; VkDrawIndexedIndirectCommand), so that a list of them is handed over whole.
struct DrawRange {
  std::uint32_t indexCount = 0;
  std::uint32_t instanceCount = 1;
  std::uint32_t firstIndex = 0;
  std::int32_t baseVertex = 0;
  std::uint32_t instance = 0; ///< index into the instances that the draw reads
};

/// The triangles of a group that are drawn: those whose corners go round this way as they are seen.
enum class Facing { both, counterClockwise, clockwise };

struct DrawState {
  int material = -1; ///< -1 = any: nothing but positions matters
  Facing facing = Facing::both;
  bool tangents = false;

  auto operator<=>(const DrawState&) const = default;
};

/// Ranges that share state and material.
struct DrawGroup : DrawState {
  std::size_t firstRange = 0;
  std::size_t rangeCount = 0;
};

struct DrawList {
  std::vector<DrawRange> ranges;
  std::vector<DrawGroup> groups;
  std::uint64_t triangles = 0;
};

/// Whether more than positions matters where triangles of a material are drawn for depths.
bool readsMaterial(const Material& material, DrawUse use);

/// The draws for every slot that `keep` marks (one byte a slot); neighbouring clusters become one draw. Pure.
DrawList buildDrawList(const Scene& scene, const SceneView& view, const FrameGeometry& geometry, DrawUse use,
                       std::span<const std::uint8_t> keep);

/// Triangles of a draw list have numbers, so that a pixel names the one that it shows by one word.
inline constexpr std::uint32_t kNoNumber = 0xffffffffu;

/// The triangle of a number.
class TriangleNumbers {
 public:
  TriangleNumbers() = default;
  TriangleNumbers(const Scene& scene, const SceneView& view, const DrawList& list);
  /// Numbers by slot: slot * kClusterTriangles + the triangle's place in it.
  explicit TriangleNumbers(const FrameGeometry& geometry);

  /// Fastest when consecutive numbers share a draw. REQUIRES: numbers of the list, or
  /// kNoNumber.
  std::vector<PlacedTriangle> of(std::span<const std::uint32_t> numbers) const;
  void of(std::span<const std::uint32_t> numbers, std::span<PlacedTriangle> triangles) const; ///< as many of each

 private:
  struct Draw {
    std::uint32_t firstNumber = 0;
    PlacedTriangle first;
  };
  std::vector<Draw> draws_; ///< by their first number
};

} // namespace gnomon
