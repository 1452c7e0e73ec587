#include "renderer/volume/light_map.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/parallel.h"
#include "renderer/volume/half.h"
#include "renderer/volume/march.h"

namespace gnomon {
namespace {

constexpr double kNoWay = 1e-9; // of the volume's longest edge: shorter ways have the extinction of their place

double longestEdge(const VolumeSpace& space) {
  return std::max({glm::length(space.axes[0]), glm::length(space.axes[1]), glm::length(space.axes[2])});
}

/// What is ahead of a ray in the volume: from its origin where that lies inside.
std::optional<Interval> wayThrough(const VolumeSpace& space, const Ray& ray) {
  auto inside = insideUnitCube(toUnit(space, ray));
  if (!inside || inside->to < 0) return std::nullopt;
  inside->from = std::max(inside->from, 0.0);
  return inside;
}

double meanExtinction(const Medium& medium, const glm::dvec3& unit, const glm::dvec3& towards) {
  if (!medium.castShadow) return 0;
  const Ray ray{toWorld(medium.space, unit), towards};
  const auto way = wayThrough(medium.space, ray);
  if (!way || way->to <= kNoWay * longestEdge(medium.space)) return matterAt(medium, unit).extinction;
  const Medium* alone[]{&medium};
  return opticalDepth(alone, ray, {0, way->to}) / way->to;
}

glm::dvec3 lightArriving(const LightMapInput& input, std::span<const Medium* const> casting, const glm::dvec3& place) {
  const bool shadowed = input.media[input.chosen]->receiveShadow;
  glm::dvec3 sum(0);
  for (const ArrivalAt& arrivalAt : input.lights) {
    const Arrival arrival = arrivalAt(place);
    double share = shadowed ? arrival.surfaceVisibility : 1.0;
    if (share == 0) continue;
    if (shadowed) share *= std::exp(-opticalDepth(casting, {place, arrival.towards}, {0, arrival.distance}));
    sum += share * arrival.irradiance;
  }
  return sum;
}

std::size_t countOf(const glm::ivec3& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}

glm::dvec3 latticePoint(std::size_t index, const glm::ivec3& size) {
  const auto i = static_cast<long>(index);
  const glm::dvec3 place(i % size.x, i / size.x % size.y, i / size.x / size.y);
  return place / glm::dvec3(size - 1);
}

float rounded(double share) {
  return fromHalf(toHalf(static_cast<float>(share)));
}

glm::dvec4 interpolated(const LightMap& map, const glm::dvec3& unit) {
  const glm::dvec3 place = glm::clamp(unit, glm::dvec3(0), glm::dvec3(1)) * glm::dvec3(map.size - 1);
  const glm::ivec3 low = glm::min(glm::ivec3(place), map.size - 2);
  const glm::vec3 share(place - glm::dvec3(low));
  const auto row = static_cast<std::size_t>(map.size.x);
  const std::size_t layer = row * static_cast<std::size_t>(map.size.y);
  const glm::vec4* at = map.texels.data() + static_cast<std::size_t>(low.z) * layer +
                        static_cast<std::size_t>(low.y) * row + static_cast<std::size_t>(low.x);
  const auto alongX = [&](std::size_t i) { return glm::mix(at[i], at[i + 1], share.x); };
  const auto alongY = [&](std::size_t i) { return glm::mix(alongX(i), alongX(i + row), share.y); };
  return glm::dvec4(glm::mix(alongY(0), alongY(layer), share.z));
}

} // namespace

glm::ivec3 lightMapSize(const DensityGrid& grid, int most) {
  return glm::min(grid.size + 1, glm::ivec3(most));
}

LightMap bakeLightMap(const LightMapInput& input) {
  const Medium& medium = *input.media[input.chosen];
  std::vector<const Medium*> casting;
  std::copy_if(input.media.begin(), input.media.end(), std::back_inserter(casting),
               [](const Medium* each) { return each->castShadow; });
  std::vector<glm::dvec4> numbers(countOf(input.size));
  forEach(numbers.size(), [&](std::size_t i) {
    const glm::dvec3 unit = latticePoint(i, input.size);
    const double taken = input.towards ? meanExtinction(medium, unit, *input.towards) : 0.0;
    numbers[i] = glm::dvec4(lightArriving(input, casting, toWorld(medium.space, unit)), taken);
  });
  glm::dvec4 full(0);
  for (const glm::dvec4& each : numbers) full = glm::max(full, each);
  LightMap map{input.size, {}, glm::dvec3(full), full.w};
  map.texels.reserve(numbers.size());
  const glm::dvec4 scale = 1.0 / glm::mix(full, glm::dvec4(1), glm::equal(full, glm::dvec4(0)));
  for (const glm::dvec4& each : numbers) {
    const glm::dvec4 share = each * scale;
    map.texels.emplace_back(rounded(share.x), rounded(share.y), rounded(share.z), rounded(share.w));
  }
  return map;
}

glm::dvec3 lightAt(const LightMap& map, const glm::dvec3& unit) {
  return map.fullLight * glm::dvec3(interpolated(map, unit));
}

double shareTaken(const Medium& medium, const LightMap& map, const glm::dvec3& place, const glm::dvec3& towards) {
  const Ray ray{place, towards};
  const auto way = wayThrough(medium.space, ray);
  if (!way) return 0;
  const glm::dvec3 entry = pointAt(toUnit(medium.space, ray), way->from);
  const double extinction = map.fullExtinction * interpolated(map, entry).w;
  return -std::expm1(-extinction * (way->to - way->from));
}

} // namespace gnomon
