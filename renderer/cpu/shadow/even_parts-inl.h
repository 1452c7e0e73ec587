// Parts of the picture that show one triangle each: what their pixels read of a light's tiles lies within what their
// corners read, since pixels of a plane lie in a tile as they do in the picture.
#if defined(GNOMON_CPU_EVEN_PARTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_EVEN_PARTS_INL_H
#undef GNOMON_CPU_EVEN_PARTS_INL_H
#else
#define GNOMON_CPU_EVEN_PARTS_INL_H
#endif

#include <algorithm>
#include <bit>
#include <span>

#include "renderer/cpu/shadow/read_texels-inl.h"
#include "renderer/cpu/shadow/read_texels.h"
#include "renderer/cpu/surface/receivers-inl.h"
#include "renderer/prepare/draw_list.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

inline constexpr int kPartSide = 8;       ///< pixels
inline constexpr unsigned kPartCount = 4; ///< of a square of the picture, two by two, from the lower left one
inline constexpr unsigned kCorners = kLanes / kPartCount;

/// The parts of a square, a bit each.
struct EvenParts {
  unsigned empty = 0;   ///< show nothing
  unsigned covered = 0; ///< show one triangle in all samples of all pixels
  Fragments corners;    ///< four lanes a part: the pixels at the corners of the covered ones
};

/// The bits of lanes that belong to a part.
constexpr unsigned lanesOf(unsigned part) {
  return 0xfu << (kCorners * part);
}

/// The number that all samples of a part show. `left`, `bottom`: the first of its pixels, all of which the picture has.
HWY_INLINE bool showsOne(const DepthBuffer& surfaces, int left, int bottom, std::int32_t& number) {
  number = static_cast<std::int32_t>(surfaces.triangles[surfaces.at(left, bottom)]);
  Int differs(0);
  for (int block = 0; block < 4; ++block) {
    const std::size_t first = surfaces.at(left + block % 2 * kBlockSide, bottom + block / 2 * kBlockSide);
    for (int sample = 0; sample < surfaces.samples; ++sample) {
      const Int own = load(&surfaces.triangles[first + static_cast<std::size_t>(sample * kBlockPlaces)]);
      differs = differs | (own ^ Int(number));
    }
  }
  return all(differs == Int(0));
}

/// Of the square whose lower left pixel is x, y.
HWY_INLINE EvenParts evenParts(const DepthBuffer& surfaces, int x, int y) {
  EvenParts parts;
  alignas(64) std::int32_t numbers[kLanes] = {};
  unsigned shown = 0;
  for (unsigned part = 0; part < kPartCount; ++part) {
    const int left = x + static_cast<int>(part % 2) * kPartSide, bottom = y + static_cast<int>(part / 2) * kPartSide;
    if (left + kPartSide > surfaces.width || bottom + kPartSide > surfaces.height) continue;
    std::int32_t number = 0;
    if (!showsOne(surfaces, left, bottom, number)) continue;
    const bool empty = static_cast<std::uint32_t>(number) == kNoNumber;
    (empty ? parts.empty : parts.covered) |= 1u << part;
    if (empty) continue;
    std::fill_n(&numbers[kCorners * part], kCorners, number);
    shown |= lanesOf(part);
  }
  const Int lane = laneNumbers(), part = shiftRight<2>(lane);
  parts.corners.shown = maskOf(shown);
  parts.corners.triangle = load(numbers);
  parts.corners.x = Int(x) + (part & Int(1)) * Int(kPartSide) + (lane & Int(1)) * Int(kPartSide - 1);
  parts.corners.y = Int(y) + shiftRight<1>(part) * Int(kPartSide) + (shiftRight<1>(lane) & Int(1)) * Int(kPartSide - 1);
  parts.corners.center = {toFloat(parts.corners.x) + 0.5f, toFloat(parts.corners.y) + 0.5f};
  parts.corners.place = parts.corners.center; // the mean of all samples, too
  return parts;
}

/// The first and the last of a light's tiles that each lane, and what is rounded otherwise beside it, may read.
struct TileSpans {
  Int first, last;
};

HWY_INLINE TileSpans tileSpans(const ShadowMaps& maps, const LightData& light, const Float& viewDepth) {
  constexpr float kRounding = 1e-5f;
  return {chooseCascade(maps, light, viewDepth * (1.0f - kRounding)).first,
          chooseCascade(maps, light, viewDepth * (1.0f + kRounding)).second};
}

/// Texels of a tile from a lowest to a greatest one, which belongs to them.
struct ReadBox {
  int x0, y0, x1, y1;
};

/// The texels of a tile that the lanes may read, and those of all places between them.
HWY_INLINE ReadBox texelsBetween(const ShadowMaps& maps, const LightData& light, std::size_t tile,
                                 const Receiver& corners, const Mask& lanes) {
  const Lookup at = lookupIn(light, maps.tiles[tile], corners, Float3(glm::vec3(light.direction)));
  const Float2 rounding(Float(0.5f)); // of places: pixels between the corners are rounded in ways of their own
  const Reached reached =
      reachedAround(placeIn(maps, maps.maps[tile], at), filterReach(maps, light, maps.tiles[tile], at) + rounding);
  return {leastOf(lanes, reached.left), leastOf(lanes, reached.low), mostOf(lanes, reached.right),
          mostOf(lanes, reached.high)};
}

/// Marks what the covered parts read of a light. Gives those of which nothing more need be marked, a bit each.
HWY_INLINE unsigned markCorners(const ShadowMaps& maps, const LightData& light, const Receiver& corners,
                                unsigned covered, std::span<TexelMarks> marks) {
  constexpr std::int32_t kWidest = 48; // a box around more than that holds much that no pixel reads
  const Float3 toLight(glm::vec3(light.direction));
  const Float cosine = dot(corners.normal, toLight);
  // Corners are rounded otherwise than the pixels between them: a part is dark only well beyond kTurnedAway.
  const unsigned lit = bitsOf(receivesShadow(light, corners) & (cosine > 0.5f * kTurnedAway));
  // Of what may stand on the surface that shading shows, each pixel has a place of its own.
  const Mask faces =
      corners.smooth.bends & (cosine < 2.0f * kTurnedAway) & (dot(corners.smooth.normal, toLight) > 0.0f);
  const unsigned standsOff = light.smoothTerminator != 0u ? bitsOf(faces) : 0u;
  const TileSpans spans = tileSpans(maps, light, corners.viewDepth);
  unsigned marked = 0;
  for (unsigned left = covered; left != 0; left &= left - 1) {
    const auto part = static_cast<unsigned>(std::countr_zero(left));
    if ((standsOff & lanesOf(part)) != 0) continue;
    if ((lit & lanesOf(part)) == 0) {
      marked |= 1u << part;
      continue;
    }
    const Mask lanes = maskOf(lanesOf(part));
    const std::size_t first = light.firstTile + static_cast<std::size_t>(leastOf(lanes, spans.first));
    const std::size_t count = light.firstTile + static_cast<std::size_t>(mostOf(lanes, spans.last)) - first + 1;
    ReadBox read[2];
    if (count > std::size(read)) continue;
    bool wide = false;
    for (std::size_t i = 0; i < count; ++i) {
      if (maps.maps[first + i].depths == nullptr) continue;
      read[i] = texelsBetween(maps, light, first + i, corners, lanes);
      wide = wide || read[i].x1 - read[i].x0 >= kWidest || read[i].y1 - read[i].y0 >= kWidest;
    }
    if (wide) continue;
    marked |= 1u << part;
    for (std::size_t i = 0; i < count; ++i) {
      if (maps.maps[first + i].depths == nullptr) continue;
      marks[first + i].mark(read[i].x0, read[i].y0, read[i].x1, read[i].y1);
    }
  }
  return marked;
}

/// Marks what the lights, of which readsAlike holds, read for the covered parts of a square. Gives those of which the
/// corners mark all that any of them reads.
HWY_INLINE unsigned markCorners(const ReadQuery& query, std::span<const std::uint32_t> lights, const EvenParts& parts,
                                std::span<TexelMarks> marks) {
  if (parts.covered == 0) return 0;
  const Receiver corners = receiversOf(query.scene, parts.corners);
  // Of a triangle that is seen edge-on some point is taken, by each pixel another one.
  constexpr float kOutside = 0.1f;
  const Mask sound = (corners.weights.x > -kOutside) & (corners.weights.y > -kOutside) &
                     (corners.weights.x + corners.weights.y < 1.0f + kOutside);
  unsigned marked = 0;
  for (unsigned part = 0; part < kPartCount; ++part) {
    const bool whole = (bitsOf(sound) & lanesOf(part)) == lanesOf(part);
    marked |= whole ? parts.covered & 1u << part : 0u;
  }
  for (const std::uint32_t light : lights) {
    marked &= markCorners(query.maps, query.maps.lights[light], corners, marked, marks);
  }
  return marked;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
