#include "renderer/reference/shadow_edges.h"

#include <algorithm>
#include <cmath>

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

constexpr double kReach = 4.5; ///< pixels: how far around a side the edge's direction is looked for
constexpr double kLeast = 1e-3;

/// Sums over pixels around the middle of a pixel's side, for a plane fitted to what is lit (1) and what is not (0).
struct PlaneFit {
  double weight = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, lit = 0, litX = 0, litY = 0;

  void add(const glm::dvec2& at, double value, double by) {
    weight += by;
    x += by * at.x;
    y += by * at.y;
    xx += by * at.x * at.x;
    xy += by * at.x * at.y;
    yy += by * at.y * at.y;
    lit += by * value;
    litX += by * value * at.x;
    litY += by * value * at.y;
  }

  /// Its slope, by least squares, times a number that is not negative.
  glm::dvec2 slope() const {
    const double sxx = weight * xx - x * x;
    const double sxy = weight * xy - x * y;
    const double syy = weight * yy - y * y;
    const double bx = weight * litX - x * lit;
    const double by = weight * litY - y * lit;
    return {syy * bx - sxy * by, sxx * by - sxy * bx};
  }
};

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

// Pixels count by Tukey's biweight, so that the direction does not jump as they come into reach.
std::optional<glm::dvec2> edgeNormal(const Reference& truth, std::span<const std::uint8_t> receiver,
                                     std::span<const float> values, const PixelPair& pair) {
  const glm::dvec2 middle(pair.x + (pair.across ? 0.5 : 0.0), pair.y + (pair.across ? 0.0 : 0.5));
  constexpr int kPixels = static_cast<int>(kReach);
  PlaneFit fit;
  for (int y = std::max(0, pair.y - kPixels); y <= std::min(truth.height - 1, pair.y + kPixels + 1); ++y) {
    for (int x = std::max(0, pair.x - kPixels); x <= std::min(truth.width - 1, pair.x + kPixels + 1); ++x) {
      const glm::dvec2 way = glm::dvec2(x, y) - middle;
      const double inReach = 1.0 - glm::dot(way, way) / (kReach * kReach);
      const std::size_t at =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(truth.width) + static_cast<std::size_t>(x);
      if (inReach > 0 && receiver[at] != 0) fit.add(way, isLit(values[at]) ? 1.0 : 0.0, inReach * inReach);
    }
  }
  const glm::dvec2 slope = fit.slope();
  const double length = glm::length(slope);
  if (!(length > 0)) return std::nullopt; // or as much light on either side
  return slope / length;
}

double lengthAlong(const PixelPair& pair, const std::optional<glm::dvec2>& normal) {
  if (!normal) return 1.0;
  return std::max(std::abs(pair.across ? normal->x : normal->y), kLeast);
}

// Each side of a pixel counts by the cosine between it and the edge, whose direction is fitted to the pixels around:
// the tangent-based estimator of Coeurjolly & Klette, "A Comparative Evaluation of Length Estimators of Digital
// Curves", IEEE PAMI 26(2), 2004. Counting the sides themselves makes a slanted edge up to sqrt 2 too long.
double edgeLength(const Reference& truth, const SurfaceLinks& links, std::span<const std::uint8_t> receiver,
                  std::span<const float> values) {
  double length = 0;
  forEachCrack(truth, links, receiver, values,
               [&](const PixelPair& pair) { length += lengthAlong(pair, edgeNormal(truth, receiver, values, pair)); });
  return length;
}

} // namespace gnomon
