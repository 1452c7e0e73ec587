#include <algorithm>

#include "renderer/core/parallel.h"
#include "renderer/rays/alpha.h"
#include "renderer/rays/crossings.h"
#include "renderer/rays/drawn_points.h"
#include "renderer/rays/trace.h"
#include "renderer/rays/trace_packet.h"
#include "renderer/rays/tree.h"
#include "renderer/rays/triangle.h"

namespace gnomon {
namespace {

constexpr std::size_t kRaysAtOnce = 512; ///< traced by one core at a time

Aabb grown(const Aabb& box) {
  if (box.empty()) return box;
  const glm::dvec3 half = box.halfExtent();
  const double margin = std::max({half.x, half.y, half.z}) / 64;
  return {box.min - margin, box.max + margin};
}

struct Eye {
  const TraceInput& input;
  const TracedScene::Tree& tree;
  std::span<const std::uint8_t> visible; ///< one an instance
  Sight sight = sightOf(input);
  Aabb bounds = grown(tree.bounds);
};

/// Embree's context, and what its filter needs of the rays.
struct EyeQuery {
  RTCIntersectContext context;
  const Eye* eye = nullptr;
  Places places;
  Lines lines;
};

/// What the camera sees of a triangle's plane in the middle of the pixel that a place lies in, and of the pixels right
/// of it and below: a picture reads a mask there, once for all samples of a pixel. `at`: at the place itself.
SeenPlace seenPlace(const Eye& eye, const PlacedTriangle& hit, const glm::vec2& place, const Barycentric& at) {
  const Triangle triangle = eye.tree.triangle(hit.instance, hit.triangle);
  const glm::vec2 middle = glm::floor(place) + 0.5f;
  Lines lines;
  setLines(eye.sight, {{middle.x + 1, middle.x, middle.x}, {middle.y, middle.y + 1, middle.y}}, lines);
  const auto crossed = [&](unsigned i) {
    return crossingPlane(triangle, {lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]},
                         {lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]}, at);
  };
  return {place == middle ? at : crossed(2), crossed(0), crossed(1)};
}

/// Whether the camera sees a surface where a ray through `place` meets it: as the survey and the surface pass draw it.
/// `away()`: the ray leads along the triangle's normal; `at()`: where it meets the triangle.
template <class Away, class At>
bool isSeen(const Eye& eye, const PlacedTriangle& hit, const glm::vec2& place, const Away& away, const At& at) {
  if (eye.visible[hit.instance] == 0) return false;
  const Material& material = eye.tree.material(hit.instance);
  if (!material.doubleSided && away() != (eye.tree.mirrored[hit.instance] != 0)) return false;
  if (!hasHoles(material)) return true;
  return isFilled(eye.tree, hit.instance, hit.triangle, seenPlace(eye, hit, place, at()));
}

void keepSeen(const RTCFilterFunctionNArguments* call) {
  const auto& query = *reinterpret_cast<const EyeQuery*>(call->context);
  filterCandidates(*call, [&](const Candidate& hit) {
    const auto& [origins, directions] = query.lines;
    const glm::dvec3 origin(origins[0][hit.lane], origins[1][hit.lane], origins[2][hit.lane]);
    const glm::dvec3 direction(directions[0][hit.lane], directions[1][hit.lane], directions[2][hit.lane]);
    const Triangle triangle = query.eye->tree.triangle(hit.instance, hit.triangle);
    return isSeen(
        *query.eye, {hit.instance, hit.triangle}, {query.places.x[hit.lane], query.places.y[hit.lane]},
        [&] { return glm::dot(triangle.area(), direction) > 0; },
        [&] {
          return crossing(triangle, origin, direction, {hit.u, hit.v});
        });
  });
}

/// Rays through up to kLanes places.
class Packet {
 public:
  Packet(const Eye& eye, std::span<const glm::vec2> places) : eye_(eye) {
    rtcInitIntersectContext(&query_.context);
    query_.context.flags = eye.tree.closeRays();
    query_.eye = &eye;
    setAllRays(packet_.ray);
    query_.places = {};
    for (unsigned i = 0; i < places.size(); ++i) {
      query_.places.x[i] = places[i].x;
      query_.places.y[i] = places[i].y;
    }
    setLines(eye.sight, query_.places, query_.lines);
    enter(eye.bounds, eye.input.camera.near, eye.input.camera.far, query_.lines, stretches_);
    for (unsigned i = 0; i < places.size(); ++i) {
      const auto& [origin, direction] = query_.lines;
      lanes_.active[i] = eye.bounds.empty() ? 0 : stretches_.meets[i];
      setRay(packet_.ray, i, glm::vec3(glm::dvec3(origin[0][i], origin[1][i], origin[2][i]) * eye.tree.scale),
             {direction[0][i], direction[1][i], direction[2][i]}, stretches_.length[i] * eye.tree.scale);
    }
  }

  /// Nearly all first meet what the camera sees; only those that do not are traced again with a filter.
  void trace(std::span<SurfacePoint> points) {
    std::fill(points.begin(), points.end(), SurfacePoint{});
    lanes_ = take(points);
    if (!lanes_.any()) return;
    for (unsigned i = 0; i < points.size(); ++i) {
      if (lanes_.active[i] != 0) packet_.ray.tfar[i] = static_cast<float>(stretches_.length[i] * eye_.tree.scale);
    }
    query_.context.filter = keepSeen;
    take(points);
  }

 private:
  bool hit(unsigned lane) const {
    return lanes_.active[lane] != 0 && packet_.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
  }

  /// Traces the active lanes and takes the points that the camera sees. Gives the lanes that met something else.
  Lanes take(std::span<SurfacePoint> points) {
    std::fill_n(packet_.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    intersect(eye_.tree, lanes_, query_.context, packet_);
    Lanes others;
    Crossings found{};
    for (unsigned i = 0; i < points.size(); ++i) {
      if (!hit(i)) continue;
      found.setTriangle(eye_.tree, i, on(i));
      found.u[i] = packet_.hit.u[i];
      found.v[i] = packet_.hit.v[i];
    }
    cross(query_.lines, eye_.tree.scale, found);
    for (unsigned i = 0; i < points.size(); ++i) {
      if (!hit(i)) continue;
      const auto away = [&] { return found.facing[i] > 0; };
      const auto at = [&] { return Barycentric{found.u[i], found.v[i]}; };
      if (isSeen(eye_, on(i), {query_.places.x[i], query_.places.y[i]}, away, at)) {
        points[i] = found.point(i, on(i));
      } else {
        others.active[i] = -1;
      }
    }
    return others;
  }

  PlacedTriangle on(unsigned lane) const { return metBy(packet_.hit, lane); }

  const Eye& eye_;
  EyeQuery query_;
  Stretches stretches_;
  Lanes lanes_;
  RTCRayHit16 packet_;
};

} // namespace

TracedCamera::TracedCamera(const TraceInput& input)
    : input_(input),
      view_(std::make_shared<const DrawnView>(drawnView(sightOf(input), input.traced.tree().scale))),
      visible_(instancesWhere(input, [](const NodeSwitches& node) { return node.visible; })) {}

void TracedCamera::firstHits(std::span<const glm::vec2> places, std::span<SurfacePoint> points) const {
  const Eye eye{input_, input_.traced.tree(), visible_};
  for (std::size_t first = 0; first < places.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, places.size() - first);
    Packet(eye, places.subspan(first, count)).trace(points.subspan(first, count));
  }
}

std::vector<SurfacePoint> firstHits(const TraceInput& input, std::span<const glm::vec2> places) {
  const TracedCamera camera(input);
  std::vector<SurfacePoint> points(places.size());
  forEachPiece(places.size(), kRaysAtOnce, [&](std::size_t first, std::size_t last) {
    camera.firstHits(places.subspan(first, last - first), std::span(points).subspan(first, last - first));
  });
  return points;
}

} // namespace gnomon
