#include "renderer/core/parallel.h"
#include "renderer/reference/alpha.h"
#include "renderer/reference/camera_rays.h"
#include "renderer/reference/frame_nodes.h"
#include "renderer/reference/ray_packet.h"
#include "renderer/reference/surface_point.h"
#include "renderer/reference/trace.h"
#include "renderer/reference/tree.h"

namespace gnomon {
namespace {

constexpr std::size_t kRaysAtOnce = 512; ///< traced by one core at a time

struct Eye {
  const TraceInput& input;
  const TracedScene::Tree& tree;
  std::vector<std::uint8_t> visible; ///< one an instance
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
  return surfacePoint(ray.direction, {hit.instance, hit.triangle}, triangle, at);
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
    setRay(packet.ray, i, ray.origin * eye.tree.scale, ray.direction, ray.length * eye.tree.scale);
  }
  const auto intersect = [&] {
    std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(lanes.active.data(), eye.tree.rays.get(), &query.context, &packet);
  };
  intersect();
  Lanes again;
  for (unsigned i = 0; i < places.size(); ++i) {
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

std::vector<SurfacePoint> firstHits(const TraceInput& input, std::span<const glm::vec2> places) {
  const Eye eye{input, input.traced.tree(),
                instancesWhere(input, [](const NodeSwitches& node) { return node.visible; })};
  std::vector<SurfacePoint> points(places.size());
  forEachPiece(places.size(), kRaysAtOnce, [&](std::size_t first, std::size_t last) {
    for (; first < last; first += kLanes) {
      const std::size_t count = std::min<std::size_t>(kLanes, last - first);
      trace(eye, places.subspan(first, count), std::span(points).subspan(first, count));
    }
  });
  return points;
}

} // namespace gnomon
