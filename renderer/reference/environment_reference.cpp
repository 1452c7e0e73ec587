#include "renderer/reference/environment_reference.h"

#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "protocol/base/split_mix.h"
#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"

namespace gnomon {
namespace {

constexpr std::array kWeights{0.2126, 0.7152, 0.0722};

std::uint64_t seedAt(const SurfacePoint& point) {
  std::uint64_t seed = splitMix64((std::uint64_t{point.instance} << 32) | point.triangle);
  for (int axis = 0; axis < 3; ++axis) seed = splitMix64(seed ^ std::bit_cast<std::uint64_t>(point.position[axis]));
  return seed;
}

/// A place in one of side x side squares of the unit square, another for each seed.
glm::dvec2 placeInStratum(int stratum, int side, std::uint64_t seed) {
  constexpr double kUnit = 0x1p-32;
  const std::uint64_t bits = splitMix64(seed + static_cast<std::uint64_t>(stratum));
  return {(stratum % side + static_cast<double>(bits >> 32) * kUnit) / side,
          (stratum / side + static_cast<double>(bits & 0xffffffffu) * kUnit) / side};
}

/// By the cosine around `normal`.
glm::dvec3 cosineWay(const glm::dvec3& normal, const glm::dvec2& place) {
  const double angle = glm::two_pi<double>() * place.x;
  const double across = std::sqrt(place.y);
  const glm::dvec3 aside =
      glm::normalize(glm::cross(normal, std::abs(normal.x) > 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
  return glm::normalize(aside * (across * std::cos(angle)) + glm::cross(normal, aside) * (across * std::sin(angle)) +
                        normal * std::sqrt(1 - place.y));
}

/// The ways from one point, and what arrives of each where nothing hides it.
struct Ways {
  std::vector<glm::dvec3> toward;
  std::vector<glm::dvec3> bring;
  std::vector<float> through;
};

void addWay(const SkyLight& sky, const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& toward,
            Ways& ways) {
  const double cosine = glm::dot(normal, toward);
  if (!(cosine > 0) || !(glm::dot(glm::dvec3(point.normal), toward) > 1e-6)) return;
  const glm::vec3 there = glm::normalize(sky.mapFromWorld * glm::vec3(toward));
  const double byLight = sky.sampler->share() > 0 ? double{sky.sampler->density(there)} : 0.0;
  ways.toward.push_back(toward);
  ways.bring.push_back(glm::dvec3(sky.sampler->radiance(there)) * (cosine / (cosine / glm::pi<double>() + byLight)));
}

float shareAt(const TracedSky& traced, const SkyLight& sky, const SurfacePoint& point, int side, Ways& ways) {
  ways.toward.clear();
  ways.bring.clear();
  const glm::dvec3 normal = traced.shadingNormal(point);
  const std::uint64_t seed = seedAt(point);
  for (int i = 0; i < side * side; ++i) {
    addWay(sky, point, normal, cosineWay(normal, placeInStratum(i, side, seed)), ways);
    if (sky.sampler->share() == 0) continue;
    const glm::vec3 there = sky.sampler->direction(glm::vec2(placeInStratum(i, side, ~seed)));
    addWay(sky, point, normal, glm::normalize(glm::dvec3(there * sky.mapFromWorld)), ways);
  }
  ways.through.resize(ways.toward.size());
  traced.through(point, ways.toward, ways.through);
  glm::dvec3 open(0), arriving(0);
  for (std::size_t i = 0; i < ways.bring.size(); ++i) {
    open += ways.bring[i];
    arriving += ways.bring[i] * double{ways.through[i]};
  }
  double share = 0, weight = 0;
  for (std::size_t c = 0; c < kWeights.size(); ++c) {
    const auto axis = static_cast<glm::length_t>(c);
    if (!(open[axis] > 0)) continue;
    share += kWeights[c] * arriving[axis] / open[axis];
    weight += kWeights[c];
  }
  return weight > 0 ? static_cast<float>(share / weight) : 1.0f;
}

} // namespace

void traceEnvironment(const TracedSky& traced, const SkyLight& sky, std::span<const SurfacePoint> points, int samples,
                      LightReference& light) {
  constexpr std::size_t kTogether = 16;
  const int side = static_cast<int>(std::ceil(std::sqrt(std::max(samples, 1))));
  const std::size_t before = light.visibility.size();
  light.visibility.resize(before + points.size(), 1.0f);
  light.receiver.resize(before + points.size(), 0);
  light.blockerDistance.resize(before + points.size(), std::numeric_limits<float>::infinity());
  forEachPiece(points.size(), kTogether, [&](std::size_t first, std::size_t last) {
    stopIfAsked();
    Ways ways;
    for (std::size_t i = first; i < last; ++i) {
      if (points[i].instance == kNoSurface || !traced.receives(points[i].instance)) continue;
      light.receiver[before + i] = 1;
      light.visibility[before + i] = shareAt(traced, sky, points[i], side, ways);
    }
  });
}

} // namespace gnomon
