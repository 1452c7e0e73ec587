#include "renderer/reference/error_measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "renderer/core/stop.h"
#include "renderer/reference/distance_transform.h"
#include "renderer/reference/shadow_edges.h"

namespace gnomon {
namespace {

constexpr float kEdgeBand = 2;      ///< pixels from an edge of V: nearer, an edge is merely in the wrong place
constexpr float kContactWidths = 2; ///< pixels' widths: what hides the light from nearer touches the surface

/// How far each pixel is from the edges of V, pixels.
struct TrueEdges {
  std::vector<float> toLit;      ///< to the nearest edge pixel on the lit side
  std::vector<float> toShadowed; ///< on the side in shadow

  float distance(std::size_t at) const { return std::min(toLit[at], toShadowed[at]); }
};

TrueEdges trueEdges(const Reference& truth, const SurfaceLinks& links, const LightReference& light) {
  const ShadowEdges edges = shadowEdges(truth, links, light.receiver, light.visibility);
  return {distancesTo(edges.lit, truth.width, truth.height), distancesTo(edges.shadowed, truth.width, truth.height)};
}

/// -1 where S has no edge. Each side of an edge is held against the same side of V's, so that an edge in the right
/// place is 0 off on both, and one that has moved by a pixel is 1 off.
std::vector<float> edgeDistances(const Reference& truth, const SurfaceLinks& links, const LightReference& light,
                                 const TrueEdges& nearest, std::span<const float> shown) {
  const ShadowEdges edges = shadowEdges(truth, links, light.receiver, shown);
  std::vector<float> distances(shown.size(), -1.0f);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (edges.lit[i] != 0) distances[i] = nearest.toLit[i];
    if (edges.shadowed[i] != 0) distances[i] = nearest.toShadowed[i];
  }
  return distances;
}

/// What is counted over the receivers of all lights.
struct Counts {
  std::uint64_t receivers = 0;
  std::uint64_t falseShadow = 0;
  std::uint64_t falseLit = 0;
  std::uint64_t acne = 0;
  std::uint64_t leak = 0;
  std::uint64_t interior = 0;
  std::uint64_t inBand = 0;
  double absolute = 0;
  double squared = 0;
  double edgeLength = 0;            ///< of V, pixels
  std::vector<float> displacements; ///< pixels
};

void countPixel(const LightReference& light, const TrueEdges& nearest, std::size_t at, float shown, Counts& counts) {
  const double difference = static_cast<double>(shown) - light.visibility[at];
  ++counts.receivers;
  counts.absolute += std::abs(difference);
  counts.squared += difference * difference;
  const bool lit = isLit(shown);
  if (lit == isLit(light.visibility[at])) return;
  const bool interior = nearest.distance(at) > kEdgeBand;
  const bool contact = light.blockerDistance[at] < kContactWidths;
  ++(lit ? counts.falseLit : counts.falseShadow);
  ++(interior ? counts.interior : counts.inBand);
  if (lit && (interior || contact)) ++counts.leak;
  if (!lit && interior) ++counts.acne;
}

void countLight(const Reference& truth, const SurfaceLinks& links, const LightReference& light,
                std::span<const float> shown, Counts& counts) {
  assert(shown.size() == truth.surface.size());
  const TrueEdges nearest = trueEdges(truth, links, light);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (i % static_cast<std::size_t>(truth.width) == 0) stopIfAsked();
    if (light.receiver[i] != 0) countPixel(light, nearest, i, shown[i], counts);
  }
  counts.edgeLength += edgeLength(truth, links, light.receiver, light.visibility);
  for (const float distance : edgeDistances(truth, links, light, nearest, shown)) {
    if (distance >= 0 && std::isfinite(distance)) counts.displacements.push_back(distance);
  }
}

/// By nearest rank.
double percentile(std::vector<float>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto place = values.begin() + std::max<std::ptrdiff_t>(rank - 1, 0);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::optional<EdgeDisplacement> displacementOf(Counts& counts) {
  if (counts.displacements.empty()) return std::nullopt;
  EdgeDisplacement displacement;
  displacement.mean = static_cast<double>(counts.inBand) / counts.edgeLength;
  displacement.median = percentile(counts.displacements, 0.5);
  displacement.p95 = percentile(counts.displacements, 0.95);
  displacement.max = percentile(counts.displacements, 1.0);
  return displacement;
}

ErrorMetrics metricsOf(Counts& counts) {
  ErrorMetrics metrics;
  metrics.receivers = counts.receivers;
  if (counts.receivers == 0) return metrics;
  const double all = static_cast<double>(counts.receivers);
  const auto share = [all](std::uint64_t count) { return static_cast<double>(count) / all; };
  const std::uint64_t misclassified = counts.falseShadow + counts.falseLit;
  metrics.misclassified = share(misclassified);
  metrics.falseShadow = share(counts.falseShadow);
  metrics.falseLit = share(counts.falseLit);
  metrics.acne = share(counts.acne);
  metrics.leak = share(counts.leak);
  metrics.edge = share(misclassified - counts.acne - counts.leak);
  metrics.interior = share(counts.interior);
  metrics.meanAbsolute = counts.absolute / all;
  metrics.rms = std::sqrt(counts.squared / all);
  metrics.edgeDisplacement = displacementOf(counts);
  return metrics;
}

} // namespace

ErrorMetrics measureErrors(const Reference& truth, std::span<const std::vector<float>> shown) {
  assert(shown.size() == truth.lights.size());
  const SurfaceLinks links = surfaceLinks(truth);
  Counts counts;
  for (std::size_t i = 0; i < shown.size(); ++i) countLight(truth, links, truth.lights[i], shown[i], counts);
  return metricsOf(counts);
}

std::vector<float> edgeDistances(const Reference& truth, std::size_t light, std::span<const float> shown) {
  const LightReference& of = truth.lights.at(light);
  const SurfaceLinks links = surfaceLinks(truth);
  return edgeDistances(truth, links, of, trueEdges(truth, links, of), shown);
}

} // namespace gnomon
