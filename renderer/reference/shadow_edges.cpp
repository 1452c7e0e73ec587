#include "renderer/reference/shadow_edges.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

namespace {

constexpr int kNone = std::numeric_limits<int>::max(); ///< pixels: nothing is marked in the column

/// Pixels up or down each column to the nearest mark in it.
std::vector<int> columnDistances(std::span<const std::uint8_t> marks, std::size_t width, std::size_t height) {
  std::vector<int> distances(marks.size(), kNone);
  const auto step = [&](std::size_t at, std::size_t from) {
    if (distances[from] != kNone) distances[at] = std::min(distances[at], distances[from] + 1);
  };
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] != 0) {
      distances[i] = 0;
    } else if (i >= width) {
      step(i, i - width);
    }
  }
  for (std::size_t i = width * (height - 1); i-- > 0;) step(i, i + width);
  return distances;
}

/// The columns whose parabolas make up the lower envelope of a row, and where each begins to be the lowest.
struct Envelope {
  std::vector<int> columns;
  std::vector<double> begins;
};

/// Where the parabolas over `left` and `right` cross. Both heights are whole numbers below 2^53, and so the quotient is
/// on the right side of every pixel's centre.
double crossing(const int* row, int left, int right) {
  const auto height = [row](int at) { return static_cast<double>(row[at]) * row[at] + static_cast<double>(at) * at; };
  return (height(right) - height(left)) / (2.0 * (right - left));
}

void fillEnvelope(const int* row, int width, Envelope& envelope) {
  envelope.columns.clear();
  envelope.begins.clear();
  for (int x = 0; x < width; ++x) {
    if (row[x] == kNone) continue;
    double begin = -std::numeric_limits<double>::infinity();
    while (!envelope.columns.empty()) {
      begin = crossing(row, envelope.columns.back(), x);
      if (begin > envelope.begins.back()) break;
      envelope.columns.pop_back();
      envelope.begins.pop_back();
    }
    if (envelope.columns.empty()) begin = -std::numeric_limits<double>::infinity();
    envelope.columns.push_back(x);
    envelope.begins.push_back(begin);
  }
}

} // namespace

// Felzenszwalb & Huttenlocher, "Distance Transforms of Sampled Functions", Theory of Computing 8, 2012: a parabola over
// each column's distance, and the lower envelope of a row's.
std::vector<float> distancesTo(std::span<const std::uint8_t> marks, int width, int height) {
  assert(marks.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  std::vector<float> distances(marks.size(), std::numeric_limits<float>::infinity());
  if (marks.empty()) return distances;
  const auto columns = columnDistances(marks, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
  Envelope envelope;
  for (std::size_t begin = 0; begin < marks.size(); begin += static_cast<std::size_t>(width)) {
    stopIfAsked();
    const int* row = columns.data() + begin;
    fillEnvelope(row, width, envelope);
    if (envelope.columns.empty()) continue;
    std::size_t lowest = 0;
    for (int x = 0; x < width; ++x) {
      while (lowest + 1 < envelope.columns.size() && envelope.begins[lowest + 1] <= x) ++lowest;
      const int column = envelope.columns[lowest];
      const double across = x - column;
      const double along = row[column];
      distances[begin + static_cast<std::size_t>(x)] = static_cast<float>(std::sqrt(across * across + along * along));
    }
  }
  return distances;
}

} // namespace gnomon
