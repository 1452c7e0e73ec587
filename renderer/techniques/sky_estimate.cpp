#include "renderer/techniques/sky_estimate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/instruction_sets.h"
#include "renderer/rays/disc_place.h"

namespace gnomon {
namespace {

constexpr std::size_t kSkyCount = SkyPlaces::kCount;
constexpr float kSkyPi = std::numbers::pi_v<float>;
constexpr float kWideLobe = 0.5f;           ///< roughness: rays by the cosine find all of a lobe as wide
constexpr float kLeastOverPlane = 0x1p-11f; ///< over the triangle's plane: less is not worth a ray

glm::vec3 vectorAt(const float (&from)[3][kSkyCount], std::size_t i) {
  return {from[0][i], from[1][i], from[2][i]};
}

struct Squares {
  alignas(64) std::uint32_t x[kSkyCount], y[kSkyCount];
};

Squares squaresOf(const ShownSamples& shown, const PixelPlaces& places, std::uint32_t ray) {
  Squares squares{};
  for (std::size_t i = 0; i < shown.count; ++i) {
    const auto x = static_cast<std::uint32_t>(shown.pixels[i].x);
    const auto y = static_cast<std::uint32_t>(shown.pixels[i].y);
    const PixelPlaces::Place place = places.of(x + 5 * shown.samples[i], y + 3 * shown.samples[i], ray);
    squares.x[i] = place.x;
    squares.y[i] = place.y;
  }
  return squares;
}

/// Turns `local`, around z, to where n is z (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
[[gnu::always_inline]] inline glm::vec3 turnedTo(const glm::vec3& n, const glm::vec3& local) {
  const float sign = select(when(n.z < 0), -1.0f, 1.0f);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  const glm::vec3 across(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const glm::vec3 up(b, sign + n.y * n.y * a, -n.y);
  return across * local.x + up * local.y + n * local.z;
}

/// By the cosine around shading normals. (Malley: places of a disc, lifted onto the hemisphere.)
GNOMON_FOR_EACH_INSTRUCTION_SET void aimByCosine(const SkyPlaces& places, const Squares& squares, SkyWays& ways) {
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const glm::vec2 disc = discPlace(squares.x[i], squares.y[i]);
    const float height = 1 - disc.x * disc.x - disc.y * disc.y;
    const glm::vec3 toward = turnedTo({places.shading[0][i], places.shading[1][i], places.shading[2][i]},
                                      {disc.x, disc.y, std::sqrt(height < 0 ? 0.0f : height)});
    ways.toward[0][i] = toward.x;
    ways.toward[1][i] = toward.y;
    ways.toward[2][i] = toward.z;
  }
}

/// Around mirrored directions, as microfacets lie (Walter et al., "Microfacet Models for Refraction through Rough
/// Surfaces", 2007: GGX).
GNOMON_FOR_EACH_INSTRUCTION_SET void aimByLobe(const SkyPlaces& places, const Squares& squares, SkyWays& ways) {
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const float rough = places.roughness[i] * places.roughness[i];
    const float alpha = rough < 1e-3f ? 1e-3f : rough;
    const glm::vec2 disc = discPlace(squares.x[i], squares.y[i]);
    const float u = disc.x * disc.x + disc.y * disc.y;
    const float room = 1 - u;
    const float cosine = std::sqrt((room < 0 ? 0.0f : room) / (1 + (alpha * alpha - 1) * u));
    const float sine2 = 1 - cosine * cosine;
    const float across = std::sqrt((sine2 < 0 ? 0.0f : sine2) / (u < 1e-12f ? 1e-12f : u));
    const glm::vec3 half = turnedTo({places.shading[0][i], places.shading[1][i], places.shading[2][i]},
                                    {disc.x * across, disc.y * across, cosine});
    const glm::vec3 eye(places.toEye[0][i], places.toEye[1][i], places.toEye[2][i]);
    const glm::vec3 toward = half * (2 * glm::dot(eye, half)) - eye;
    ways.toward[0][i] = toward.x;
    ways.toward[1][i] = toward.y;
    ways.toward[2][i] = toward.z;
  }
}

/// Parts of the unit square: the left one, as wide as `share`, drawn out to all of it, and the rest.
struct Divided {
  alignas(64) float across[kSkyCount], up[kSkyCount]; ///< of the left part
  int left[kSkyCount];                                ///< -1: in the left part; else 0
  Squares rest;
};

GNOMON_FOR_EACH_INSTRUCTION_SET void divide(const Squares& squares, float share, Divided& divided) {
  const float overLeft = 1 / share;
  const float overRest = 1 / (1 - share);
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const float x = static_cast<float>(static_cast<std::int32_t>(squares.x[i] >> 8)) * 0x1p-24f;
    const float y = static_cast<float>(static_cast<std::int32_t>(squares.y[i] >> 8)) * 0x1p-24f;
    divided.left[i] = when(x < share);
    divided.across[i] = x * overLeft;
    divided.up[i] = y;
    const float place = (x - share) * overRest;
    const float within = place < 0 ? 0.0f : (place < 0.9999f ? place : 0.9999f);
    divided.rest.x[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(within * 0x1p24f)) << 8;
    divided.rest.y[i] = squares.y[i];
  }
}

using SkyDirections = EnvironmentSampler::Directions;
static_assert(EnvironmentSampler::kLanes == kSkyCount);

/// From the map's directions to the world's, where `left` has one.
GNOMON_FOR_EACH_INSTRUCTION_SET void takeTurned(const glm::mat3& mapFromWorld, const SkyDirections& from,
                                                const int (&left)[kSkyCount], SkyWays& ways) {
  const glm::mat3 turn = mapFromWorld;
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const glm::vec3 toward = glm::vec3(from.x[i], from.y[i], from.z[i]) * turn; // the inverse turn
    ways.toward[0][i] = select(left[i], toward.x, ways.toward[0][i]);
    ways.toward[1][i] = select(left[i], toward.y, ways.toward[1][i]);
    ways.toward[2][i] = select(left[i], toward.z, ways.toward[2][i]);
  }
}

GNOMON_FOR_EACH_INSTRUCTION_SET void turnToMap(const glm::mat3& mapFromWorld, const SkyWays& ways, SkyDirections& to) {
  const glm::mat3 turn = mapFromWorld;
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const glm::vec3 there = turn * glm::vec3(ways.toward[0][i], ways.toward[1][i], ways.toward[2][i]);
    to.x[i] = there.x;
    to.y[i] = there.y;
    to.z[i] = there.z;
  }
}

/// Turns those ways that go by where light comes from: of the squares' left part. The rest is drawn out to all of it.
void aimByLight(const SkyLight& sky, const Squares& squares, SkyWays& ways, const SkyPlaces& places) {
  const float share = sky.sampler->share();
  if (share == 0) return aimByCosine(places, squares, ways);
  Divided divided;
  divide(squares, share, divided);
  aimByCosine(places, divided.rest, ways);
  SkyDirections directions;
  sky.sampler->aim(divided.across, divided.up, divided.left, directions);
  takeTurned(sky.mapFromWorld, directions, divided.left, ways);
}

/// What each way brings. Those that bring nothing are not asked for.
struct Brought {
  alignas(64) float diffuse[3][kSkyCount];
  float mirror[kSkyCount]; ///< in the lobe: its luminance
};

/// How many of the directions of aimByLobe lie there, per steradian, of 1 in all.
[[gnu::always_inline]] inline float lobeDensity(const glm::vec3& normal, const glm::vec3& toEye, float roughness,
                                                const glm::vec3& toward) {
  const glm::vec3 sum = toward + toEye;
  const float squared = glm::dot(sum, sum);
  const glm::vec3 half = sum * (1 / std::sqrt(squared < 1e-12f ? 1e-12f : squared));
  const float rough = roughness * roughness;
  const float alpha = rough < 1e-3f ? 1e-3f : rough;
  const float cosine = glm::dot(normal, half);
  const float spread = cosine * cosine * (alpha * alpha - 1) + 1;
  const float facets = alpha * alpha / (kSkyPi * spread * spread) * (cosine < 0 ? 0.0f : cosine);
  const float toHalf = glm::dot(toEye, half);
  return facets / (4 * (toHalf < 1e-4f ? 1e-4f : toHalf));
}

/// `share`: of the ways that go by light. `perMirror`: diffuse rays for each that goes by the lobe.
GNOMON_FOR_EACH_INSTRUCTION_SET void weighAll(const SkyPlaces& places, const EnvironmentSampler::Light& light,
                                              float share, float perMirror, SkyWays& ways, Brought& brought) {
  Brought found; // what nothing else can refer to becomes vectors
  alignas(64) int asked[kSkyCount];
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const glm::vec3 toward(ways.toward[0][i], ways.toward[1][i], ways.toward[2][i]);
    const glm::vec3 normal(places.shading[0][i], places.shading[1][i], places.shading[2][i]);
    const glm::vec3 plane(places.normal[0][i], places.normal[1][i], places.normal[2][i]);
    const glm::vec3 eye(places.toEye[0][i], places.toEye[1][i], places.toEye[2][i]);
    const float cosine = glm::dot(normal, toward);
    const int leads = when(glm::dot(plane, toward) > kLeastOverPlane) & when(cosine > 0);
    const float density = (1 - share) * cosine * (1 / kSkyPi) + share * light.density[i];
    const float lobe = lobeDensity(normal, eye, places.roughness[i], toward);
    const float over = cosine / density;
    found.diffuse[0][i] = light.red[i] * over;
    found.diffuse[1][i] = light.green[i] * over;
    found.diffuse[2][i] = light.blue[i] * over;
    const float luminance = 0.2126f * light.red[i] + 0.7152f * light.green[i] + 0.0722f * light.blue[i];
    const float byLobe = select(when(places.roughness[i] < kWideLobe), lobe, 0.0f);
    found.mirror[i] = luminance * lobe / (perMirror * density + byLobe);
    asked[i] = places.receives[i] & leads & when(light.red[i] + light.green[i] + light.blue[i] > 0);
  }
  brought = found;
  std::copy_n(asked, kSkyCount, ways.asked);
}

/// Weighs ways that both kinds of rays may take, of the first `count` places.
void weigh(const SkyLight& sky, const SkyPlaces& places, std::size_t count, float perMirror, SkyWays& ways,
           Brought& brought) {
  SkyDirections directions;
  turnToMap(sky.mapFromWorld, ways, directions);
  EnvironmentSampler::Light light;
  sky.sampler->lookUp(directions, light);
  weighAll(places, light, sky.sampler->share(), perMirror, ways, brought);
  std::fill(ways.asked + count, std::end(ways.asked), 0);
}

/// The same sums as SkySums, of all places.
struct Summed {
  alignas(64) float open[3][kSkyCount], arriving[3][kSkyCount];
  float openMirror[kSkyCount], arrivingMirror[kSkyCount];
};

GNOMON_FOR_EACH_INSTRUCTION_SET void addFound(const SkyWays& ways, const Brought& brought, const float* found,
                                              bool diffuse, Summed& sums) {
  const int isDiffuse = when(diffuse);
  for (std::size_t i = 0; i < kSkyCount; ++i) {
    const int asked = ways.asked[i];
    const float through = found[i];
    for (int c = 0; c < 3; ++c) {
      const float part = select(asked & isDiffuse, brought.diffuse[c][i], 0.0f);
      sums.open[c][i] += part;
      sums.arriving[c][i] += part * through;
    }
    const float part = select(asked, brought.mirror[i], 0.0f);
    sums.openMirror[i] += part;
    sums.arrivingMirror[i] += part * through;
  }
}

std::uint64_t askedOf(const SkyWays& ways) {
  return static_cast<std::uint64_t>(std::count(std::begin(ways.asked), std::end(ways.asked), -1));
}

} // namespace

std::uint64_t addSky(const SkyLight& sky, SkyPacket& packet, const ShownSamples& shown, const SkyRayPlaces& places,
                     const SkyRays& rays, SkySums* sums) {
  const SkyPlaces& at = packet.places();
  const float perMirror = static_cast<float>(rays.last) / static_cast<float>(mirrorRays(rays.last));
  std::uint64_t sent = 0;
  SkyWays ways;
  Brought brought;
  Summed all{};
  const auto trace = [&](bool diffuse) {
    weigh(sky, at, shown.count, perMirror, ways, brought);
    for (std::size_t i = 0; i < kSkyCount; ++i) {
      if (!diffuse) ways.asked[i] &= when(at.roughness[i] < kWideLobe);
    }
    addFound(ways, brought, packet.through(ways).data(), diffuse, all);
    sent += askedOf(ways);
  };
  for (std::uint32_t ray = rays.first; ray < rays.last; ++ray) {
    aimByLight(sky, squaresOf(shown, places.diffuse, ray), ways, at);
    trace(true);
  }
  const bool anyMirror =
      std::any_of(at.roughness, at.roughness + shown.count, [](float roughness) { return roughness < kWideLobe; });
  for (std::uint32_t ray = mirrorRays(rays.first); anyMirror && ray < mirrorRays(rays.last); ++ray) {
    aimByLobe(at, squaresOf(shown, places.mirrored, ray), ways);
    trace(false);
  }
  for (std::size_t i = 0; i < shown.count; ++i) {
    sums[i].open += vectorAt(all.open, i);
    sums[i].arriving += vectorAt(all.arriving, i);
    sums[i].openMirror += all.openMirror[i];
    sums[i].arrivingMirror += all.arrivingMirror[i];
  }
  return sent;
}

} // namespace gnomon
