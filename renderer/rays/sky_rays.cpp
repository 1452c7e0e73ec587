#include "renderer/rays/sky_rays.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/instruction_sets.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/rays/drawn_query.h"
#include "renderer/rays/smooth_surface.h"
#include "renderer/rays/tree.h"
#include "renderer/volume/transmittance.h"

namespace gnomon {

/// What an instance's surface is to its shading.
struct SkyShaded {
  glm::mat3 turn{1}; ///< of normals
  float roughness = 1;
  bool receives = false;
  bool turned = false; ///< shading normals are on the eye's side
};

namespace {

/// As a light that rays go to all places of.
LightSource sourceAround() {
  LightSource source;
  source.radius = 1;
  return source;
}

std::vector<Opacity> skyOpacities(const TraceInput& input) {
  std::vector<Opacity> opacity(input.traced.view().instances.size(), Opacity::none);
  for (std::uint32_t i = 0; i < opacity.size(); ++i) {
    if (!switchesOf(input, i).castShadow) continue;
    opacity[i] = stopsAllLight(input.traced.tree().material(i)) ? Opacity::full : Opacity::byAlpha;
  }
  return opacity;
}

Casters skyCasters(const TraceInput& input) {
  const TracedScene::Tree& tree = input.traced.tree();
  Casters casters{tree, input.camera.eye - tree.anchor, skyOpacities(input), BlendedCasters::dither, roundingIn(tree)};
  for (std::uint32_t i = 0; i < casters.opacity.size(); ++i) {
    casters.letThrough |= casters.opacity[i] == Opacity::byAlpha && tree.material(i).lightOpacity.has_value();
  }
  return casters;
}

std::vector<SkyShaded> shadedInstances(const TraceInput& input) {
  const TracedScene::Tree& tree = input.traced.tree();
  std::vector<SkyShaded> all(tree.view->instances.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const Material& material = tree.material(i);
    all[i] = {glm::mat3(normalMatrix(glm::dmat3(tree.instance(i).worldFromLocal))), material.roughnessFactor,
              receivesShadows(switchesOf(input, i), material), material.doubleSided};
  }
  return all;
}

static_assert(EndlessRays::kCount == kLanes);

void setFrom(EndlessRays& rays, unsigned lane, const glm::dvec3& from) {
  for (int axis = 0; axis < 3; ++axis) rays.from[axis][lane] = from[axis];
}

/// The rays that still bring light, to be dimmed.
EndlessRays raysTo(const Casters& casters, const DrawnPoints& points, const SkyWays& ways,
                   const std::array<SurfacePoint, kLanes>& exact, const std::array<float, kLanes>& shares) {
  EndlessRays rays;
  std::copy_n(&ways.toward[0][0], 3 * kLanes, &rays.toward[0][0]);
  const double metres = 1 / casters.tree.scale;
  for (unsigned i = 0; i < kLanes; ++i) {
    rays.asked[i] = shares[i] > 0 ? ways.asked[i] : 0;
    const glm::dvec3 place =
        points.sure[i] != 0 ? glm::dvec3(laneOf(points.relative, i)) * metres + casters.eye : exact[i].position;
    setFrom(rays, i, rays.asked[i] != 0 ? place : casters.eye);
  }
  return rays;
}

/// Dims what comes to `point` along the first `ways.size()` lanes.
void dim(const Transmittance& media, const SurfacePoint& point, std::span<const glm::dvec3> ways, float* shares) {
  EndlessRays rays{};
  for (unsigned i = 0; i < ways.size(); ++i) {
    rays.asked[i] = shares[i] > 0 ? -1 : 0;
    setFrom(rays, i, point.position);
    for (int axis = 0; axis < 3; ++axis) rays.toward[axis][i] = static_cast<float>(ways[i][axis]);
  }
  const std::array<float, kLanes> through = media.along(rays);
  for (unsigned i = 0; i < ways.size(); ++i) shares[i] *= through[i];
}

} // namespace

struct TracedSky::State {
  TraceInput input;
  Casters casters;
  LightSource source;
  std::vector<SkyShaded> instances;
  DrawnView view;
  Transmittance media;
};

TracedSky::TracedSky(const TraceInput& input)
    : state_(new State{input, skyCasters(input), sourceAround(), shadedInstances(input),
                       drawnView(sightOf(input), input.traced.tree().scale),
                       Transmittance(input.media, input.traced.tree().anchor)}) {}
TracedSky::~TracedSky() = default;

bool TracedSky::receives(std::uint32_t instance) const {
  return state_->instances[instance].receives;
}

SurfacePoint TracedSky::pointInFront(const PlacedTriangle& of, const glm::dvec2& weights) const {
  const TracedScene::Tree& tree = state_->casters.tree;
  const Triangle triangle = tree.triangle(of.instance, of.triangle);
  const glm::dvec3 normal = unitAlong(triangle.area()) * (tree.mirrored[of.instance] != 0 ? -1.0 : 1.0);
  const Barycentric at{weights.x, weights.y};
  return {at.mix(triangle.a, triangle.b, triangle.c), glm::vec3(normal), of.instance, of.triangle};
}

glm::dvec3 TracedSky::shadingNormal(const SurfacePoint& point) const {
  return gnomon::shadingNormal(state_->casters.tree, point);
}

void TracedSky::through(const SurfacePoint& point, std::span<const glm::dvec3> ways, std::span<float> shares) const {
  const glm::vec3 start = startOf(state_->casters.tree, point);
  RaysToLight rays;
  std::size_t first = 0;
  const auto trace = [&] {
    const unsigned count = rays.count;
    const std::array<float, kLanes> found = sharesThrough(state_->casters, rays);
    std::copy_n(found.begin(), count, shares.begin() + static_cast<std::ptrdiff_t>(first));
    if (!state_->media.empty()) dim(state_->media, point, ways.subspan(first, count), shares.data() + first);
    first += count;
  };
  for (const glm::dvec3& way : ways) {
    rays.add(state_->casters.tree, point, start, {way, HUGE_VAL});
    if (rays.count == kLanes) trace();
  }
  trace();
}

void TracedSky::through(const glm::dvec3& place, std::span<const glm::dvec3> ways, std::span<float> shares) const {
  SurfacePoint inAir;
  inAir.position = place - state_->casters.tree.anchor;
  through(inAir, ways, shares);
}

struct SkyPacket::Starts {
  DrawnPlaces places;
  DrawnPoints points;
  std::array<SurfacePoint, kLanes> exact; ///< where floats are not sure
  float corners[3][3][kLanes];            ///< normals, in the world; by corner and axis
};

namespace {

/// Mixes corners' normals by the points' weights; the triangle's where they have none.
GNOMON_FOR_EACH_INSTRUCTION_SET void mixNormals(const float (&corners)[3][3][kLanes], const DrawnPoints& points,
                                                const int* turned, SkyPlaces& places) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::vec3 face = laneOf(places.normal, i);
    const float u = points.u[i];
    const float v = points.v[i];
    const glm::vec3 mixed = laneOf(corners[0], i) * (1 - u - v) + laneOf(corners[1], i) * u + laneOf(corners[2], i) * v;
    const float squared = glm::dot(mixed, mixed);
    const bool known = squared > 1e-20f && squared < 1e20f;
    const float over = 1 / std::sqrt(known ? squared : 1.0f);
    const float side = turned[i] != 0 && glm::dot(mixed, face) < 0 ? -over : over;
    for (unsigned axis = 0; axis < 3; ++axis) {
      places.shading[axis][i] = known ? mixed[static_cast<int>(axis)] * side : face[static_cast<int>(axis)];
    }
  }
}

} // namespace

SkyPacket::SkyPacket(const TracedSky& sky) : sky_(sky), starts_(new Starts) {}
SkyPacket::~SkyPacket() = default;

void SkyPacket::start(const DrawnPlaces& drawn) {
  const TracedSky::State& of = sky_.state();
  const TracedScene::Tree& tree = of.casters.tree;
  Starts& starts = *starts_;
  starts.places = drawn;
  setTriangles(tree, drawn, starts.points);
  findPoints(of.view, drawn, starts.points);
  std::copy_n(&starts.points.normal[0][0], 3 * kLanes, &places_.normal[0][0]);
  alignas(64) int turned[kLanes];
  const glm::vec3 back(-of.input.camera.forward);
  for (unsigned i = 0; i < kLanes; ++i) {
    const PlacedTriangle& shown = drawn.shown[i];
    const bool shows = shown.instance != kNoSurface;
    const SkyShaded shaded = shows ? of.instances[shown.instance] : SkyShaded{};
    places_.receives[i] = shaded.receives ? -1 : 0;
    places_.roughness[i] = shaded.roughness;
    turned[i] = shaded.turned ? -1 : 0;
    if (shows && starts.points.sure[i] == 0) {
      const glm::vec2 place(drawn.x[i], drawn.y[i]);
      pointsOn(of.input, {&place, 1}, {&shown, 1}, {&starts.exact[i], 1});
      for (int axis = 0; axis < 3; ++axis) places_.normal[axis][i] = starts.exact[i].normal[axis];
    }
    const auto vertices =
        shows ? tree.vertices(shown.instance, shown.triangle) : std::array<const VertexAttributes*, 3>{};
    for (unsigned corner = 0; corner < 3; ++corner) {
      const glm::vec3 normal = shows ? shaded.turn * vertices[corner]->normal : glm::vec3(0);
      for (unsigned axis = 0; axis < 3; ++axis) {
        starts.corners[corner][axis][i] = normal[static_cast<int>(axis)];
      }
    }
    const glm::vec3 relative = laneOf(starts.points.relative, i);
    const glm::vec3 toEye = of.input.camera.perspective ? -relative / glm::length(relative) : back;
    for (int axis = 0; axis < 3; ++axis) places_.toEye[axis][i] = toEye[axis];
  }
  mixNormals(starts.corners, starts.points, turned, places_);
}

std::array<float, SkyPlaces::kCount> SkyPacket::through(const SkyWays& ways) {
  const TracedSky::State& of = sky_.state();
  Starts& starts = *starts_;
  Lanes sure;
  unsigned exact = 0;
  for (unsigned i = 0; i < kLanes; ++i) {
    sure.active[i] = ways.asked[i] & starts.points.sure[i];
    exact |= static_cast<unsigned>(ways.asked[i] & ~starts.points.sure[i] & 1) << i;
  }
  std::array<float, kLanes> shares{};
  if (sure.any()) {
    std::copy_n(&ways.toward[0][0], 3 * kLanes, &starts.points.toward[0][0]);
    std::fill_n(starts.points.length, kLanes, HUGE_VALF);
    DrawnQuery query{{}, &of.casters, &of.source, &of.input, &starts.places, &starts.points};
    shares = sharesThrough(query, sure);
    for (unsigned i = 0; i < kLanes; ++i) shares[i] = sure.active[i] != 0 ? shares[i] : 0.0f;
  }
  if (exact != 0) traceExactly(ways, exact, shares);
  if (of.media.empty()) return shares;
  const std::array<float, kLanes> through =
      of.media.along(raysTo(of.casters, starts.points, ways, starts.exact, shares));
  for (unsigned i = 0; i < kLanes; ++i) shares[i] *= through[i];
  return shares;
}

void SkyPacket::traceExactly(const SkyWays& ways, unsigned lanesAsked, std::array<float, kLanes>& shares) const {
  const Casters& casters = sky_.state().casters;
  const Starts& starts = *starts_;
  RaysToLight rays;
  std::array<unsigned, kLanes> lanes{};
  for (unsigned i = 0; i < kLanes; ++i) {
    if ((lanesAsked >> i & 1u) == 0) continue;
    lanes[rays.count] = i;
    rays.add(casters.tree, starts.exact[i], startOf(casters.tree, starts.exact[i]),
             {glm::normalize(glm::dvec3(laneOf(ways.toward, i))), HUGE_VAL});
  }
  const unsigned count = rays.count;
  const std::array<float, kLanes> found = sharesThrough(casters, rays);
  for (unsigned i = 0; i < count; ++i) shares[lanes[i]] = found[i];
}

} // namespace gnomon
