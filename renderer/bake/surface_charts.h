#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/bake/flat_triangles.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A connected piece of a surface, laid flat without folds.
struct SurfaceChart {
  std::vector<std::uint32_t> triangles; ///< of the primitive
  std::vector<FlatTriangle> flat;       ///< one a triangle; metres, or of TEXCOORD_1; the lowest corner at 0 0
  glm::dvec2 size{0};
};

/// The charts that the primitive's TEXCOORD_1 makes of it, as large as they are in the world on the whole. Nothing
/// where these coordinates leave 0..1, where charts overlap, or where a triangle with an area has none there.
std::optional<std::vector<SurfaceChart>> authoredChartsOf(const Scene& scene, const Primitive& primitive,
                                                          const glm::dmat4& worldFromLocal);

/// Cuts a placed primitive into charts: neighbours whose normals lie within 45 degrees of the first triangle's stay
/// together, seen along their mean normal. Every triangle is in exactly one chart, but for those
/// without an area and slivers, which are in none. The same for the same
/// mesh.
std::vector<SurfaceChart> chartsOf(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal);

} // namespace gnomon
