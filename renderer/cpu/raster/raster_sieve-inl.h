// From a draw's triangles to those that are rastered: what can't cover a wanted sample, or faces the wrong way, goes.
#if defined(GNOMON_CPU_RASTER_SIEVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_RASTER_SIEVE_INL_H
#undef GNOMON_CPU_RASTER_SIEVE_INL_H
#else
#define GNOMON_CPU_RASTER_SIEVE_INL_H
#endif

#include <array>
#include <bit>

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/lanes/packing-inl.h"
#include "renderer/cpu/raster/raster_corners-inl.h"
#include "renderer/cpu/raster/raster_wide.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// Sixteen triangles on the picture.
struct Sieved {
  Int at[3];        ///< of their corners in PlacedCorners
  Float x[3], y[3]; ///< 1/256 of a pixel
  Float z[3];
  Int snappedX[3], snappedY[3];
  Int area;                         ///< twice, signed; means something where they are small
  Int firstX, firstY, lastX, lastY; ///< pixels that they may cover a sample of
};

/// The triangles of one draw that are left.
class TriangleSieve {
 public:
  TriangleSieve(const RasterView& view, const RasterDraw& draw, TriangleGroup& group)
      : view_(view), wide_{view, draw.facing, draw.holed}, firstNumber_(draw.slot * kClusterTriangles), group_(group) {}

  /// `indices`: null = corners follow each other. `clipOf(corner)`: where it lies in clip space.
  template <class ClipOf>
  HWY_INLINE void run(const PlacedCorners& corners, const std::uint32_t* indices, std::uint32_t triangles,
                      const ClipOf& clipOf) {
    for (std::uint32_t t = 0; t < triangles; t += kLanes) {
      Sieved s;
      place(corners, indices, t, triangles, s);
      const Int leastX = min(min(s.snappedX[0], s.snappedX[1]), s.snappedX[2]);
      const Int leastY = min(min(s.snappedY[0], s.snappedY[1]), s.snappedY[2]);
      const Int mostX = max(max(s.snappedX[0], s.snappedX[1]), s.snappedX[2]);
      const Int mostY = max(max(s.snappedY[0], s.snappedY[1]), s.snappedY[2]);
      const Mask placed = min(min(s.x[0], s.x[1]), s.x[2]) > kNowhere;
      s.firstX = max(shiftRight<8>(leastX + Int(kSubpixels - 1 - view_.lastSample.x)), Int(0));
      s.firstY = max(shiftRight<8>(leastY + Int(kSubpixels - 1 - view_.lastSample.y)), Int(0));
      s.lastX = min(shiftRight<8>(mostX - Int(view_.firstSample.x)), Int(view_.width - 1));
      s.lastY = min(shiftRight<8>(mostY - Int(view_.firstSample.y)), Int(view_.height - 1));
      const Mask real = firstLanes(std::min<std::uint32_t>(kLanes, triangles - t));
      const Mask sampled = (s.firstX <= s.lastX) & (s.firstY <= s.lastY);
      const Int sizeX = mostX - leastX, sizeY = mostY - leastY;
      const Mask close = placed & (sizeX < Int(kSmallSide)) & (sizeY < Int(kSmallSide));
      s.area = (s.snappedX[1] - s.snappedX[0]) * (s.snappedY[2] - s.snappedY[0]) -
               (s.snappedX[2] - s.snappedX[0]) * (s.snappedY[1] - s.snappedY[0]);
      const Mask faces = wide_.facing == Facing::both               ? s.area != Int(0)
                         : wide_.facing == Facing::counterClockwise ? s.area > Int(0)
                                                                    : s.area < Int(0);
      // Depths of what is almost a line are not for floats.
      const Int size = max(s.area, Int(0) - s.area);
      const Mask broad = shiftRight<8>(sizeX * sizeY) <= size;
      const Mask candidates = real & ((close & faces & sampled) | andNot(close, sampled | !placed));
      if (none(candidates)) continue;
      const Mask kept = touching(s, corners, t, candidates, close & broad, clipOf);
      if (any(kept)) setUp(s, t, kept);
    }
  }

 private:
  HWY_INLINE static void place(const PlacedCorners& corners, const std::uint32_t* indices, std::uint32_t t,
                               std::uint32_t triangles, Sieved& s) {
    if (indices != nullptr && t + kLanes <= triangles) {
      loadTriples(indices + 3 * std::size_t{t}, s.at[0], s.at[1], s.at[2]);
    } else {
      const Int triangle =
          min(laneNumbers() + Int(static_cast<std::int32_t>(t)), Int(static_cast<std::int32_t>(triangles) - 1)) * 3;
      for (int c = 0; c < 3; ++c) s.at[c] = indices == nullptr ? triangle + Int(c) : gather(indices + c, triangle);
    }
    for (Int& at : s.at) {
      if (indices != nullptr) at = at - Int(static_cast<std::int32_t>(corners.first));
    }
    for (int c = 0; c < 3; ++c) {
      Float place[4];
      gatherFours(corners.places.data(), s.at[c] * 4, place);
      s.x[c] = place[0];
      s.y[c] = place[1];
      s.z[c] = place[2];
      s.snappedX[c] = nearest(s.x[c]);
      s.snappedY[c] = nearest(s.y[c]);
    }
  }

  /// Adds what the candidates touch, one at a time and in their order; those that are not small are done with then.
  /// Gives the small ones that touch anything.
  template <class ClipOf>
  HWY_INLINE Mask touching(const Sieved& s, const PlacedCorners& corners, std::uint32_t t, const Mask& candidates,
                           const Mask& small, const ClipOf& clipOf) {
    const Int squareX = shiftRight<6>(s.firstX), squareY = shiftRight<6>(s.firstY);
    const Mask inOne = (squareX == shiftRight<6>(s.lastX)) & (squareY == shiftRight<6>(s.lastY));
    alignas(64) std::int32_t squares[kLanes], box[4][kLanes];
    store(squareY * Int(view_.squaresAcross) + squareX, squares);
    store(s.firstX, box[0]);
    store(s.firstY, box[1]);
    store(s.lastX, box[2]);
    store(s.lastY, box[3]);
    const auto block = [&](int side, unsigned lane) { return box[side][lane] / kMarkSide % 8; };
    const unsigned smallBits = bitsOf(small);
    const unsigned inOneBits = bitsOf(small & inOne);
    const auto first = static_cast<std::uint32_t>(group_.small.end());
    unsigned kept = 0;
    std::uint32_t count = 0;
    for (unsigned bits = bitsOf(candidates); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<unsigned>(std::countr_zero(bits));
      unsigned touches = 1;
      if ((inOneBits >> lane & 1u) != 0) {
        const auto square = static_cast<std::uint32_t>(squares[lane]);
        // No branch: whether a triangle is wanted is hard to foretell.
        if (view_.only != nullptr) {
          const std::uint64_t own = blockBits(block(0, lane), block(2, lane), block(1, lane), block(3, lane));
          touches = (view_.only->in(square)&own) != 0 ? 1 : 0;
        }
        *group_.touches.room(1) = {square, first + count};
        group_.touches.add(std::size_t{touches});
      } else if ((smallBits >> lane & 1u) != 0) {
        touches = addTouches({box[0][lane], box[1][lane], box[2][lane], box[3][lane]}, first + count) ? 1 : 0;
      } else {
        alignas(64) std::uint32_t at[3][kLanes];
        for (int c = 0; c < 3; ++c) store(s.at[c], at[c]);
        addWide(wide_, wideCorners(corners, {at[0][lane], at[1][lane], at[2][lane]}, clipOf), firstNumber_ + t + lane,
                group_);
        touches = 0;
      }
      kept |= touches << lane;
      count += touches;
    }
    return maskOf(kept);
  }

  /// Of a small triangle in several squares; false where no square wants it.
  HWY_INLINE bool addTouches(const PixelBox& pixels, std::uint32_t entry) {
    bool touches = false;
    for (int y = pixels.y0 / kSquareSide; y <= pixels.y1 / kSquareSide; ++y) {
      for (int x = pixels.x0 / kSquareSide; x <= pixels.x1 / kSquareSide; ++x) {
        if (!isWanted(view_, pixels, x, y)) continue;
        group_.touches.add({static_cast<std::uint32_t>(y * view_.squaresAcross + x), entry});
        touches = true;
      }
    }
    return touches;
  }

  template <class ClipOf>
  HWY_INLINE std::array<WideCorner, 3> wideCorners(const PlacedCorners& corners,
                                                   const std::array<std::uint32_t, 3>& own,
                                                   const ClipOf& clipOf) const {
    std::array<WideCorner, 3> wide;
    for (std::size_t c = 0; c < 3; ++c) {
      const float* place = &corners.places[4 * std::size_t{own[c]}];
      wide[c].at = glm::dvec2(place[0], place[1]);
      wide[c].z = static_cast<double>(place[2]);
      wide[c].placed = place[0] > kNowhere;
      wide[c].clip = clipOf(own[c]);
    }
    return wide;
  }

  /// Puts the fields of the triangles `kept`, one behind the other, into the group.
  HWY_INLINE void setUp(const Sieved& s, std::uint32_t t, const Mask& kept) {
    const std::size_t end = group_.small.end();
    float* const to = group_.small.at(end);
    const Packing packing(kept);
    const auto put = [&](std::size_t field, const Float& value)
                         HWY_ATTR { packing.store(value, to + field * SmallTriangles::kStride); };
    const auto putInt = [&](std::size_t field, const Int& value) HWY_ATTR { put(field, floatOf(value)); };
    const Mask turned = s.area < Int(0);
    const auto corner = [&](const auto* of, int c)
                            HWY_ATTR { return c == 0 ? of[0] : select(turned, of[3 - c], of[c]); };
    const Int firstColumn = shiftRight<2>(s.firstX), firstRow = shiftRight<2>(s.firstY);
    const glm::ivec2* places = samplePlaces(view_.samples).data();
    // From there on: the first sample of the first block's lower left pixel.
    const Int originX = shiftLeft<10>(firstColumn) + Int(places[0].x);
    const Int originY = shiftLeft<10>(firstRow) + Int(places[0].y);
    for (int i = 0; i < 3; ++i) {
      const Int fromX = corner(s.snappedX, i), fromY = corner(s.snappedY, i);
      const Int a = fromY - corner(s.snappedY, (i + 1) % 3);
      const Int b = corner(s.snappedX, (i + 1) % 3) - fromX;
      if (i < 2) {
        put(static_cast<std::size_t>(kSideA0 + 2 * i), toFloat(a));
        put(static_cast<std::size_t>(kSideB0 + 2 * i), toFloat(b));
      }
      // Corners go round counter-clockwise, y up: a left side goes down, an upper one to the left.
      const Mask owns = (a > Int(0)) | ((a == Int(0)) & (b < Int(0)));
      const Int value = a * (originX - fromX) + b * (originY - fromY) - select(owns, Int(0), Int(1));
      for (int k = 0; k < view_.samples; ++k) {
        const glm::ivec2 place = places[k] - places[0];
        const Int own = shiftRight<8>(value + a * Int(place.x) + b * Int(place.y));
        put(static_cast<std::size_t>(kLeastValues + i * view_.samples + k), toFloat(Int(0) - own));
      }
    }
    const Float p[3] = {s.z[0], corner(s.z, 1), corner(s.z, 2)};
    putPlane(s, turned, p, toFloat(originX), toFloat(originY), put);
    putInt(kFirstBlock, firstColumn | shiftLeft<14>(firstRow));
    const Int flags = select(turned, Int(static_cast<std::int32_t>(kTurned)), Int(0)) |
                      Int(static_cast<std::int32_t>(wide_.holed ? kHoled : 0u));
    putInt(kLastBlock, shiftRight<2>(s.lastX) | shiftLeft<14>(shiftRight<2>(s.lastY)) | flags);
    putInt(kNumber, laneNumbers() + Int(static_cast<std::int32_t>(firstNumber_ + t)));
    group_.small.add(packing.count());
  }

  /// Through the corners where they are, not where they are snapped to, as drivers of OpenGL do; but where snapping
  /// made most of the area, that of the snapped ones.
  template <class Put>
  HWY_INLINE void putPlane(const Sieved& s, const Mask& turned, const Float* z, const Float& originX,
                           const Float& originY, const Put& put) {
    const auto stepsFrom0 = [&](const Float* at, Float* steps) HWY_ATTR {
      steps[0] = select(turned, at[2], at[1]) - at[0];
      steps[1] = select(turned, at[1], at[2]) - at[0];
    };
    Float x[2], y[2];
    stepsFrom0(s.x, x);
    stepsFrom0(s.y, y);
    const Float snappedArea = abs(toFloat(s.area));
    const Float area = x[0] * y[1] - x[1] * y[0];
    const Mask sound = (area > 0.5f * snappedArea) & (area < 2.0f * snappedArea);
    Float fromX = s.x[0], fromY = s.y[0];
    Float over = Float(static_cast<float>(kSubpixels)) / select(sound, area, snappedArea);
    if (!all(sound)) {
      const Float snappedX[3] = {toFloat(s.snappedX[0]), toFloat(s.snappedX[1]), toFloat(s.snappedX[2])};
      const Float snappedY[3] = {toFloat(s.snappedY[0]), toFloat(s.snappedY[1]), toFloat(s.snappedY[2])};
      Float otherX[2], otherY[2];
      stepsFrom0(snappedX, otherX);
      stepsFrom0(snappedY, otherY);
      for (int i = 0; i < 2; ++i) {
        x[i] = select(sound, x[i], otherX[i]);
        y[i] = select(sound, y[i], otherY[i]);
      }
      fromX = select(sound, fromX, snappedX[0]);
      fromY = select(sound, fromY, snappedY[0]);
    }
    const Float z1 = z[1] - z[0], z2 = z[2] - z[0];
    const Float dx = (z1 * y[1] - z2 * y[0]) * over;
    const Float dy = (z2 * x[0] - z1 * x[1]) * over;
    constexpr float kPixel = 1.0f / kSubpixels;
    put(kDepth, z[0] + (dx * (originX - fromX) + dy * (originY - fromY)) * kPixel);
    put(kDepthX, dx);
    put(kDepthY, dy);
    Float least = min(min(z[0], z[1]), z[2]), most = max(max(z[0], z[1]), z[2]);
    if (view_.range == DepthRange::clamped) {
      least = clamp(least, 0.0f, 1.0f);
      most = clamp(most, 0.0f, 1.0f);
    }
    put(kLeastDepth, least);
    put(kMostDepth, most);
  }

  const RasterView& view_;
  WideDraw wide_;
  std::uint32_t firstNumber_;
  TriangleGroup& group_;
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
