#include <algorithm>
#include <cmath>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/core/parallel.h"
#include "renderer/reference/alpha.h"
#include "renderer/reference/frame_nodes.h"
#include "renderer/reference/ray_packet.h"
#include "renderer/reference/trace.h"
#include "renderer/reference/tree.h"
#include "renderer/reference/triangle.h"

namespace gnomon {
namespace {

/// The line through a place of the picture; metres, relative to the scene's anchor.
struct SightLine {
  glm::dvec3 origin{0};    ///< at the eye; orthographic: beside it
  glm::dvec3 direction{0}; ///< a step of one metre of view depth
};

/// A stretch of the line through a place of the picture; metres, relative to the scene's anchor.
struct CameraRay {
  glm::dvec3 origin{0};    ///< where it begins
  glm::dvec3 direction{0}; ///< a step of one metre of view depth
  double length = 0;       ///< view depth from there to the far end; infinite where nothing ends it
  bool meets = false;      ///< false: it passes the scene by
};

struct Stretch {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
};

/// std::fmin and std::fmax, without the call.
double lesser(double a, double b) {
  return a < b || b != b ? a : b;
}
double greater(double a, double b) {
  return a > b || b != b ? a : b;
}

/// What lies in the box of a line (Kay and Kajiya, "Ray Tracing Complex Scenes", 1986).
Stretch stretchIn(const Aabb& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  Stretch inside;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = (box.min[axis] - origin[axis]) / direction[axis];
    const double high = (box.max[axis] - origin[axis]) / direction[axis];
    // What is not a number is passed over: an origin in the very side that the line runs along.
    inside.from = greater(inside.from, lesser(low, high));
    inside.to = lesser(inside.to, greater(low, high));
  }
  return inside;
}

Aabb grown(const Aabb& box) {
  const glm::dvec3 half = box.halfExtent();
  const double margin = std::max({half.x, half.y, half.z}) / 64;
  return {box.min - margin, box.max + margin};
}

/// `place`: pixels from the upper left corner.
SightLine sightLine(const CameraView& view, const glm::dvec3& anchor, glm::dvec2 size, glm::dvec2 place) {
  const glm::dvec2 ndc(2 * place.x / size.x - 1, 1 - 2 * place.y / size.y);
  return {view.eye - anchor + pointAt(view, ndc, 0), view.perspective ? pointAt(view, ndc, 1) : view.forward};
}

/// The ray through `place` (pixels from the upper left corner) between the near and the far plane, as pointAt places
/// it. Where it starts far from `bounds`, around which it looks for something, it begins close to them instead: so the
/// distance of the eye takes nothing from its precision.
CameraRay cameraRay(const CameraView& view, const glm::dvec3& anchor, const Aabb& bounds, glm::dvec2 size,
                    glm::dvec2 place) {
  CameraRay ray;
  if (bounds.empty()) return ray;
  const SightLine line = sightLine(view, anchor, size, place);
  ray.direction = line.direction;
  const Stretch inside = stretchIn(grown(bounds), line.origin, line.direction);
  const double from = std::max(view.near, inside.from);
  ray.meets = from <= std::min(view.far, inside.to);
  if (!ray.meets) return ray;
  ray.origin = line.origin + line.direction * from;
  ray.length = view.far - from;
  return ray;
}

/// Where a camera ray of this direction crosses a triangle. `at`: as crossing() gives it.
SurfacePoint surfacePoint(const glm::dvec3& direction, const PlacedTriangle& on, const Triangle& triangle,
                          const glm::dvec3& area, const Barycentric& at) {
  const bool away = glm::dot(area, direction) > 0;
  return {at.mix(triangle.a, triangle.b, triangle.c), glm::vec3(unitAlong(away ? -area : area)), on.instance,
          on.triangle};
}

constexpr std::size_t kRaysAtOnce = 512; ///< traced by one core at a time

struct Eye {
  const TraceInput& input;
  const TracedScene::Tree& tree;
  std::span<const std::uint8_t> visible; ///< one an instance
};

/// Embree's context, and what its filter needs of the rays.
struct EyeQuery {
  RTCIntersectContext context;
  const Eye* eye = nullptr;
  std::array<CameraRay, kLanes> rays{};
};

/// The surface at a candidate, if the camera sees it: as the survey and the surface pass draw it.
std::optional<SurfacePoint> seen(const Eye& eye, const CameraRay& ray, const Candidate& hit) {
  if (eye.visible[hit.instance] == 0) return std::nullopt;
  const Triangle triangle = eye.tree.triangle(hit.instance, hit.triangle);
  const glm::dvec3 area = triangle.area();
  const bool away = glm::dot(area, ray.direction) > 0;
  const Material& material = eye.tree.material(hit.instance);
  if (!material.doubleSided && away != (eye.tree.mirrored[hit.instance] != 0)) return std::nullopt;
  const Barycentric at = crossing(triangle, ray.origin, ray.direction, {hit.u, hit.v});
  if (material.alphaMode != AlphaMode::opaque &&
      !(alphaAt(eye.tree, hit.instance, hit.triangle, at) >= material.alphaCutoff)) {
    return std::nullopt;
  }
  return surfacePoint(ray.direction, {hit.instance, hit.triangle}, triangle, area, at);
}

void keepSeen(const RTCFilterFunctionNArguments* call) {
  const auto& query = *reinterpret_cast<const EyeQuery*>(call->context);
  filterCandidates(*call,
                   [&](const Candidate& hit) { return seen(*query.eye, query.rays[hit.lane], hit).has_value(); });
}

Candidate candidateOf(const RTCRayHit16& packet, unsigned lane) {
  return {lane, packet.hit.geomID[lane], packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane]};
}

/// Rays through up to kLanes places. Nearly all first meet what the camera sees; only those that do not are traced
/// again with a filter.
void trace(const Eye& eye, std::span<const glm::vec2> places, std::span<SurfacePoint> points) {
  EyeQuery query;
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  query.eye = &eye;
  RTCRayHit16 packet;
  Lanes lanes;
  const glm::dvec2 size(eye.input.width, eye.input.height);
  for (unsigned i = 0; i < places.size(); ++i) {
    query.rays[i] = cameraRay(eye.input.camera, eye.tree.anchor, eye.tree.bounds, size, glm::dvec2(places[i]));
    const CameraRay& ray = query.rays[i];
    lanes.active[i] = ray.meets ? -1 : 0;
    setRay(packet.ray, i, glm::vec3(ray.origin * eye.tree.scale), ray.direction, ray.length * eye.tree.scale);
  }
  const auto intersect = [&] {
    std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(lanes.active.data(), eye.tree.rays.get(), &query.context, &packet);
  };
  intersect();
  Lanes again;
  for (unsigned i = 0; i < places.size(); ++i) {
    points[i] = {};
    if (lanes.active[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    if (const auto point = seen(eye, query.rays[i], candidateOf(packet, i))) {
      points[i] = *point;
    } else {
      again.active[i] = -1;
      packet.ray.tfar[i] = static_cast<float>(query.rays[i].length * eye.tree.scale);
    }
  }
  if (!again.any()) return;
  lanes = again;
  query.context.filter = keepSeen;
  intersect();
  for (unsigned i = 0; i < places.size(); ++i) {
    if (lanes.active[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    points[i] = seen(eye, query.rays[i], candidateOf(packet, i)).value_or(SurfacePoint{});
  }
}

} // namespace

TracedCamera::TracedCamera(const TraceInput& input)
    : input_(input), visible_(instancesWhere(input, [](const NodeSwitches& node) { return node.visible; })) {}

void TracedCamera::firstHits(std::span<const glm::vec2> places, std::span<SurfacePoint> points) const {
  const Eye eye{input_, input_.traced.tree(), visible_};
  for (std::size_t first = 0; first < places.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, places.size() - first);
    trace(eye, places.subspan(first, count), points.subspan(first, count));
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
