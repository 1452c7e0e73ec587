#include <algorithm>
#include <limits>

#include "renderer/core/parallel.h"
#include "renderer/reference/frame_nodes.h"
#include "renderer/reference/light_source.h"
#include "renderer/reference/shadow_rays.h"
#include "renderer/reference/trace.h"

namespace gnomon {
namespace {

constexpr std::size_t kPoints = 512; ///< that one core has in hand at a time, at most
constexpr std::size_t kRays = 8192;  ///< that it traces for them, about

/// A light as rays need it.
struct TracedLight {
  LightSource source;
  glm::dvec3 eye{0};                  ///< relative to the anchor
  std::vector<std::uint8_t> shadowed; ///< one an instance: the light throws shadows on it
  Casters casters;
};

TracedLight tracedLight(const TraceInput& input, int index) {
  const Light& light = input.lights[static_cast<std::size_t>(index)];
  const TracedScene::Tree& tree = input.traced.tree();
  const Shadow shadow = light.shadow.value_or(Shadow{});
  const auto isShadowed = [&](const NodeSwitches& node) {
    return shadow.enabled && node.receiveShadow && isLitBy(light, node);
  };
  const auto casts = [&](const NodeSwitches& node) { return castsFrom(light, node); };
  return {lightSource(light, tree.anchor),
          input.camera.eye - tree.anchor,
          instancesWhere(input, isShadowed),
          {tree, instancesWhere(input, casts), shadow.blendedCasters}};
}

/// What a point sees of the light where that takes no rays.
std::optional<float> withoutRays(const TracedLight& light, const SurfacePoint& point, const WayToLight& way) {
  if (point.instance == kNoSurface || light.shadowed[point.instance] == 0) return 1.0f;
  if (!faces(point.normal, way)) return 0.0f;
  if (!reaches(light.source, way)) return 1.0f;
  return std::nullopt;
}

/// Rays of many points, traced kLanes at a time; what comes through is added up for each point.
class RayQueue {
 public:
  RayQueue(const Casters& casters, std::span<float> sums) : casters_(casters), sums_(sums) {}

  void add(const ShadowRay& ray, std::size_t point) {
    rays_[count_] = ray;
    points_[count_] = point;
    if (++count_ == kLanes) trace();
  }

  void trace() {
    const std::array<float, kLanes> shares = sharesThrough(casters_, std::span(rays_).first(count_));
    for (std::size_t i = 0; i < count_; ++i) sums_[points_[i]] += shares[i];
    count_ = 0;
  }

 private:
  const Casters& casters_;
  std::span<float> sums_;
  std::array<ShadowRay, kLanes> rays_{};
  std::array<std::size_t, kLanes> points_{};
  std::size_t count_ = 0;
};

/// Rays to places all over the light's disc; none to those that the surface itself hides.
void addSamples(const LightSource& source, const SurfacePoint& point, const Receiver& receiver, std::uint32_t samples,
                std::size_t index, RayQueue& queue) {
  const std::uint64_t seed = seedOf(point);
  const LightDisc disc = discFacing(source, point.position);
  for (std::uint32_t k = 0; k < samples; ++k) {
    const WayToLight way = wayTo(disc, discSample(k, samples, seed));
    if (glm::dot(way.direction, receiver.normal) > 0) queue.add({receiver, way.direction, way.length}, index);
  }
}

} // namespace

std::vector<std::uint8_t> facesLight(const TraceInput& input, int light, std::span<const SurfacePoint> points) {
  const Light& of = input.lights[static_cast<std::size_t>(light)];
  const LightSource source = lightSource(of, input.traced.tree().anchor);
  const std::vector<std::uint8_t> lit =
      instancesWhere(input, [&](const NodeSwitches& node) { return isLitBy(of, node); });
  std::vector<std::uint8_t> reached(points.size());
  std::transform(points.begin(), points.end(), reached.begin(), [&](const SurfacePoint& point) -> std::uint8_t {
    if (point.instance == kNoSurface || lit[point.instance] == 0) return 0;
    const WayToLight way = wayTo(source, point.position);
    return reaches(source, way) && faces(point.normal, way) ? 1 : 0;
  });
  return reached;
}

std::vector<float> lightVisibility(const TraceInput& input, int light, std::span<const SurfacePoint> points,
                                   int samples) {
  const TracedLight traced = tracedLight(input, light);
  const bool sized = traced.source.radius > 0;
  const auto rays = sized ? static_cast<std::uint32_t>(std::max(samples, 1)) : 1u;
  std::vector<float> visibility(points.size(), 0.0f);
  const auto trace = [&](std::size_t first, std::size_t last) {
    RayQueue queue(traced.casters, visibility);
    for (std::size_t i = first; i < last; ++i) {
      const SurfacePoint& point = points[i];
      const WayToLight way = wayTo(traced.source, point.position);
      if (const auto plain = withoutRays(traced, point, way)) {
        visibility[i] = *plain * static_cast<float>(rays);
        continue;
      }
      const Receiver receiver = receiverAt(traced.casters.tree, traced.eye, point);
      if (sized) {
        addSamples(traced.source, point, receiver, rays, i, queue);
      } else {
        queue.add({receiver, way.direction, way.length}, i);
      }
    }
    queue.trace();
    for (std::size_t i = first; i < last; ++i) visibility[i] /= static_cast<float>(rays);
  };
  forEachPiece(points.size(), std::clamp<std::size_t>(kRays / rays, kLanes, kPoints), trace);
  return visibility;
}

std::vector<float> blockerDistances(const TraceInput& input, int light, std::span<const SurfacePoint> points) {
  const TracedLight traced = tracedLight(input, light);
  std::vector<float> distances(points.size(), std::numeric_limits<float>::infinity());
  forEachPiece(points.size(), kPoints, [&](std::size_t first, std::size_t last) {
    std::array<ShadowRay, kLanes> rays;
    std::array<std::size_t, kLanes> of{};
    std::size_t count = 0;
    const auto trace = [&] {
      const std::array<float, kLanes> found = blockersOf(traced.casters, std::span(rays).first(count));
      for (std::size_t k = 0; k < count; ++k) distances[of[k]] = found[k];
      count = 0;
    };
    for (std::size_t i = first; i < last; ++i) {
      const WayToLight way = wayTo(traced.source, points[i].position);
      if (const auto plain = withoutRays(traced, points[i], way)) {
        if (*plain == 0) distances[i] = 0;
        continue;
      }
      rays[count] = {receiverAt(traced.casters.tree, traced.eye, points[i]), way.direction, way.length};
      of[count] = i;
      if (++count == kLanes) trace();
    }
    trace();
  });
  return distances;
}

} // namespace gnomon
