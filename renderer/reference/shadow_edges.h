#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

} // namespace gnomon
