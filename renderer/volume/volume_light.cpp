#include "renderer/volume/volume_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "renderer/core/parallel.h"
#include "renderer/volume/half.h"
#include "renderer/volume/volume_picture.h"

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

/// What the volume itself has between a point and where the ray towards the chosen light leaves it.
struct OwnWay {
  double meanExtinction = 0;
  double opticalDepth = 0;
};

OwnWay ownWay(const Medium& medium, const glm::dvec3& unit, const glm::dvec3& towards) {
  if (!medium.castShadow) return {};
  const Ray ray{toWorld(medium.space, unit), towards};
  const auto way = wayThrough(medium.space, ray);
  if (!way || way->to <= kNoWay * longestEdge(medium.space)) return {matterAt(medium, unit).extinction, 0};
  const Medium* alone[]{&medium};
  const double depth = opticalDepth(alone, ray, {0, way->to});
  return {depth / way->to, depth};
}

/// The media that dim light for one of them, all and without itself.
struct Dimming {
  std::vector<const Medium*> all, others;
};

Dimming dimmingOf(const VolumeLightInput& input) {
  Dimming dimming;
  for (std::size_t i = 0; i < input.media.size(); ++i) {
    if (!input.media[i]->castShadow) continue;
    dimming.all.push_back(input.media[i]);
    if (i != input.chosen) dimming.others.push_back(input.media[i]);
  }
  return dimming;
}

glm::dvec3 lightArriving(const VolumeLightInput& input, const Dimming& dimming, std::size_t point,
                         const glm::dvec3& place, const OwnWay& own) {
  const bool shadowed = input.media[input.chosen]->receiveShadow;
  glm::dvec3 sum(0);
  for (const ArrivalAt& arrivalAt : input.lights) {
    const Arrival arrival = arrivalAt(point, place);
    double share = shadowed ? arrival.surfaceVisibility : 1.0;
    if (share == 0) continue;
    if (shadowed) {
      const bool known = input.towards && arrival.towards == *input.towards && std::isinf(arrival.distance);
      const Ray ray{place, arrival.towards};
      const double rest = opticalDepth(known ? dimming.others : dimming.all, ray, {0, arrival.distance});
      share *= std::exp(-rest - (known ? own.opticalDepth : 0.0));
    }
    sum += share * arrival.irradiance;
  }
  return sum;
}

glm::dvec3 latticePoint(std::size_t index, const glm::ivec3& size) {
  const auto i = static_cast<long>(index);
  const glm::dvec3 place(i % size.x, i / size.x % size.y, i / size.x / size.y);
  return place / glm::dvec3(size - 1);
}

float rounded(double share) {
  return fromHalf(toHalf(static_cast<float>(share)));
}

glm::dvec4 interpolated(const VolumeLight& map, const glm::dvec3& unit) {
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

template <class T>
bool isSameObject(const std::weak_ptr<T>& a, const std::weak_ptr<T>& b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

std::size_t bytesOf(const VolumeLight& map) {
  return map.texels.size() * sizeof(map.texels.front());
}

} // namespace

glm::ivec3 volumeLightSize(const DensityGrid& grid, int most) {
  return glm::min(grid.size + 1, glm::ivec3(most));
}

std::size_t pointsOf(const glm::ivec3& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}

glm::dvec3 latticePlace(const VolumeSpace& space, const glm::ivec3& size, std::size_t point) {
  return toWorld(space, latticePoint(point, size));
}

VolumeLight makeVolumeLight(const VolumeLightInput& input) {
  const Medium& medium = *input.media[input.chosen];
  const Dimming dimming = dimmingOf(input);
  std::vector<glm::dvec4> numbers(pointsOf(input.size));
  forEach(numbers.size(), [&](std::size_t i) {
    const glm::dvec3 unit = latticePoint(i, input.size);
    const OwnWay own = input.towards ? ownWay(medium, unit, *input.towards) : OwnWay{};
    glm::dvec3 light = lightArriving(input, dimming, i, toWorld(medium.space, unit), own);
    if (input.around != nullptr) light += glm::pi<double>() * lightAt(*input.around, unit);
    numbers[i] = glm::dvec4(light, own.meanExtinction);
  });
  glm::dvec4 full(0);
  for (const glm::dvec4& each : numbers) full = glm::max(full, each);
  VolumeLight map{input.size, {}, glm::dvec3(full), full.w, 0};
  map.texels.reserve(numbers.size());
  const glm::dvec4 scale = 1.0 / glm::mix(full, glm::dvec4(1), glm::equal(full, glm::dvec4(0)));
  for (const glm::dvec4& each : numbers) {
    const glm::dvec4 share = each * scale;
    map.texels.emplace_back(rounded(share.x), rounded(share.y), rounded(share.z), rounded(share.w));
  }
  return map;
}

glm::dvec3 lightAt(const VolumeLight& map, const glm::dvec3& unit) {
  return map.fullLight * glm::dvec3(interpolated(map, unit));
}

double shareTaken(const Medium& medium, const VolumeLight& map, const glm::dvec3& place, const glm::dvec3& towards) {
  const Ray ray{place, towards};
  const auto way = wayThrough(medium.space, ray);
  if (!way) return 0;
  const glm::dvec3 entry = pointAt(toUnit(medium.space, ray), way->from);
  const double extinction = map.fullExtinction * interpolated(map, entry).w;
  return -std::expm1(-extinction * (way->to - way->from));
}

double volumeVisibility(std::span<const MappedMedium> media, const glm::dvec3& place, const glm::dvec3& towards) {
  double visibility = 1;
  for (const MappedMedium& each : media) visibility *= 1 - shareTaken(*each.medium, *each.map, place, towards);
  return visibility;
}

VolumeLightKey::VolumeLightKey(const VolumeLightInput& input, std::string lights, std::string casters,
                               std::weak_ptr<const void> environment)
    : chosen_(input.chosen),
      towards_(input.towards),
      size_(input.size),
      lights_(std::move(lights)),
      casters_(std::move(casters)),
      environment_(std::move(environment)) {
  for (const Medium* medium : input.media) {
    media_.push_back({medium->grid, medium->function, medium->space, medium->castShadow, medium->receiveShadow});
  }
}

bool VolumeLightKey::same(const Part& a, const Part& b) {
  return isSameObject(a.grid, b.grid) && a.function == b.function && a.space == b.space &&
         a.castShadow == b.castShadow && a.receiveShadow == b.receiveShadow;
}

bool VolumeLightKey::operator==(const VolumeLightKey& other) const {
  return chosen_ == other.chosen_ && towards_ == other.towards_ && size_ == other.size_ && lights_ == other.lights_ &&
         casters_ == other.casters_ && isSameObject(environment_, other.environment_) &&
         std::equal(media_.begin(), media_.end(), other.media_.begin(), other.media_.end(), same);
}

bool VolumeLightStore::holds(const VolumeLightKey& key) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.first == key; });
}

VolumeLightStore::Found VolumeLightStore::mapOf(const VolumeLightKey& key, const std::function<VolumeLight()>& make) {
  if (const Entry* const found = entries_.find(key, &Entry::first)) return {found->second, false};
  const auto made = std::make_shared<const VolumeLight>(make());
  entries_.add({key, made});
  entries_.keepWithin(maxBytes_, [](const Entry& entry) { return bytesOf(*entry.second); });
  if (bytesOf(*made) > maxBytes_) entries_.keepNewest(0);
  return {made, true};
}

} // namespace gnomon
