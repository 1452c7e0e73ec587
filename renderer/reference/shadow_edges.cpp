#include "renderer/reference/shadow_edges.h"

#include <algorithm>
#include <cmath>

#include "renderer/reference/pixel_pairs.h"

namespace gnomon {
namespace {

constexpr double kSmooth = 0.94; ///< cosine of 20 degrees: normals that differ more are a crease

bool continuous(const Reference& truth, std::size_t a, std::size_t b) {
  const SurfacePoint& p = truth.surface[a];
  const SurfacePoint& q = truth.surface[b];
  if (p.instance == kNoSurface || q.instance == kNoSurface) return false;
  const glm::dvec3 way = q.position - p.position;
  const glm::dvec3 pNormal(p.normal);
  const glm::dvec3 qNormal(q.normal);
  double slack = std::max(truth.pixelWidth[a], truth.pixelWidth[b]);
  // A chord of a circle meets it at half the angle between its ends' normals.
  if (glm::dot(pNormal, qNormal) > kSmooth) slack += 0.5 * glm::length(way) * glm::length(pNormal - qNormal);
  return std::abs(glm::dot(pNormal, way)) <= slack && std::abs(glm::dot(qNormal, way)) <= slack;
}

} // namespace

SurfaceLinks surfaceLinks(const Reference& truth) {
  SurfaceLinks links{std::vector<std::uint8_t>(truth.surface.size()), std::vector<std::uint8_t>(truth.surface.size())};
  forEachPair(truth.width, truth.height, [&](const PixelPair& pair) {
    (pair.across ? links.right : links.below)[pair.a] = continuous(truth, pair.a, pair.b) ? 1 : 0;
  });
  return links;
}

ShadowEdges shadowEdges(const Reference& truth, const SurfaceLinks& links, std::span<const std::uint8_t> receiver,
                        std::span<const float> values) {
  ShadowEdges edges{std::vector<std::uint8_t>(values.size()), std::vector<std::uint8_t>(values.size())};
  forEachCrack(truth, links, receiver, values, [&](const PixelPair& pair) {
    const bool litFirst = isLit(values[pair.a]);
    edges.lit[litFirst ? pair.a : pair.b] = 1;
    edges.shadowed[litFirst ? pair.b : pair.a] = 1;
    edges.none = false;
  });
  return edges;
}

} // namespace gnomon
