#include "renderer/bake/bake_environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/bake/bake_texels.h"
#include "renderer/core/light.h"
#include "renderer/core/stop.h"
#include "renderer/rays/disc_place.h"
#include "renderer/rays/pixel_places.h"
#include "renderer/rays/sky_rays.h"

namespace gnomon {
namespace {

constexpr double kLeastOverPlane = 0x1p-11; ///< over the triangle's plane: less is not worth a ray

/// Turns `local`, around z, to where n is z (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
glm::dvec3 turnedTo(const glm::dvec3& n, const glm::dvec3& local) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1 / (sign + n.z);
  const double b = n.x * n.y * a;
  const glm::dvec3 across(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  const glm::dvec3 up(b, sign + n.y * n.y * a, -n.y);
  return across * local.x + up * local.y + n * local.z;
}

/// By the cosine around `normal`. (Malley: places of a disc, lifted onto the hemisphere.)
glm::dvec3 wayByCosine(const glm::dvec3& normal, std::uint32_t x, std::uint32_t y) {
  const glm::dvec2 disc(discPlace(x, y));
  return turnedTo(normal, {disc, std::sqrt(std::max(1 - glm::dot(disc, disc), 0.0))});
}

/// Either by where light comes from, in the left part of the square, or by the cosine in the rest of it.
glm::dvec3 wayToSky(const SkyLight& sky, const glm::dvec3& normal, const PixelPlaces::Place& place) {
  const float share = sky.sampler->share();
  const double x = place.x * 0x1p-32;
  if (x < double{share}) {
    const glm::vec2 within(static_cast<float>(x / double{share}), static_cast<float>(place.y * 0x1p-32));
    return glm::normalize(glm::dvec3(sky.sampler->direction(within) * sky.mapFromWorld)); // the inverse turn
  }
  const double rest = std::min((x - double{share}) / (1 - double{share}), 0.999999);
  return wayByCosine(normal, static_cast<std::uint32_t>(rest * 0x1p32), place.y);
}

/// What arrives of an environment in one texel, and what would without casters.
struct SkyTexel {
  glm::dvec3 open{0}, arriving{0};
  bool covered = false;
};

class SkySums : public TexelSums {
 public:
  SkySums(const TracedSky& traced, const SkyLight& sky, const PixelPlaces& places, const Rect& rect,
          std::uint32_t raysOfPlace, const GoOn& goOn)
      : traced_(traced),
        sky_(sky),
        places_(places),
        rect_(rect),
        rays_(raysOfPlace),
        goOn_(goOn),
        texels_(texelsIn(rect)) {}

  void add(const TexelPlace& place) override {
    SkyTexel& texel = texels_[texelIn(rect_, place.texel)];
    texel.covered = true;
    if (!traced_.receives(place.triangle.instance)) return;
    stopIfAsked();
    if (!goOn_()) return;
    const SurfacePoint point = traced_.pointInFront(place.triangle, place.weights);
    aim(point, place);
    through_.resize(ways_.size());
    traced_.through(point, ways_, through_);
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      texel.open += brought_[i];
      texel.arriving += brought_[i] * double{through_[i]};
    }
  }

  std::vector<std::vector<std::int32_t>> means() override {
    std::vector<std::vector<std::int32_t>> planes(3, std::vector<std::int32_t>(texels_.size(), kUncovered));
    for (std::size_t i = 0; i < texels_.size(); ++i) {
      if (!texels_[i].covered) continue;
      const glm::dvec3 share = arrivingShare(texels_[i].open, texels_[i].arriving);
      for (std::size_t color = 0; color < planes.size(); ++color) {
        planes[color][i] = static_cast<std::int32_t>(std::lround(share[static_cast<glm::length_t>(color)] * 65535));
      }
    }
    return planes;
  }

 private:
  /// Finds the ways from a point, and what comes along each where nothing hides it: both kinds of ways count as the
  /// balance heuristic says.
  void aim(const SurfacePoint& point, const TexelPlace& place) {
    ways_.clear();
    brought_.clear();
    const glm::dvec3 normal = traced_.shadingNormal(point);
    const double byLight{sky_.sampler->share()};
    const std::uint32_t first = static_cast<std::uint32_t>(place.number) * rays_;
    for (std::uint32_t ray = first; ray < first + rays_; ++ray) {
      const glm::dvec3 toward = wayToSky(
          sky_, normal,
          places_.of(static_cast<std::uint32_t>(place.texel.x), static_cast<std::uint32_t>(place.texel.y), ray));
      const double cosine = glm::dot(normal, toward);
      if (!(cosine > 0) || !(glm::dot(glm::dvec3(point.normal), toward) > kLeastOverPlane)) continue;
      const glm::vec3 there = sky_.mapFromWorld * glm::vec3(toward);
      const glm::vec3 light = sky_.sampler->radiance(there);
      if (!(light.x + light.y + light.z > 0)) continue;
      const double density = (1 - byLight) * cosine / std::numbers::pi +
                             (byLight > 0 ? byLight * double{sky_.sampler->density(there)} : 0.0);
      ways_.push_back(toward);
      brought_.push_back(glm::dvec3(light) * (cosine / density));
    }
  }

  const TracedSky& traced_;
  const SkyLight& sky_;
  const PixelPlaces& places_;
  Rect rect_;
  std::uint32_t rays_;
  GoOn goOn_;
  std::vector<SkyTexel> texels_;
  std::vector<glm::dvec3> ways_;    ///< of the place at hand
  std::vector<glm::dvec3> brought_; ///< along each
  std::vector<float> through_;
};

} // namespace

std::optional<std::array<LightMap, 3>> bakeEnvironment(const TraceInput& rays, const SkyLight& sky,
                                                       const LightMapLayout& layout, int samples,
                                                       const Progress& progress) {
  const TracedSky traced(rays);
  const int raysOfTexel = kEnvironmentRaysOfSample * samples;
  const PixelPlaces places(static_cast<std::uint32_t>(raysOfTexel), static_cast<std::uint32_t>(raysOfTexel));
  const auto sums = [&](const Rect& rect, int count, const GoOn& goOn) -> std::unique_ptr<TexelSums> {
    return std::make_unique<SkySums>(traced, sky, places, rect, static_cast<std::uint32_t>(raysOfTexel / count), goOn);
  };
  auto maps = bakeTexels(layout, 3, sums, progress);
  if (!maps) return std::nullopt;
  return std::array{std::move((*maps)[0]), std::move((*maps)[1]), std::move((*maps)[2])};
}

} // namespace gnomon
