// From a draw's triangles to corners on the picture's grid: what can't cover a sample, or faces the wrong way, goes.
#if defined(GNOMON_CPU_RASTER_CORNERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_CORNERS_INL_H
#undef GNOMON_CPU_RASTER_CORNERS_INL_H
#else
#define GNOMON_CPU_RASTER_CORNERS_INL_H
#endif

#include <algorithm>

#include "renderer/cpu/lanes/lanes-inl.h"
#include "renderer/cpu/raster/raster_clip.h"
#include "renderer/cpu/raster/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The corners of a draw's vertices; one that lies outside of what may be rastered has no place, and is clipped with
/// its triangle.
struct PlacedCorners {
  std::vector<std::int32_t> x, y;
  std::vector<float> z;
  std::vector<std::int32_t> outside;  ///< 1 = has no place
  std::vector<std::uint32_t> sources; ///< corner k is of vertex sources[k]; empty = of vertex first + k
  std::uint32_t first = 0;

  std::uint32_t sourceOf(std::uint32_t corner) const { return sources.empty() ? first + corner : sources[corner]; }
};

/// Numbers of vertices that lie farther apart than this are not run through from the first to the last.
inline constexpr std::uint32_t kWidestRun = 4 * kClusterTriangles;

struct VertexRun {
  std::uint32_t first = 0, count = 0;
};

HWY_INLINE VertexRun vertexRun(const std::uint32_t* indices, std::size_t count) {
  std::uint32_t least = indices[0];
  std::uint32_t most = indices[0];
  for (std::size_t i = 0; i < count; ++i) {
    least = std::min(least, indices[i]);
    most = std::max(most, indices[i]);
  }
  return {least, most - least + 1};
}

HWY_INLINE void placeCorners(const RasterView& view, const glm::mat4& m, const glm::vec3* vertices, std::size_t count,
                             PlacedCorners& out) {
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  out.x.resize(whole);
  out.y.resize(whole);
  out.z.resize(whole);
  out.outside.resize(whole);
  const glm::vec2 guard(view.guard());
  const glm::vec2 middle(view.middle());
  const float* positions = &vertices[0].x;
  const auto row = [&](int r, const Float& px, const Float& py, const Float& pz) HWY_ATTR {
    return mulAdd(px, m[0][r], mulAdd(py, m[1][r], mulAdd(pz, m[2][r], Float(m[3][r]))));
  };
  for (std::size_t i = 0; i < count; i += kLanes) {
    const Int corner =
        min(laneNumbers() + Int(static_cast<std::int32_t>(i)), Int(static_cast<std::int32_t>(count) - 1));
    const Int source = (out.sources.empty() ? corner : gather(out.sources.data(), corner)) * 3;
    const Float px = gather(positions, source);
    const Float py = gather(positions + 1, source);
    const Float pz = gather(positions + 2, source);
    const Float x = row(0, px, py, pz);
    const Float y = row(1, px, py, pz);
    const Float z = row(2, px, py, pz);
    const Float w = row(3, px, py, pz);
    Mask inside = (w > 0.0f) & (abs(x) <= w * guard.x) & (abs(y) <= w * guard.y);
    if (view.range == DepthRange::reversed) inside = inside & (z >= 0.0f) & (z <= w);
    const Float over = Float(1.0f) / select(inside, w, 1.0f);
    store(nearest(mulAdd(x * over, middle.x, middle.x)), &out.x[i]);
    store(nearest(mulAdd(y * over, middle.y, middle.y)), &out.y[i]);
    store(z * over, &out.z[i]);
    store(select(inside, Int(0), Int(1)), &out.outside[i]);
  }
}

/// The triangles of one draw that are left.
class TriangleSieve {
 public:
  TriangleSieve(const RasterView& view, const RasterDraw& draw, std::vector<RasterTriangle>& kept)
      : view_(view),
        facing_(draw.facing),
        firstNumber_(draw.slot * kClusterTriangles),
        holed_(draw.holed),
        kept_(kept) {}

  /// `clipOf(corner)`: where a corner that has no place lies in clip space.
  template <class ClipOf>
  HWY_INLINE void run(const PlacedCorners& corners, const std::uint32_t* indices, std::uint32_t triangles,
                      std::uint32_t firstVertex, const ClipOf& clipOf) {
    // Of a triangle whose corners lie closer than this, areas fit into 32 bits.
    constexpr std::int32_t kSmall = 1 << 14;
    for (std::uint32_t t = 0; t < triangles; t += kLanes) {
      const std::uint32_t count = std::min<std::uint32_t>(kLanes, triangles - t);
      const Int triangle =
          min(laneNumbers() + Int(static_cast<std::int32_t>(t)), Int(static_cast<std::int32_t>(triangles) - 1));
      Int at[3], x[3], y[3];
      Int outside(0);
      for (int c = 0; c < 3; ++c) {
        at[c] = indices == nullptr ? triangle * 3 + Int(c)
                                   : gather(indices + c, triangle * 3) - Int(static_cast<std::int32_t>(firstVertex));
        x[c] = gather(corners.x.data(), at[c]);
        y[c] = gather(corners.y.data(), at[c]);
        outside = outside | gather(corners.outside.data(), at[c]);
      }
      const Int leastX = min(min(x[0], x[1]), x[2]), mostX = max(max(x[0], x[1]), x[2]);
      const Int leastY = min(min(y[0], y[1]), y[2]), mostY = max(max(y[0], y[1]), y[2]);
      const Mask real = firstLanes(count);
      const Mask placed = outside == Int(0);
      const Mask small = placed & (mostX - leastX < Int(kSmall)) & (mostY - leastY < Int(kSmall));
      const Int area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
      const Mask faces = facing_ == Facing::both               ? area != Int(0)
                         : facing_ == Facing::counterClockwise ? area > Int(0)
                                                               : area < Int(0);
      const Mask sampled = mayHoldSample(leastX, mostX, view_.firstSample.x, view_.lastSample.x, view_.width) &
                           mayHoldSample(leastY, mostY, view_.firstSample.y, view_.lastSample.y, view_.height);
      const unsigned clockwise = bitsOf(area < Int(0));
      for (unsigned bits = bitsOf(real & small & faces & sampled); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(bits));
        keep(cornersOf(corners, indices, t + lane, firstVertex), t + lane, (clockwise >> lane & 1u) != 0);
      }
      // What is large or has to be clipped, one at a time.
      const Mask wide = andNot(small, real) & (sampled | !placed);
      for (unsigned bits = bitsOf(wide), clip = bitsOf(!placed); bits != 0; bits &= bits - 1) {
        const auto lane = static_cast<unsigned>(__builtin_ctz(bits));
        const std::array<std::uint32_t, 3> own = localsOf(indices, t + lane, firstVertex);
        if ((clip >> lane & 1u) != 0) {
          clipAndKeep(corners, own, t + lane, clipOf);
        } else {
          measureAndKeep(cornersOf(corners, indices, t + lane, firstVertex), t + lane);
        }
      }
    }
  }

 private:
  static constexpr double kLeastDivisor = 1e-300; ///< the guard leaves x = y = 0 of what has none

  static HWY_INLINE Mask mayHoldSample(const Int& least, const Int& most, int firstSample, int lastSample, int size) {
    const Int first = max(shiftRight<8>(least + Int(kSubpixels - 1 - lastSample)), Int(0));
    const Int last = min(shiftRight<8>(most - Int(firstSample)), Int(size - 1));
    return first <= last;
  }

  static HWY_INLINE std::array<std::uint32_t, 3> localsOf(const std::uint32_t* indices, std::uint32_t triangle,
                                                          std::uint32_t firstVertex) {
    if (indices == nullptr) return {3 * triangle, 3 * triangle + 1, 3 * triangle + 2};
    const std::uint32_t* own = indices + 3 * std::size_t{triangle};
    return {own[0] - firstVertex, own[1] - firstVertex, own[2] - firstVertex};
  }

  static HWY_INLINE std::array<Corner, 3> cornersOf(const PlacedCorners& corners, const std::uint32_t* indices,
                                                    std::uint32_t triangle, std::uint32_t firstVertex) {
    const std::array<std::uint32_t, 3> own = localsOf(indices, triangle, firstVertex);
    std::array<Corner, 3> out;
    for (std::size_t c = 0; c < 3; ++c) out[c] = {corners.x[own[c]], corners.y[own[c]], corners.z[own[c]]};
    return out;
  }

  HWY_INLINE void keep(const std::array<Corner, 3>& corners, std::uint32_t triangle, bool clockwise) {
    kept_.push_back({corners, firstNumber_ + triangle, holed_, clockwise});
    if (clockwise) std::swap(kept_.back().corners[1], kept_.back().corners[2]);
  }

  HWY_INLINE void measureAndKeep(const std::array<Corner, 3>& c, std::uint32_t triangle) {
    const std::int64_t area =
        std::int64_t{c[1].x - c[0].x} * (c[2].y - c[0].y) - std::int64_t{c[2].x - c[0].x} * (c[1].y - c[0].y);
    if (area == 0 || (facing_ != Facing::both && (area > 0) != (facing_ == Facing::counterClockwise))) return;
    keep(c, triangle, area < 0);
  }

  template <class ClipOf>
  HWY_INLINE void clipAndKeep(const PlacedCorners& corners, const std::array<std::uint32_t, 3>& own,
                              std::uint32_t triangle, const ClipOf& clipOf) {
    const ClipPolygon polygon =
        clipped({clipOf(own[0]), clipOf(own[1]), clipOf(own[2])}, view_.guard(), view_.range == DepthRange::reversed);
    std::array<Corner, 9> placed;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const ClipCorner& corner = polygon.corners[i];
      // A corner that the triangle shares with others has the place that they have.
      const std::uint32_t source = corner.own < 0 ? 0 : own[static_cast<std::size_t>(corner.own)];
      if (corner.own >= 0 && corners.outside[source] == 0) {
        placed[i] = {corners.x[source], corners.y[source], corners.z[source]};
        continue;
      }
      const double w = std::max(corner.clip.w, kLeastDivisor);
      const glm::dvec2 at = glm::dvec2(corner.clip) / w * view_.middle() + view_.middle();
      placed[i] = {static_cast<std::int32_t>(std::lround(at.x)), static_cast<std::int32_t>(std::lround(at.y)),
                   static_cast<float>(corner.clip.z / w)};
    }
    for (std::size_t i = 2; i < polygon.count; ++i) measureAndKeep({placed[0], placed[i - 1], placed[i]}, triangle);
  }

  const RasterView& view_;
  Facing facing_;
  std::uint32_t firstNumber_;
  bool holed_;
  std::vector<RasterTriangle>& kept_;
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
