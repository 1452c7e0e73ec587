#include <algorithm>
#include <array>

#include "renderer/rays/drawn_query.h"
#include "renderer/rays/trace_packet.h"
#include "renderer/rays/traced_light.h"

namespace gnomon {
namespace {

static_assert(DrawnPlaces::kCount == kLanes);

SurfacePoint exactly(const DrawnQuery& query, unsigned lane) {
  const DrawnPlaces& places = *query.places;
  const glm::vec2 place(places.x[lane], places.y[lane]);
  SurfacePoint point;
  pointsOn(*query.input, {&place, 1}, {&places.shown[lane], 1}, {&point, 1});
  return point;
}

/// A place on a light is where the float says.
WayToLight exactWay(const DrawnQuery& query, const SurfacePoint& point, unsigned lane) {
  if (!(query.source->radius > 0)) return wayTo(*query.source, point.position);
  const DrawnPoints& points = *query.points;
  return {glm::normalize(glm::dvec3(laneOf(points.toward, lane))),
          double{points.length[lane]} / query.casters->tree.scale};
}

/// Floats decide where they are sure, and else the exact point does. Where alpha is read, that one always does for a
/// light without a size; rays to one with a size go to some place of it anyway, and the rim of a hole may be off by a
/// float's rounding.
double opacityOf(const DrawnQuery& query, const Candidate& hit) {
  const Casters& casters = *query.casters;
  const Opacity opacity = casters.opacity[hit.instance];
  if (opacity == Opacity::none) return 0;
  const PlacedTriangle& own = query.places->shown[hit.lane];
  if (hit.instance == own.instance && hit.triangle == own.triangle) return 0;
  if (opacity == Opacity::full || query.source->radius > 0) {
    const DrawnPoints& points = *query.points;
    const double metres = 1.0 / casters.tree.scale;
    const SurfacePoint near{glm::dvec3(laneOf(points.relative, hit.lane)) * metres + casters.eye,
                            laneOf(points.normal, hit.lane), own.instance, own.triangle};
    const RayToLight ray{&near,
                         {glm::dvec3(laneOf(points.toward, hit.lane)), double{points.length[hit.lane]} * metres}};
    const double rounding = casters.rounding + 2 * double{points.unsure[hit.lane]} * metres;
    if (surelyMeets(ray, casters.tree.triangle(hit.instance, hit.triangle), rounding)) {
      return opacity == Opacity::full ? 1 : opacityAt(casters, {hit.instance, hit.triangle}, {hit.u, hit.v});
    }
  }
  const SurfacePoint point = exactly(query, hit.lane);
  return opacityOf(casters, RayToLight{&point, exactWay(query, point, hit.lane)}, hit);
}

void keepOpaque(const RTCFilterFunctionNArguments* call) {
  auto& query = *reinterpret_cast<DrawnQuery*>(call->context);
  filterCandidates(*call, [&](const Candidate& hit) {
    const double opacity = opacityOf(query, hit);
    query.through[hit.lane] *= static_cast<float>(1 - opacity);
    return opacity >= 1;
  });
}

} // namespace

std::array<float, kLanes> sharesThrough(DrawnQuery& query, const Lanes& lanes) {
  rtcInitIntersectContext(&query.context);
  query.context.flags = query.casters->closeRays();
  query.context.filter = keepOpaque;
  query.through.fill(1);
  const DrawnPoints& points = *query.points;
  RTCRay16 rays;
  setAllRays(rays);
  std::copy_n(points.start[0], kLanes, rays.org_x);
  std::copy_n(points.start[1], kLanes, rays.org_y);
  std::copy_n(points.start[2], kLanes, rays.org_z);
  std::copy_n(points.toward[0], kLanes, rays.dir_x);
  std::copy_n(points.toward[1], kLanes, rays.dir_y);
  std::copy_n(points.toward[2], kLanes, rays.dir_z);
  std::copy_n(points.length, kLanes, rays.tfar);
  occlude(query.casters->tree, lanes, query.context, rays);
  std::array<float, kLanes> shares{};
  for (unsigned i = 0; i < kLanes; ++i) shares[i] = rays.tfar[i] < 0 ? 0.0f : query.through[i];
  return shares;
}

namespace {

SquarePlaces shiftsOf(const DrawnPlaces& places, const Interleaved& all, bool aligned) {
  SquarePlaces shifts;
  for (unsigned i = 0; i < kLanes; ++i) {
    const SquarePlace& shift =
        all.shift(static_cast<std::uint32_t>(places.x[i]), static_cast<std::uint32_t>(places.y[i]), aligned);
    shifts.x[i] = shift.x;
    shifts.y[i] = shift.y;
  }
  return shifts;
}

/// The mean over rays `first` up to `last` to places all over the light, for each lane that is active. Lanes with
/// a ray that floats can't decide become unsure instead.
std::array<float, kLanes> meanThrough(DrawnQuery& query, DrawnPoints& points, const DrawnLight& light,
                                      std::uint32_t first, std::uint32_t last, const Interleaved& all, Lanes& lanes,
                                      Lanes& unsure) {
  bool aligned = Interleaved::isAligned(first, first, last);
  SquarePlaces shifts = shiftsOf(*query.places, all, aligned);
  std::array<float, kLanes> sums{};
  for (std::uint32_t ray = first; ray < last; ++ray) {
    if (Interleaved::isAligned(ray, first, last) != aligned) {
      aligned = !aligned;
      shifts = shiftsOf(*query.places, all, aligned);
    }
    const SquarePlace& place = all.place(ray);
    SquarePlaces at;
    for (unsigned i = 0; i < kLanes; ++i) {
      at.x[i] = place.x ^ shifts.x[i];
      at.y[i] = place.y ^ shifts.y[i];
    }
    aimAside(light, at, points);
    Lanes traced;
    for (unsigned i = 0; i < kLanes; ++i) {
      unsure.active[i] |= lanes.active[i] & ~points.sure[i];
      lanes.active[i] &= points.sure[i];
      traced.active[i] = lanes.active[i] & points.leaves[i];
    }
    if (!traced.any()) continue;
    const std::array<float, kLanes> found = sharesThrough(query, traced);
    for (unsigned i = 0; i < kLanes; ++i) sums[i] += traced.active[i] != 0 ? found[i] : 0.0f;
  }
  for (float& sum : sums) sum /= static_cast<float>(last - first);
  return sums;
}

/// Of the lanes that are asked for: which ones a ray decides, which ones floats can't, and what the others see.
void sort(const DrawnPoints& points, const Lanes& asked, Lanes& lit, Lanes& unsure, float* shares,
          std::uint8_t* turnedAway) {
  const int* ask = asked.active.data();
  int* rays = lit.active.data();
  int* doubtful = unsure.active.data();
  for (unsigned i = 0; i < kLanes; ++i) {
    const int sure = ask[i] & points.sure[i];
    doubtful[i] = ask[i] & ~points.sure[i];
    rays[i] = sure & points.faces[i] & points.reached[i];
  }
  for (unsigned i = 0; i < kLanes; ++i) {
    const int away = ask[i] & points.sure[i] & ~points.faces[i];
    shares[i] = away != 0 ? 0.0f : 1.0f;
    turnedAway[i] = static_cast<std::uint8_t>(away & 1);
  }
}

/// Makes those lanes unsure where the surface that shading shows may replace a triangle whose plane leaves some of the
/// light behind it.
void leaveSmooth(const TracedLight::State& of, const DrawnPlaces& places, const DrawnPoints& points, const Lanes& asked,
                 Lanes& lit, Lanes& unsure) {
  Lanes low;
  for (unsigned i = 0; i < kLanes; ++i) {
    const float whole = of.light.directional ? of.light.radius : of.light.radius / points.length[i];
    const float cosine = glm::dot(laneOf(points.normal, i), laneOf(points.toward, i));
    const int cut = of.light.radius > 0 && cosine <= whole + points.turn[i] + 0x1p-12f ? -1 : 0;
    low.active[i] = asked.active[i] & ~unsure.active[i] & (~points.faces[i] | cut);
  }
  if (!low.any()) return;
  for (unsigned i = 0; i < kLanes; ++i) {
    if (low.active[i] == 0) continue;
    if (!mayFace(of.casters.tree, of.from.light, places.shown[i], glm::dvec3(laneOf(points.normal, i)))) continue;
    lit.active[i] = 0;
    unsure.active[i] = -1;
  }
}

} // namespace

void TracedLight::exactVisibility(const DrawnPlaces& places, const Lanes& lanes, const LightSamples& samples,
                                  std::span<float> shares, std::span<std::uint8_t> turnedAway) const {
  std::array<glm::vec2, kLanes> at;
  std::array<PlacedTriangle, kLanes> shown;
  std::array<unsigned, kLanes> laneOf{};
  std::size_t count = 0;
  for (unsigned i = 0; i < kLanes; ++i) {
    if (lanes.active[i] == 0) continue;
    at[count] = {places.x[i], places.y[i]};
    shown[count] = places.shown[i];
    laneOf[count++] = i;
  }
  std::array<SurfacePoint, kLanes> points;
  std::array<float, kLanes> found{};
  std::array<std::uint8_t, kLanes> away{};
  pointsOn(state_->input, std::span(at).first(count), std::span(shown).first(count), std::span(points).first(count));
  visibility(std::span(points).first(count), samples, std::span(found).first(count), std::span(away).first(count));
  for (std::size_t i = 0; i < count; ++i) {
    shares[laneOf[i]] = found[i];
    turnedAway[laneOf[i]] = away[i];
  }
}

void TracedLight::visibility(const DrawnPlaces& places, std::uint32_t first, std::uint32_t last,
                             std::span<float> shares, std::span<std::uint8_t> turnedAway) const {
  const State& of = *state_;
  const std::uint8_t* shadowed = of.shadowed.data();
  Lanes asked;
  int* ask = asked.active.data();
  for (unsigned i = 0; i < kLanes; ++i) {
    const std::uint32_t instance = places.shown[i].instance;
    ask[i] = instance != kNoSurface && shadowed[instance] != 0 ? -1 : 0;
  }
  std::fill_n(turnedAway.data(), kLanes, std::uint8_t{0});
  std::fill_n(shares.data(), kLanes, 1.0f);
  if (!asked.any()) return;
  DrawnPoints points;
  setTriangles(of.casters.tree, places, points);
  findPoints(of.view, places, points);
  aim(of.light, points);
  Lanes unsure;
  Lanes lit;
  sort(points, asked, lit, unsure, shares.data(), turnedAway.data());
  if (of.from.smooth) leaveSmooth(of, places, points, asked, lit, unsure);
  if (lit.any()) {
    DrawnQuery query{{}, &of.casters, &of.from.light, &of.input, &places, &points};
    const std::array<float, kLanes> found =
        hasSize() ? meanThrough(query, points, of.light, first, last, of.places, lit, unsure)
                  : sharesThrough(query, lit);
    for (unsigned i = 0; i < kLanes; ++i) shares[i] = lit.active[i] != 0 ? found[i] : shares[i];
  }
  if (unsure.any()) exactVisibility(places, unsure, {first, last, 0}, shares, turnedAway);
}

} // namespace gnomon
