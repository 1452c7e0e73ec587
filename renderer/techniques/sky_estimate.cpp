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
constexpr float kLeastOverPlane = 0x1p-11f; ///< over the triangle's plane: less is not worth a ray

glm::vec3 vectorAt(const float (&from)[3][kSkyCount], std::size_t i) {
  return {from[0][i], from[1][i], from[2][i]};
}

void put(const glm::vec3& v, float (&to)[3][kSkyCount], std::size_t i) {
  for (int axis = 0; axis < 3; ++axis) to[axis][i] = v[axis];
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

/// Turns those ways that go by where light comes from: of the squares' left part. The rest is drawn out to all of it.
void aimByLight(const SkyLight& sky, std::size_t count, Squares& squares, SkyWays& ways, const SkyPlaces& places) {
  const float share = sky.sampler->share();
  if (share == 0) return aimByCosine(places, squares, ways);
  std::uint32_t byLight = 0;
  Squares byCosine = squares;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = static_cast<float>(squares.x[i]) * 0x1p-32f;
    if (x < share) {
      byLight |= 1u << i;
    } else {
      byCosine.x[i] = static_cast<std::uint32_t>(std::min(double{x - share} / double{1 - share}, 0.999999) * 0x1p32);
    }
  }
  aimByCosine(places, byCosine, ways);
  for (std::size_t i = 0; i < count; ++i) {
    if ((byLight >> i & 1u) == 0) continue;
    const glm::vec2 place(static_cast<float>(squares.x[i]) * 0x1p-32f / share,
                          static_cast<float>(squares.y[i]) * 0x1p-32f);
    put(sky.sampler->direction(place) * sky.mapFromWorld, ways.toward, i); // the inverse turn
  }
}

/// What each way brings. Those that bring nothing are not asked for.
struct Brought {
  glm::vec3 diffuse[kSkyCount];
  float mirror[kSkyCount]; ///< in the lobe: its luminance
};

/// How many of the directions of aimByLobe lie there, per steradian, of 1 in all.
float lobeDensity(const glm::vec3& normal, const glm::vec3& toEye, float roughness, const glm::vec3& toward) {
  const glm::vec3 sum = toward + toEye;
  const glm::vec3 half = sum / std::max(glm::length(sum), 1e-6f);
  const float alpha = std::max(roughness * roughness, 1e-3f);
  const float cosine = glm::dot(normal, half);
  const float spread = cosine * cosine * (alpha * alpha - 1) + 1;
  const float facets = alpha * alpha / (kSkyPi * spread * spread) * std::max(cosine, 0.0f);
  return facets / (4 * std::max(glm::dot(toEye, half), 1e-4f));
}

/// Weighs ways that both kinds of rays may take. `perMirror`: diffuse rays for each that goes by the lobe.
void weigh(const SkyLight& sky, const SkyPlaces& places, std::size_t count, float perMirror, SkyWays& ways,
           Brought& brought) {
  const float share = sky.sampler->share();
  for (std::size_t i = 0; i < kSkyCount; ++i) ways.asked[i] = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 toward = vectorAt(ways.toward, i);
    const glm::vec3 normal = vectorAt(places.shading, i);
    const float cosine = glm::dot(normal, toward);
    const bool leaves = glm::dot(vectorAt(places.normal, i), toward) > kLeastOverPlane;
    if (places.receives[i] == 0 || !leaves || !(cosine > 0)) continue;
    const glm::vec3 there = sky.mapFromWorld * toward;
    const float density = (1 - share) * cosine / kSkyPi + (share > 0 ? share * sky.sampler->density(there) : 0.0f);
    const glm::vec3 light = sky.sampler->radiance(there);
    const float lobe = lobeDensity(normal, vectorAt(places.toEye, i), places.roughness[i], toward);
    brought.diffuse[i] = light * (cosine / density);
    brought.mirror[i] = glm::dot(light, glm::vec3(0.2126f, 0.7152f, 0.0722f)) * lobe / (perMirror * density + lobe);
    ways.asked[i] = light.x + light.y + light.z > 0 ? -1 : 0;
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
  const auto addMirror = [&](std::size_t i, float found) {
    sums[i].openMirror += brought.mirror[i];
    sums[i].arrivingMirror += brought.mirror[i] * found;
  };
  for (std::uint32_t ray = rays.first; ray < rays.last; ++ray) {
    Squares squares = squaresOf(shown, places.diffuse, ray);
    aimByLight(sky, shown.count, squares, ways, at);
    weigh(sky, at, shown.count, perMirror, ways, brought);
    const auto found = packet.through(ways);
    for (std::size_t i = 0; i < shown.count; ++i) {
      if (ways.asked[i] == 0) continue;
      sums[i].open += brought.diffuse[i];
      sums[i].arriving += brought.diffuse[i] * found[i];
      addMirror(i, found[i]);
    }
    sent += askedOf(ways);
  }
  for (std::uint32_t ray = mirrorRays(rays.first); ray < mirrorRays(rays.last); ++ray) {
    aimByLobe(at, squaresOf(shown, places.mirrored, ray), ways);
    weigh(sky, at, shown.count, perMirror, ways, brought);
    const auto found = packet.through(ways);
    for (std::size_t i = 0; i < shown.count; ++i) {
      if (ways.asked[i] != 0) addMirror(i, found[i]);
    }
    sent += askedOf(ways);
  }
  return sent;
}

} // namespace gnomon
