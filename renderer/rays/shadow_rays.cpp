#include "renderer/rays/shadow_rays.h"

#include <cmath>

#include "renderer/rays/alpha.h"
#include "renderer/rays/trace_packet.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double sumOf(const glm::dvec3& v) {
  return v.x + v.y + v.z;
}

/// Embree's context, and what its filters need of the rays.
struct LightQuery {
  RTCIntersectContext context;
  const Casters* casters = nullptr;
  std::span<const RayToLight> rays;
  std::array<float, kLanes> through{};   ///< of the light, past the casters met so far that let some of it through
  std::array<double, kLanes> farthest{}; ///< metres to the caster that is nearest to the light so far; 0 = none yet
  std::array<std::uint32_t, kLanes> caster{}; ///< its instance
};

bool meetsCaster(const Casters& casters, const RayToLight& ray, const Triangle& caster) {
  if (!ray.from->smooth && surelyMeets(ray, caster, casters.rounding)) return true;
  const Receiver receiver = receiverAt(casters.tree, casters.eye, *ray.from);
  return meets({receiver, ray.way.direction, ray.way.length}, caster).has_value();
}

LightQuery& queryOf(const RTCFilterFunctionNArguments* call) {
  return *reinterpret_cast<LightQuery*>(call->context);
}

void keepOpaque(const RTCFilterFunctionNArguments* call) {
  LightQuery& query = queryOf(call);
  filterCandidates(*call, [&](const Candidate& hit) {
    const double opacity = opacityOf(*query.casters, query.rays[hit.lane], hit);
    query.through[hit.lane] *= static_cast<float>(1 - opacity);
    return opacity >= 1;
  });
}

void keepHalfOpaque(const RTCFilterFunctionNArguments* call) {
  const LightQuery& query = queryOf(call);
  filterCandidates(*call,
                   [&](const Candidate& hit) { return opacityOf(*query.casters, query.rays[hit.lane], hit) > 0.5; });
}

/// Takes note of the caster that is farthest along the ray, and goes on.
void noteFarthest(const RTCFilterFunctionNArguments* call) {
  LightQuery& query = queryOf(call);
  filterCandidates(*call, [&](const Candidate& hit) {
    const RayToLight& ray = query.rays[hit.lane];
    if (opacityOf(*query.casters, ray, hit) <= 0.5) return false;
    const Triangle caster = query.casters->tree.triangle(hit.instance, hit.triangle);
    const glm::dvec3 area = caster.area();
    const double distance = glm::dot(area, caster.a - ray.from->position) / glm::dot(area, ray.way.direction);
    if (distance > query.farthest[hit.lane]) {
      query.farthest[hit.lane] = distance;
      query.caster[hit.lane] = hit.instance;
    }
    return false;
  });
}

LightQuery queryFor(const Casters& casters, const RaysToLight& rays, RTCFilterFunctionN filter) {
  LightQuery query;
  rtcInitIntersectContext(&query.context);
  query.context.flags = casters.closeRays();
  query.context.filter = filter;
  query.casters = &casters;
  query.rays = rays.rays;
  query.through.fill(1);
  query.caster.fill(kNoSurface);
  return query;
}

} // namespace

double opacityOf(const Casters& casters, const RayToLight& ray, const Candidate& hit) {
  const Opacity opacity = casters.opacity[hit.instance];
  if (opacity == Opacity::none) return 0;
  if (hit.instance == ray.from->instance && hit.triangle == ray.from->triangle) return 0;
  const Triangle triangle = casters.tree.triangle(hit.instance, hit.triangle);
  const bool inAir = ray.from->instance == kNoSurface; // no plane that rounding moves
  if (!inAir && !meetsCaster(casters, ray, triangle)) return 0;
  if (opacity == Opacity::full) return 1;
  return opacityAt(casters, {hit.instance, hit.triangle},
                   crossing(triangle, ray.from->position, ray.way.direction, {hit.u, hit.v}));
}

double opacityAt(const Casters& casters, const PlacedTriangle& caster, const Barycentric& at) {
  const Material& material = casters.tree.material(caster.instance);
  const double alpha = hasHoles(material) ? alphaAt(casters.tree, caster.instance, caster.triangle, at) : 1.0;
  if (material.lightOpacity && casters.blended == BlendedCasters::dither) {
    return std::clamp(alpha * *material.lightOpacity, 0.0, 1.0);
  }
  return alpha >= material.cutoff.value_or(0) ? 1 : 0;
}

Receiver receiverAt(const TracedScene::Tree& tree, const glm::dvec3& eye, const SurfacePoint& point) {
  const Triangle triangle = tree.triangle(point.instance, point.triangle);
  const glm::dvec3 own = point.smooth ? glm::dvec3(point.normal) : unitAlong(triangle.area());
  const double side = glm::dot(own, glm::dvec3(point.normal)) < 0 ? -1.0 : 1.0;
  // The ray began at the eye, or where it came near the scene.
  const double sight = std::min(glm::length(point.position - eye), glm::length(2.0 * tree.bounds.halfExtent()));
  return {point.position, side * own, triangle, 4 * kHalfUnit * sight, point.instance, point.triangle};
}

std::optional<double> meets(const ShadowRay& ray, const Triangle& caster) {
  const Receiver& from = ray.from;
  const glm::dvec3 largest = glm::max(from.corners.largest(), caster.largest());
  const double height =
      std::max({glm::dot(from.normal, caster.a - from.position), glm::dot(from.normal, caster.b - from.position),
                glm::dot(from.normal, caster.c - from.position)});
  if (height <= roundingAlong(from.normal, largest) + from.unsure) return std::nullopt;
  const glm::dvec3 normal = unitAlong(caster.area());
  // A small triangle knows its plane only nearby; then the plane of the large one beside it decides.
  const auto off = [&](const glm::dvec3& corner) { return std::abs(glm::dot(normal, corner - caster.a)); };
  if (std::max({off(from.corners.a), off(from.corners.b), off(from.corners.c)}) <=
      roundingAlong(normal, largest) + from.unsure) {
    return std::nullopt;
  }
  const double across = glm::dot(normal, ray.direction);
  const double away = glm::dot(normal, caster.a - from.position);
  if (std::abs(away) <= samePlane(normal, largest)) return std::nullopt; // as of a neighbour that it shares a side with
  const double distance = away / across;
  if (!(distance > 0 && distance < ray.length)) return std::nullopt;
  if (std::isinf(ray.length)) return distance;
  // A light in the very plane of the caster shines past it.
  const glm::dvec3 light = from.position + ray.direction * ray.length;
  const double beyond = std::abs(ray.length * across - away);
  if (beyond <= roundingAlong(normal, glm::max(caster.largest(), glm::abs(light)))) return std::nullopt;
  return distance;
}

double roundingAlong(const glm::dvec3& normal, const glm::dvec3& largest) {
  return 8 * kHalfUnit * glm::dot(glm::abs(normal), largest);
}

double roundingIn(const TracedScene::Tree& tree) {
  if (tree.bounds.empty()) return 0;
  const glm::dvec3 largest = glm::max(glm::abs(tree.bounds.min), glm::abs(tree.bounds.max));
  return 16 * kHalfUnit * (sumOf(largest) + glm::length(2.0 * tree.bounds.halfExtent()));
}

bool surelyMeets(const RayToLight& ray, const Triangle& caster, double rounding) {
  const glm::dvec3& point = ray.from->position;
  const glm::dvec3 area = caster.area();
  const double across = glm::dot(area, ray.way.direction);
  const double away = glm::dot(area, caster.a - point);
  // Some corner of the receiver lies as far off the caster's plane as the point does.
  const double squared = glm::dot(area, area);
  if (!(away * away > rounding * rounding * squared)) return false;
  const double distance = away / across;
  if (!(distance > 0 && distance < ray.way.length)) return false;
  const glm::dvec3 normal(ray.from->normal);
  const auto rises = [&](const glm::dvec3& corner) { return glm::dot(normal, corner - point) > rounding; };
  if (!rises(caster.a) && !rises(caster.b) && !rises(caster.c)) return false;
  if (std::isinf(ray.way.length)) return true;
  const glm::dvec3 light = point + ray.way.direction * ray.way.length;
  const double beyond = ray.way.length * across - away;
  const double unsure = rounding + 16 * kHalfUnit * sumOf(glm::abs(light));
  return beyond * beyond > unsure * unsure * squared;
}

std::array<float, kLanes> sharesThrough(const Casters& casters, RaysToLight& rays) {
  LightQuery query = queryFor(casters, rays, keepOpaque);
  const Lanes lanes = firstLanes(rays.count);
  occlude(casters.tree, lanes, query.context, rays.packet.ray);
  std::array<float, kLanes> shares{};
  for (unsigned i = 0; i < rays.count; ++i) shares[i] = rays.packet.ray.tfar[i] < 0 ? 0.0f : query.through[i];
  rays.count = 0;
  return shares;
}

std::array<float, kLanes> blockersOf(const Casters& casters, RaysToLight& rays) {
  LightQuery query = queryFor(casters, rays, keepHalfOpaque);
  RTCHit16& hits = rays.packet.hit;
  std::fill_n(hits.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
  const Lanes lanes = firstLanes(rays.count);
  intersect(casters.tree, lanes, query.context, rays.packet);
  std::array<float, kLanes> distances{};
  for (unsigned i = 0; i < rays.count; ++i) {
    distances[i] = std::numeric_limits<float>::infinity();
    if (hits.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const auto& [from, way] = rays.rays[i];
    const ShadowRay ray{receiverAt(casters.tree, casters.eye, *from), way.direction, way.length};
    const PlacedTriangle met = metBy(hits, i);
    const Triangle caster = casters.tree.triangle(met.instance, met.triangle);
    distances[i] = static_cast<float>(meets(ray, caster).value_or(kInfinity));
  }
  rays.count = 0;
  return distances;
}

std::array<std::uint32_t, kLanes> castersOf(const Casters& casters, RaysToLight& rays) {
  LightQuery query = queryFor(casters, rays, noteFarthest);
  occlude(casters.tree, firstLanes(rays.count), query.context, rays.packet.ray);
  rays.count = 0;
  return query.caster;
}

} // namespace gnomon
