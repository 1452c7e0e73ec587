#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "renderer/core/stop.h"
#include "renderer/reference/reference.h"

namespace gnomon {

/// The class of a share of light.
inline bool isLit(float value) {
  return value >= 0.5f;
}

/// Which neighbours show one continuous surface, a value a pixel. Silhouettes part them, and so they are no edges of a
/// shadow.
struct SurfaceLinks {
  std::vector<std::uint8_t> right; ///< 1 = with the next pixel of the row
  std::vector<std::uint8_t> below; ///< 1 = with the one under it
};

/// Each point lies within a pixel's width of the plane through the other's surface, or no farther off it than the arc
/// between two normals that differ little.
SurfaceLinks surfaceLinks(const Reference& truth);

/// The edge pixels of a shadow: receivers with a neighbour to the left, right, above or below that is one, too, shows
/// the same surface, and is of the other class. Those on the two sides, a value a pixel.
struct ShadowEdges {
  std::vector<std::uint8_t> lit;      ///< 1 = lit, next to shadow
  std::vector<std::uint8_t> shadowed; ///< 1 = in shadow, next to light
  bool none = true;
};

ShadowEdges shadowEdges(const Reference& truth, const SurfaceLinks& links, std::span<const std::uint8_t> receiver,
                        std::span<const float> values);

/// Length of those edges in pixels, as if they were drawn with a pen and not along the pixels' sides: straight ones are
/// right whatever their angle.
double edgeLength(const Reference& truth, const SurfaceLinks& links, std::span<const std::uint8_t> receiver,
                  std::span<const float> values);

/// Two neighbours: b lies right of a, or under it.
struct PixelPair {
  std::size_t a = 0; ///< indices into the picture
  std::size_t b = 0;
  int x = 0; ///< of a
  int y = 0;
  bool across = false; ///< true = b lies right of a
};

template <class Visit>
void forEachPair(int width, int height, Visit visit) {
  for (int y = 0; y < height; ++y) {
    stopIfAsked();
    for (int x = 0; x < width; ++x) {
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (x + 1 < width) visit(PixelPair{at, at + 1, x, y, true});
      if (y + 1 < height) visit(PixelPair{at, at + static_cast<std::size_t>(width), x, y, false});
    }
  }
}

/// Visits the pairs of receivers on one surface, one of them lit and one not: the sides of pixels that make up an edge.
template <class Visit>
void forEachCrack(const Reference& truth, const SurfaceLinks& links, std::span<const std::uint8_t> receiver,
                  std::span<const float> values, Visit visit) {
  forEachPair(truth.width, truth.height, [&](const PixelPair& pair) {
    if (receiver[pair.a] == 0 || receiver[pair.b] == 0) return;
    if (isLit(values[pair.a]) == isLit(values[pair.b])) return;
    if ((pair.across ? links.right : links.below)[pair.a] != 0) visit(pair);
  });
}

/// The edge's normal at a side of a pixel that it runs along, by the pixels of one class and the other around: unit
/// length, on the picture, x right and y down. Absent where there are too few.
std::optional<glm::dvec2> edgeNormal(const Reference& truth, std::span<const std::uint8_t> receiver,
                                     std::span<const float> values, const PixelPair& pair);

/// How much of the edge's own length goes along that side: the cosine between the two; all where the normal is absent.
double lengthAlong(const PixelPair& pair, const std::optional<glm::dvec2>& normal);

} // namespace gnomon
