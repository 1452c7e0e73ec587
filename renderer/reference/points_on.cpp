#include <algorithm>
#include <cmath>

#include "renderer/core/camera_view.h"
#include "renderer/core/instruction_sets.h"
#include "renderer/core/parallel.h"
#include "renderer/reference/ray_packet.h"
#include "renderer/reference/trace.h"
#include "renderer/reference/tree.h"

namespace gnomon {
namespace {

constexpr std::size_t kPointsAtOnce = 4096; ///< found by one core at a time

/// The camera as sightLine takes it: the line through a place of the picture begins at origin + ndc * spread and leads
/// along forward + ndc * slope.
struct Sight {
  glm::dvec3 origin{0}; ///< relative to the anchor
  glm::dvec3 forward{0}, right{0}, up{0};
  glm::dvec2 size{1}; ///< of the picture, pixels
  glm::dvec2 spread{0}, slope{0};
  double metres = 1; ///< a unit of the corners
};

Sight sightOf(const TraceInput& input) {
  const CameraView& view = input.camera;
  const TracedScene::Tree& tree = input.traced.tree();
  const glm::dvec2 none(0);
  return {view.eye - tree.anchor,
          view.forward,
          view.right,
          view.up,
          {input.width, input.height},
          view.perspective ? none : view.halfSize,
          view.perspective ? view.halfSize : none,
          1.0 / tree.scale};
}

/// What kLanes lines meet, a coordinate after the other: loops over the lanes become vectors.
struct Meetings {
  float placeX[kLanes], placeY[kLanes];           ///< from the upper left corner, pixels
  float a[3][kLanes], b[3][kLanes], c[3][kLanes]; ///< corners, in the tree's units
  double position[3][kLanes];                     ///< found
  float normal[3][kLanes];                        ///< found
};

double clamped(double value, double low, double high) {
  return value < low ? low : (high < value ? high : value);
}

/// surfacePoint at crossing() of each lane's line and triangle: the same operations in the same order, so the same
/// bits.
GNOMON_FOR_EACH_INSTRUCTION_SET void meetAll(const Sight& sight, Meetings& m) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double x = 2 * double{m.placeX[i]} / sight.size.x - 1;
    const double y = 1 - 2 * double{m.placeY[i]} / sight.size.y;
    const glm::dvec3 origin = sight.origin + (sight.right * (x * sight.spread.x) + sight.up * (y * sight.spread.y));
    const glm::dvec3 direction = sight.forward + sight.right * (x * sight.slope.x) + sight.up * (y * sight.slope.y);
    const glm::dvec3 a = glm::dvec3(m.a[0][i], m.a[1][i], m.a[2][i]) * sight.metres;
    const glm::dvec3 b = glm::dvec3(m.b[0][i], m.b[1][i], m.b[2][i]) * sight.metres;
    const glm::dvec3 c = glm::dvec3(m.c[0][i], m.c[1][i], m.c[2][i]) * sight.metres;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 from = origin - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const glm::dvec3 q = glm::cross(from, ab);
    const double determinant = glm::dot(ab, p);
    const double acrossB = glm::dot(from, p) / determinant;
    const double acrossC = glm::dot(direction, q) / determinant;
    const double u = determinant == 0 ? 1.0 / 3.0 : clamped(acrossB, 0.0, 1.0);
    const double v = determinant == 0 ? 1.0 / 3.0 : clamped(acrossC, 0.0, 1.0 - u);
    const glm::dvec3 area = glm::cross(ab, ac);
    const double side = glm::dot(area, direction) > 0 ? -1.0 : 1.0;
    const double length = std::sqrt(glm::dot(area, area));
    const double divisor = length > 0 ? length : 1.0;
    const double share = length > 0 ? side : 0.0;
    const glm::dvec3 position = a + u * ab + v * ac;
    m.position[0][i] = position.x;
    m.position[1][i] = position.y;
    m.position[2][i] = position.z;
    m.normal[0][i] = static_cast<float>(area.x * share / divisor);
    m.normal[1][i] = static_cast<float>(area.y * share / divisor);
    m.normal[2][i] = static_cast<float>(area.z * share / divisor);
  }
}

void setCorner(const glm::vec3& corner, float (&to)[3][kLanes], unsigned lane) {
  to[0][lane] = corner.x;
  to[1][lane] = corner.y;
  to[2][lane] = corner.z;
}

/// Sets a lane's triangle; where there is none, one without area.
void setTriangle(const TracedScene::Tree& tree, const PlacedTriangle& of, unsigned lane, Meetings& m) {
  if (of.instance == kNoSurface) {
    for (auto* corner : {&m.a, &m.b, &m.c}) setCorner(glm::vec3(0), *corner, lane);
    return;
  }
  const std::uint32_t* corner = tree.corners(of.instance, of.triangle);
  const glm::vec3* placed = &tree.positions[tree.firstPosition[of.instance]];
  setCorner(placed[corner[0]], m.a, lane);
  setCorner(placed[corner[1]], m.b, lane);
  setCorner(placed[corner[2]], m.c, lane);
}

void find(const TracedScene::Tree& tree, const Sight& sight, std::span<const glm::vec2> places,
          std::span<const PlacedTriangle> triangles, Meetings& m, std::span<SurfacePoint> points) {
  for (unsigned i = 0; i < places.size(); ++i) {
    m.placeX[i] = places[i].x;
    m.placeY[i] = places[i].y;
    setTriangle(tree, triangles[i], i, m);
  }
  meetAll(sight, m);
  for (unsigned i = 0; i < places.size(); ++i) {
    const PlacedTriangle& on = triangles[i];
    points[i] = on.instance == kNoSurface ? SurfacePoint{}
                                          : SurfacePoint{{m.position[0][i], m.position[1][i], m.position[2][i]},
                                                         {m.normal[0][i], m.normal[1][i], m.normal[2][i]},
                                                         on.instance,
                                                         on.triangle};
  }
}

} // namespace

void pointsOn(const TraceInput& input, std::span<const glm::vec2> places, std::span<const PlacedTriangle> triangles,
              std::span<SurfacePoint> points) {
  const TracedScene::Tree& tree = input.traced.tree();
  const Sight sight = sightOf(input);
  Meetings meetings{};
  for (std::size_t first = 0; first < places.size(); first += kLanes) {
    const std::size_t count = std::min<std::size_t>(kLanes, places.size() - first);
    find(tree, sight, places.subspan(first, count), triangles.subspan(first, count), meetings,
         points.subspan(first, count));
  }
}

std::vector<SurfacePoint> pointsOn(const TraceInput& input, std::span<const glm::vec2> places,
                                   std::span<const PlacedTriangle> triangles) {
  std::vector<SurfacePoint> points(places.size());
  forEachPiece(places.size(), kPointsAtOnce, [&](std::size_t first, std::size_t last) {
    const std::size_t count = last - first;
    pointsOn(input, places.subspan(first, count), triangles.subspan(first, count),
             std::span(points).subspan(first, count));
  });
  return points;
}

} // namespace gnomon
