#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"
#include "renderer/bake/surface_charts.h"
#include "renderer/core/rect.h"

namespace gnomon {

/// How finely a light map shows the scene's surfaces: exactly one of the two.
struct LightMapFineness {
  std::optional<double> texelsPerMetre;
  std::optional<int> size; ///< texels along the longer side of the map, at most: as fine as fits
};

/// A chart in the map. No other chart's texels lie in its rectangle, which leaves a texel free around it: what is read
/// between four texels there is the chart's own.
struct PlacedChart {
  std::uint32_t instance = 0;           ///< index into SceneView::instances
  std::vector<std::uint32_t> triangles; ///< of its primitive
  Rect rect;                            ///< texels
};

/// Where the triangles of a scene lie in its light map. Texel x y covers the square from x y to x + 1 y + 1.
struct LightMapLayout {
  int width = 0; ///< texels
  int height = 0;
  double texelsPerMetre = 0;
  std::vector<PlacedChart> charts;
  std::vector<std::size_t> firstCorner; ///< of each instance, into `corners`
  std::vector<glm::vec2> corners;       ///< three a triangle, texels; of a triangle without an area 0 0
  std::vector<std::uint8_t> authored;   ///< one an instance: its charts are those of TEXCOORD_1

  /// The three of a triangle.
  const glm::vec2* cornersOf(const PlacedTriangle& placed) const {
    return &corners[firstCorner[placed.instance] + 3 * std::size_t{placed.triangle}];
  }
  FlatTriangle flat(const PlacedTriangle& placed) const {
    const glm::vec2* at = cornersOf(placed);
    return {glm::dvec2(at[0]), glm::dvec2(at[1]), glm::dvec2(at[2])};
  }
};

/// Every instance has its place, as each is shadowed in its own way: by its TEXCOORD_1 where that makes sound charts
/// (authoredChartsOf), else by charts made here. The same for the same scene. A problem where the map would be larger
/// than kLimits.maxLightMapSide, or where not even one texel a chart fits.
Result<LightMapLayout> lightMapLayout(const Scene& scene, const SceneView& view, const LightMapFineness& fineness);

} // namespace gnomon
