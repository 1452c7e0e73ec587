#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/bake/light_map.h"
#include "renderer/bake/light_map_layout.h"
#include "renderer/core/rect.h"
#include "renderer/core/stop.h"

/// Fills a light map texel by texel, whatever light it is of.
namespace gnomon {

/// Places along each side of a texel.
inline constexpr int kTexelPlaces = 4;

/// A place of a texel, on the surface that lies there.
struct TexelPlace {
  PlacedTriangle triangle;
  glm::dvec2 weights{0}; ///< of the triangle's second and third corner
  glm::ivec2 texel{0};   ///< of the map
  int number = 0;        ///< of the texel's places, row by row
};

/// How many texels lie in a rectangle of the map.
inline std::size_t texelsIn(const Rect& rect) {
  return static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height);
}

/// Which of them a texel is, row by row. REQUIRES: it lies there.
inline std::size_t texelIn(const Rect& rect, const glm::ivec2& texel) {
  return static_cast<std::size_t>((texel.y - rect.y) * rect.width + (texel.x - rect.x));
}

/// Shares of a light that are summed over the places of texels. One thread at a time.
class TexelSums {
 public:
  static constexpr std::int32_t kUncovered = -1; ///< the share of a texel that has no places

  virtual ~TexelSums() = default;

  virtual void add(const TexelPlace& place) = 0;

  /// Of each plane of the map the means of all texels, row by row, 0..65535 or kUncovered.
  virtual std::vector<std::vector<std::int32_t>> means() = 0;
};

/// Sums for a rectangle of the map, each of whose texels has at most so many places; where `goOn` says no, the means
/// are not used.
using MakeTexelSums = std::function<std::unique_ptr<TexelSums>(const Rect& rect, int places, const GoOn& goOn)>;

/// A map for each of `planes`: the means of places all over every texel that a surface covers. What no surface covers
/// takes on what lies nearest in its chart. The same for any number of threads. Nothing where `progress` asks to stop.
std::optional<std::vector<LightMap>> bakeTexels(const LightMapLayout& layout, std::size_t planes,
                                                const MakeTexelSums& sums, const Progress& progress);

} // namespace gnomon
