#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/raster/depth_buffer.h"
#include "renderer/cpu/raster/raster_triangles.h"
#include "renderer/cpu/raster/texel_marks.h"
#include "renderer/prepare/draw_list.h"

/// Triangles to depths and triangle numbers, on all cores.
///
/// Corners are snapped to 1/256 of a pixel, and then all is exact: a sample belongs to a triangle where the integers
/// say so, and on an edge to the one that has it as a left or an upper edge (Microsoft, "Rasterization Rules", Direct3D
/// 11). So triangles that share an edge leave no gap and no sample to both. Depths are those of the planes through the
/// corners before they are snapped. What comes out depends neither on the
/// number of threads nor on their order.
namespace gnomon::cpu {

/// A slot to be rastered.
struct RasterDraw {
  std::uint32_t slot = 0;
  Facing facing = Facing::both; ///< the triangles that count, by how their corners go round on the picture
  bool holed = false;           ///< its triangles leave samples out: RasterInput::holes says which
};

/// Pixels and the triangles that cover them, all of one instance. There is room for twice as many as are asked about at
/// once.
struct HoledPlaces {
  static constexpr std::size_t kAsked = 16, kRoom = 2 * kAsked;
  std::uint32_t instance = kNoNumber;
  alignas(64) std::uint32_t number[kRoom] = {}; ///< of the triangle
  alignas(64) std::int32_t x[kRoom] = {}, y[kRoom] = {};
  unsigned counterClockwise = 0; ///< a bit each: how the triangle's corners go round on the picture
};

/// Says where triangles have holes. Asked from several threads at once.
class Holes {
 public:
  virtual ~Holes() = default;
  /// Of the first kAsked, a bit each, those that their triangles fill. `asked`: those that count.
  virtual unsigned filled(const HoledPlaces& places, unsigned asked) const = 0;
};

/// What is rastered. All of it outlives the call.
struct RasterInput {
  const Scene& scene;
  std::span<const Slot> slots;
  std::span<const glm::mat4> clipFromLocal; ///< one an instance
  std::span<const RasterDraw> draws;        ///< of triangles at one depth, that of the earlier draw is shown
  const Holes* holes = nullptr;             ///< asked where draws are holed
  const TexelMarks* only = nullptr;         ///< the blocks that are wanted, of the target's size; null = all
  bool fresh = false;                       ///< the target holds anything: what is wanted is emptied first
};

/// How depths are compared, and what lies before the first or behind the last.
enum class DepthRange {
  reversed, ///< 1 nearest; what lies beyond 0..1 is clipped: a camera's
  clamped   ///< 0 nearest; what lies beyond 0..1 is flattened onto it: a light's
};

/// Pixels along a side of the squares of the picture that are rastered at a time.
inline constexpr int kSquareSide = kMarkSquare;

/// What frames leave to the next ones, so that memory is touched once.
struct RasterScratch {
  std::vector<TriangleGroup> groups; ///< as many as a call ever had: smaller ones leave the others their memory
};

/// Where the samples of a pixel lie: see kSamplePlaces. REQUIRES: 1 or 4.
std::span<const glm::ivec2> samplePlaces(int samples);

/// Adds to `target`, which has its size and samples. Where input.only wants some blocks, these are emptied first,
/// whatever they held, and the others are left as they are. A block comes out the same whichever others are wanted.
/// Gives the triangles that were drawn: those of the draws.
std::uint64_t raster(const RasterInput& input, DepthRange range, DepthBuffer& target, RasterScratch& scratch);

/// A buffer of that size that holds anything. `storage`: one that nothing needs any more, whose memory is used.
DepthBuffer unfilledBuffer(int width, int height, int samples, bool numbered, DepthBuffer storage = {});

} // namespace gnomon::cpu
