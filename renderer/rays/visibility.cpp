#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/core/parallel.h"
#include "renderer/rays/light_source.h"
#include "renderer/rays/shadow_rays.h"
#include "renderer/rays/smooth_surface.h"
#include "renderer/rays/trace.h"
#include "renderer/rays/traced_light.h"

namespace gnomon {
namespace {

constexpr std::size_t kPoints = 512; ///< that one core has in hand at a time, at most
constexpr std::size_t kRays = 8192;  ///< that it traces for them, about

std::vector<Opacity> opacities(const TraceInput& input, const Light& light) {
  std::vector<Opacity> opacity(input.traced.view().instances.size(), Opacity::none);
  for (std::uint32_t i = 0; i < opacity.size(); ++i) {
    if (!castsFrom(light, switchesOf(input, i))) continue;
    opacity[i] = stopsAllLight(input.traced.tree().material(i)) ? Opacity::full : Opacity::byAlpha;
  }
  return opacity;
}

bool letThrough(const TracedScene::Tree& tree, std::span<const Opacity> opacity, BlendedCasters blended) {
  if (blended != BlendedCasters::dither) return false;
  for (std::uint32_t i = 0; i < opacity.size(); ++i) {
    if (opacity[i] == Opacity::byAlpha && tree.material(i).lightOpacity) return true;
  }
  return false;
}

/// Rays of many points, traced kLanes at a time; what comes through is added up for each point.
class RayQueue {
 public:
  RayQueue(const Casters& casters, std::span<float> sums) : casters_(casters), sums_(sums) {}

  void add(const SurfacePoint& from, const glm::vec3& start, const WayToLight& way, std::size_t point) {
    points_[rays_.count] = point;
    rays_.add(casters_.tree, from, start, way);
    if (rays_.count == kLanes) trace();
  }

  void trace() {
    const unsigned count = rays_.count;
    const std::array<float, kLanes> shares = sharesThrough(casters_, rays_);
    for (std::size_t i = 0; i < count; ++i) sums_[points_[i]] += shares[i];
  }

 private:
  const Casters& casters_;
  std::span<float> sums_;
  RaysToLight rays_;
  std::array<std::size_t, kLanes> points_{};
};

/// Whether a way leads off the surface, to its normal's side. `cosine`: of the way and the point's normal; what a float
/// normal cannot say, the triangle does.
bool leavesSurface(const Casters& casters, const SurfacePoint& point, const glm::dvec3& direction, double cosine) {
  constexpr double kUnsure = 0x1p-20;
  if (std::abs(cosine) > kUnsure) return cosine > 0;
  return glm::dot(direction, receiverAt(casters.tree, casters.eye, point).normal) > 0;
}

/// Rays to places all over the light's disc; none to those that the surface itself hides.
void addSamples(const LightSource& source, const Casters& casters, const SurfacePoint& point,
                const LightSamples& samples, std::size_t index, RayQueue& queue) {
  const std::uint64_t seed = seedOf(point);
  const LightDisc disc = discFacing(source, point.position);
  const glm::dvec3 normal(point.normal);
  const glm::vec3 start = startOf(casters.tree, point);
  SampleWays ways;
  for (LightSamples left = samples; left.first < left.last; left.first += kLanes) {
    waysTo(disc, left, seed, normal, ways);
    for (std::uint32_t k = 0; k < std::min(kLanes, left.last - left.first); ++k) {
      const WayToLight way{{ways.direction[0][k], ways.direction[1][k], ways.direction[2][k]}, ways.length[k]};
      if (leavesSurface(casters, point, way.direction, ways.cosine[k])) queue.add(point, start, way, index);
    }
  }
}

/// Points, moved to where their rays start. They stay where they are in memory.
class Starts {
 public:
  Starts(const TracedLight::State& of, std::span<const SurfacePoint> points) : of_(of), points_(points) {}

  struct Start {
    const SurfacePoint* point;
    WayToLight way;
  };

  /// REQUIRES: asked of each point once.
  Start of(std::size_t i) {
    const WayToLight way = wayTo(of_.from.light, points_[i].position);
    const auto smooth = of_.smoothStart(points_[i], way);
    if (!smooth) return {&points_[i], way};
    if (moved_.empty()) moved_.reserve(points_.size());
    moved_.push_back(*smooth);
    return {&moved_.back(), wayTo(of_.from.light, smooth->position)};
  }

 private:
  const TracedLight::State& of_;
  std::span<const SurfacePoint> points_;
  std::vector<SurfacePoint> moved_;
};

bool isSmooth(const Light& light) {
  return light.shadow.value_or(Shadow{}).terminator == Terminator::smooth;
}

} // namespace

SurfacePoint shadedPoint(const TraceInput& input, int light, const SurfacePoint& point) {
  const Light& of = input.lights[static_cast<std::size_t>(light)];
  if (!isSmooth(of) || point.instance == kNoSurface) return point;
  const TracedScene::Tree& tree = input.traced.tree();
  const LightSource source = lightSource(of, tree.anchor);
  return smoothPoint(tree, source, point, wayTo(source, point.position)).value_or(point);
}

std::vector<std::uint8_t> facesLight(const TraceInput& input, int light, std::span<const SurfacePoint> points) {
  const Light& of = input.lights[static_cast<std::size_t>(light)];
  const TracedScene::Tree& tree = input.traced.tree();
  const LightSource source = lightSource(of, tree.anchor);
  const bool smooth = isSmooth(of);
  const std::vector<std::uint8_t> lit =
      instancesWhere(input, [&](const NodeSwitches& node) { return isLitBy(of, node); });
  std::vector<std::uint8_t> reached(points.size());
  std::transform(points.begin(), points.end(), reached.begin(), [&](const SurfacePoint& point) -> std::uint8_t {
    if (point.instance == kNoSurface || lit[point.instance] == 0) return 0;
    const WayToLight way = wayTo(source, point.position);
    if (!reaches(source, way) || !faces(glm::vec3(shadingNormal(tree, point)), way)) return 0;
    return faces(point.normal, way) || (smooth && smoothPoint(tree, source, point, way)) ? 1 : 0;
  });
  return reached;
}

TracedLight::TracedLight(const TraceInput& input, int index, int rays) {
  const Light& light = input.lights[static_cast<std::size_t>(index)];
  const TracedScene::Tree& tree = input.traced.tree();
  const Shadow shadow = light.shadow.value_or(Shadow{});
  std::vector<std::uint8_t> shadowed(input.traced.view().instances.size());
  for (std::uint32_t i = 0; i < shadowed.size(); ++i) {
    shadowed[i] = shadow.enabled && receivesFrom(input, light, i) ? 1 : 0;
  }
  std::vector<Opacity> opacity = opacities(input, light);
  LightAndCasters key{lightSource(light, tree.anchor), std::vector<std::uint8_t>(opacity.size()), isSmooth(light)};
  std::transform(opacity.begin(), opacity.end(), key.casts.begin(),
                 [](Opacity of) -> std::uint8_t { return of == Opacity::none ? 0 : 1; });
  const bool through = letThrough(tree, opacity, shadow.blendedCasters);
  state_ = std::unique_ptr<const State>(new State{
      key,
      std::move(shadowed),
      {tree, input.camera.eye - tree.anchor, std::move(opacity), shadow.blendedCasters, roundingIn(tree), through},
      input,
      Interleaved(static_cast<std::uint32_t>(rays)),
      tree.fronts.of(key, tree.boxes.runs())});
}

TracedLight::TracedLight(TracedLight&&) noexcept = default;
TracedLight::~TracedLight() = default;

bool TracedLight::hasSize() const {
  return state_->from.light.radius > 0;
}

void TracedLight::visibility(std::span<const SurfacePoint> points, int samples, std::span<float> shares,
                             std::span<std::uint8_t> turnedAway) const {
  const auto count = static_cast<std::uint32_t>(std::max(samples, 1));
  visibility(points, LightSamples{0, count, count}, shares, turnedAway);
}

void TracedLight::visibility(std::span<const SurfacePoint> points, const LightSamples& samples, std::span<float> shares,
                             std::span<std::uint8_t> turnedAway) const {
  const std::uint32_t rays = hasSize() ? samples.last - samples.first : 1u;
  std::fill(turnedAway.begin(), turnedAway.end(), std::uint8_t{0});
  Starts starts(*state_, points);
  RayQueue queue(state_->casters, shares);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [from, way] = starts.of(i);
    const SurfacePoint& point = *from;
    if (const auto plain = state_->withoutRays(point, way)) {
      shares[i] = *plain * static_cast<float>(rays);
      if (*plain == 0 && !turnedAway.empty()) turnedAway[i] = 1;
      continue;
    }
    shares[i] = 0;
    if (hasSize()) {
      addSamples(state_->from.light, state_->casters, point, samples, i, queue);
    } else {
      queue.add(point, startOf(state_->casters.tree, point), way, i);
    }
  }
  queue.trace();
  if (rays == 1) return;
  for (float& share : shares) share /= static_cast<float>(rays);
}

SurfacePoint TracedLight::pointFacing(const PlacedTriangle& triangle, const glm::dvec2& weights) const {
  const Triangle placed = state_->casters.tree.triangle(triangle.instance, triangle.triangle);
  const Barycentric at{weights.x, weights.y};
  const glm::dvec3 position = at.mix(placed.a, placed.b, placed.c);
  const glm::dvec3 normal = unitAlong(placed.area());
  const bool faces = glm::dot(normal, wayTo(state_->from.light, position).direction) >= 0;
  return {position, glm::vec3(faces ? normal : -normal), triangle.instance, triangle.triangle};
}

void TracedLight::airVisibility(std::span<const glm::dvec3> places, std::span<float> shares) const {
  std::vector<SurfacePoint> points(places.size());
  std::fill(shares.begin(), shares.end(), 0.0f);
  RayQueue queue(state_->casters, shares);
  for (std::size_t i = 0; i < places.size(); ++i) {
    points[i].position = places[i];
    queue.add(points[i], startOf(state_->casters.tree, points[i]), wayTo(state_->from.light, places[i]), i);
  }
  queue.trace();
}

void TracedLight::blockerDistances(std::span<const SurfacePoint> points, std::span<float> distances) const {
  const TracedScene::Tree& tree = state_->casters.tree;
  Starts starts(*state_, points);
  RaysToLight rays;
  std::array<std::size_t, kLanes> of{};
  const auto trace = [&] {
    const unsigned count = rays.count;
    const std::array<float, kLanes> found = blockersOf(state_->casters, rays);
    for (std::size_t k = 0; k < count; ++k) distances[of[k]] = found[k];
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [from, way] = starts.of(i);
    if (const auto plain = state_->withoutRays(*from, way)) {
      distances[i] = *plain == 0 ? 0 : std::numeric_limits<float>::infinity();
      continue;
    }
    of[rays.count] = i;
    rays.add(tree, *from, startOf(tree, *from), way);
    if (rays.count == kLanes) trace();
  }
  trace();
}

void TracedLight::casters(std::span<const SurfacePoint> points, std::span<std::uint32_t> instances) const {
  const TracedScene::Tree& tree = state_->casters.tree;
  Starts starts(*state_, points);
  RaysToLight rays;
  std::array<SurfacePoint, kLanes> from;
  std::array<std::size_t, kLanes> of{};
  const auto trace = [&] {
    const unsigned count = rays.count;
    const std::array<std::uint32_t, kLanes> found = castersOf(state_->casters, rays);
    for (std::size_t k = 0; k < count; ++k) {
      if (found[k] != kNoSurface) instances[of[k]] = found[k];
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    instances[i] = kNoSurface;
    if (points[i].instance == kNoSurface || state_->shadowed[points[i].instance] == 0) continue;
    const auto [start, way] = starts.of(i);
    SurfacePoint point = *start;
    if (!reaches(state_->from.light, way)) continue;
    if (!faces(point.normal, way)) {
      if (state_->casters.opacity[point.instance] != Opacity::none) instances[i] = point.instance;
      if (glm::dot(glm::dvec3(point.normal), way.direction) < 0) point.normal = -point.normal; // the light's side
    }
    of[rays.count] = i;
    from[rays.count] = point;
    rays.add(tree, from[rays.count], startOf(tree, point), way);
    if (rays.count == kLanes) trace();
  }
  trace();
}

namespace {

/// A value of each point: `trace(points, values)` for pieces of at most `most` points, on all cores.
template <class Value, class Trace>
std::vector<Value> traceInPieces(std::span<const SurfacePoint> points, std::size_t most, Trace trace) {
  std::vector<Value> values(points.size());
  forEachPiece(points.size(), most, [&](std::size_t first, std::size_t last) {
    trace(points.subspan(first, last - first), std::span(values).subspan(first, last - first));
  });
  return values;
}

} // namespace

std::vector<float> lightVisibility(const TraceInput& input, int light, std::span<const SurfacePoint> points,
                                   int samples) {
  const TracedLight traced(input, light);
  const auto rays = traced.hasSize() ? static_cast<std::size_t>(std::max(samples, 1)) : 1u;
  return traceInPieces<float>(points, std::clamp<std::size_t>(kRays / rays, kLanes, kPoints),
                              [&](auto piece, auto shares) { traced.visibility(piece, samples, shares); });
}

std::vector<float> blockerDistances(const TraceInput& input, int light, std::span<const SurfacePoint> points) {
  const TracedLight traced(input, light);
  return traceInPieces<float>(points, kPoints,
                              [&](auto piece, auto distances) { traced.blockerDistances(piece, distances); });
}

std::vector<std::uint32_t> casterInstances(const TraceInput& input, int light, std::span<const SurfacePoint> points) {
  const TracedLight traced(input, light);
  return traceInPieces<std::uint32_t>(points, kPoints,
                                      [&](auto piece, auto instances) { traced.casters(piece, instances); });
}

} // namespace gnomon
