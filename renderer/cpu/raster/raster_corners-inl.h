// The corners of a draw's triangles on the picture.
#if defined(GNOMON_CPU_RASTER_CORNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_CORNERS_INL_H
#undef GNOMON_CPU_RASTER_CORNERS_INL_H
#else
#define GNOMON_CPU_RASTER_CORNERS_INL_H
#endif

#include <algorithm>
#include <span>
#include <vector>

#include "renderer/core/vectors.h"
#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/vectors-inl.h"
#include "renderer/cpu/raster/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The corners of a draw's vertices. One that lies outside of what may be rastered has no place, and is clipped with
/// its triangle.
struct PlacedCorners {
  /// Four numbers a corner: x and y, 1/256 of a pixel from the picture's lower left corner, x = kNowhere where it has
  /// no place; z; and one that means nothing.
  UnfilledVector<float> places;
  std::vector<std::uint32_t> sources; ///< corner k is of vertex sources[k]; empty = of vertex first + k
  std::uint32_t first = 0;

  std::uint32_t sourceOf(std::uint32_t corner) const { return sources.empty() ? first + corner : sources[corner]; }
};
inline constexpr float kNowhere = -3e9f;

/// Numbers of vertices that lie farther apart than this are not run through from the first to the last.
inline constexpr std::uint32_t kWidestRun = 4 * kClusterTriangles;

struct VertexRun {
  std::uint32_t first = 0, count = 0;
};

HWY_INLINE VertexRun vertexRun(const std::uint32_t* indices, std::size_t count) {
  std::uint32_t least = indices[0];
  std::uint32_t most = indices[0];
  const std::size_t whole = count / kLanes * kLanes;
  if (whole > 0) {
    Int leasts = load(indices), mosts = leasts;
    for (std::size_t i = kLanes; i < whole; i += kLanes) {
      const Int values = load(indices + i);
      leasts = min(leasts, values);
      mosts = max(mosts, values);
    }
    alignas(64) std::uint32_t lanes[2][kLanes];
    store(leasts, lanes[0]);
    store(mosts, lanes[1]);
    least = *std::min_element(lanes[0], lanes[0] + kLanes);
    most = *std::max_element(lanes[1], lanes[1] + kLanes);
  }
  for (std::size_t i = whole; i < count; ++i) {
    least = std::min(least, indices[i]);
    most = std::max(most, indices[i]);
  }
  return {least, most - least + 1};
}

/// `vertices`: those of the draw's primitive, and what follows them.
HWY_INLINE void placeCorners(const RasterView& view, const glm::mat4& m, std::span<const glm::vec3> vertices,
                             std::size_t count, PlacedCorners& out) {
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  if (out.places.size() < 4 * whole) out.places.resize(4 * whole);
  const glm::vec2 guard(view.guard());
  const glm::vec2 middle(view.middle());
  const float* positions = &vertices[0].x;
  const auto row = [&](int r, const Float3& p) HWY_ATTR {
    return mulAdd(p.x, m[0][r], mulAdd(p.y, m[1][r], mulAdd(p.z, m[2][r], Float(m[3][r]))));
  };
  for (std::size_t i = 0; i < count; i += kLanes) {
    Float3 p;
    if (out.sources.empty() && out.first + i + kLanes <= vertices.size()) {
      p = loadVectors(positions + 3 * (out.first + i));
    } else {
      const Int corner =
          min(laneNumbers() + Int(static_cast<std::int32_t>(i)), Int(static_cast<std::int32_t>(count) - 1));
      const Int source = (out.sources.empty() ? corner + Int(static_cast<std::int32_t>(out.first))
                                              : gather(out.sources.data(), corner)) *
                         3;
      p = {gather(positions, source), gather(positions + 1, source), gather(positions + 2, source)};
    }
    const Float x = row(0, p), y = row(1, p), z = row(2, p), w = row(3, p);
    Mask inside = (w > 0.0f) & (abs(x) <= w * guard.x) & (abs(y) <= w * guard.y);
    if (view.range == DepthRange::reversed) inside = inside & (z >= 0.0f) & (z <= w);
    const Float over = Float(1.0f) / select(inside, w, 1.0f);
    const Float place[4] = {select(inside, mulAdd(x * over, middle.x, middle.x), kNowhere),
                            mulAdd(y * over, middle.y, middle.y), z * over, Float(0.0f)};
    storeFours(place, &out.places[4 * i]);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
