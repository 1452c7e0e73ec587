#include "renderer/frame/volume_sky.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "renderer/core/light.h"
#include "renderer/core/parallel.h"
#include "renderer/core/reversed_bits.h"

namespace gnomon {
namespace {

constexpr int kDirectionsOfSample = 16;
constexpr int kMostDirections = 1024;
constexpr std::size_t kPointsTogether = 64;

/// One of so many, as evenly over the sphere as the seeds of a sunflower (González, "Measurement of Areas on a Sphere
/// Using Fibonacci and Latitude-Longitude Lattices", 2010).
glm::dvec3 evenDirection(int number, int of) {
  const double height = 1 - (2 * number + 1.0) / of;
  const double across = std::sqrt(1 - height * height);
  const double angle = 2 * std::numbers::pi * std::fmod(number / std::numbers::phi, 1.0);
  return {across * std::cos(angle), height, across * std::sin(angle)};
}

} // namespace

int skyDirectionCount(int samples) {
  return std::min(kDirectionsOfSample * samples, kMostDirections);
}

DirectionsOfSky skyDirections(const SkyLight& sky, int count) {
  const double share{sky.sampler->share()};
  const int byLight = static_cast<int>(std::lround(share * count));
  const int even = count - byLight;
  DirectionsOfSky all;
  const auto add = [&](const glm::dvec3& toward) {
    const glm::vec3 there = sky.mapFromWorld * glm::vec3(toward);
    const glm::dvec3 light(sky.sampler->radiance(there));
    if (!(light.x + light.y + light.z > 0)) return;
    const double aimed = byLight > 0 ? byLight * double{sky.sampler->density(there)} : 0.0;
    all.towards.push_back(toward);
    all.light.push_back(light / (even / (4 * std::numbers::pi) + aimed));
  };
  for (int i = 0; i < even; ++i) add(evenDirection(i, even));
  for (int i = 0; i < byLight; ++i) {
    const glm::vec2 place(static_cast<float>((i + 0.5) / byLight),
                          static_cast<float>(reversedBits(static_cast<std::uint32_t>(i)) * 0x1p-32));
    add(glm::normalize(glm::dvec3(sky.sampler->direction(place) * sky.mapFromWorld))); // the inverse turn
  }
  return all;
}

VolumeLight openSky(const glm::dvec3& open) {
  return {glm::ivec3(2), std::vector<glm::vec4>(8, {1, 1, 1, 0}), open, 0, 0};
}

VolumeLight skyInVolume(const TracedSky& traced, const DirectionsOfSky& sky, const glm::dvec3& open,
                        const VolumeSpace& space, const glm::ivec3& size) {
  VolumeLight map{glm::min(size, glm::ivec3(kMostSkySide)), {}, open, 0, 0};
  map.texels.resize(pointsOf(map.size));
  glm::dvec3 whole(0);
  for (const glm::dvec3& light : sky.light) whole += light;
  forEachPiece(map.texels.size(), kPointsTogether, [&](std::size_t first, std::size_t last) {
    std::vector<float> shares(sky.towards.size());
    for (std::size_t i = first; i < last; ++i) {
      traced.through(latticePlace(space, map.size, i), sky.towards, shares);
      glm::dvec3 arriving(0);
      for (std::size_t k = 0; k < shares.size(); ++k) arriving += double{shares[k]} * sky.light[k];
      map.texels[i] = glm::vec4(glm::vec3(arrivingShare(whole, arriving)), 0);
    }
  });
  return map;
}

} // namespace gnomon
