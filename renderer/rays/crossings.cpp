#include "renderer/rays/crossings.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/instruction_sets.h"

namespace gnomon {
namespace {

inline double clamped(double value, double low, double high) {
  return value < low ? low : (high < value ? high : value);
}

/// Of two numbers; what is not a number is passed over.
inline double lesser(double a, double b) {
  const double known = b == b ? b : a;
  return a < known ? a : known;
}
inline double greater(double a, double b) {
  const double known = b == b ? b : a;
  return a > known ? a : known;
}

/// Shortens what lies `from` .. `to` of a line to what lies between two sides of a box.
inline void clip(double min, double max, double origin, double direction, double& from, double& to) {
  // Not a number where the origin lies in the very side that the line runs along.
  const double low = (min - origin) / direction;
  const double high = (max - origin) / direction;
  from = greater(from, lesser(low, high));
  to = lesser(to, greater(low, high));
}

} // namespace

Sight sightOf(const TraceInput& input) {
  const CameraView& view = input.camera;
  const glm::dvec2 none(0);
  return {view.eye - input.traced.tree().anchor,
          wayToMiddle(view),
          view.right,
          view.up,
          {input.width, input.height},
          view.perspective ? none : view.halfSize,
          view.perspective ? view.halfSize : none};
}

GNOMON_FOR_EACH_INSTRUCTION_SET void setLines(const Sight& sight, const Places& places, Lines& lines) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const double x = 2 * double{places.x[i]} / sight.size.x - 1;
    const double y = 1 - 2 * double{places.y[i]} / sight.size.y;
    const glm::dvec3 origin = sight.origin + (sight.right * (x * sight.spread.x) + sight.up * (y * sight.spread.y));
    const glm::dvec3 direction = sight.middle + sight.right * (x * sight.slope.x) + sight.up * (y * sight.slope.y);
    lines.origin[0][i] = origin.x;
    lines.origin[1][i] = origin.y;
    lines.origin[2][i] = origin.z;
    lines.direction[0][i] = direction.x;
    lines.direction[1][i] = direction.y;
    lines.direction[2][i] = direction.z;
  }
}

// What lies in a box of a line: Kay and Kajiya, "Ray Tracing Complex Scenes", 1986.
GNOMON_FOR_EACH_INSTRUCTION_SET void enter(const Aabb& box, double near, double far, Lines& lines,
                                           Stretches& stretches) {
  for (unsigned i = 0; i < kLanes; ++i) {
    double from = -HUGE_VAL;
    double to = HUGE_VAL;
    clip(box.min.x, box.max.x, lines.origin[0][i], lines.direction[0][i], from, to);
    clip(box.min.y, box.max.y, lines.origin[1][i], lines.direction[1][i], from, to);
    clip(box.min.z, box.max.z, lines.origin[2][i], lines.direction[2][i], from, to);
    from = from > near ? from : near;
    to = to < far ? to : far;
    stretches.meets[i] = from <= to ? -1 : 0;
    stretches.length[i] = far - from;
    lines.origin[0][i] += lines.direction[0][i] * from;
    lines.origin[1][i] += lines.direction[1][i] * from;
    lines.origin[2][i] += lines.direction[2][i] * from;
  }
}

// The operations of crossing() in the same order: so the same bits.
GNOMON_FOR_EACH_INSTRUCTION_SET void cross(const Lines& lines, double scale, Crossings& m) {
  const double metres = 1.0 / scale;
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::dvec3 origin(lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]);
    const glm::dvec3 direction(lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]);
    const glm::dvec3 a = glm::dvec3(m.a[0][i], m.a[1][i], m.a[2][i]) * metres;
    const glm::dvec3 b = glm::dvec3(m.b[0][i], m.b[1][i], m.b[2][i]) * metres;
    const glm::dvec3 c = glm::dvec3(m.c[0][i], m.c[1][i], m.c[2][i]) * metres;
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 from = origin - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const glm::dvec3 q = glm::cross(from, ab);
    const double determinant = glm::dot(ab, p);
    const double acrossB = glm::dot(from, p) / determinant;
    const double acrossC = glm::dot(direction, q) / determinant;
    const double u = determinant == 0 ? m.u[i] : clamped(acrossB, 0.0, 1.0);
    const double v = determinant == 0 ? m.v[i] : clamped(acrossC, 0.0, 1.0 - u);
    const glm::dvec3 area = glm::cross(ab, ac);
    const double facing = glm::dot(area, direction);
    const double length = std::sqrt(glm::dot(area, area));
    const double divisor = length > 0 ? length : 1.0;
    const double side = length > 0 ? (facing > 0 ? -1.0 : 1.0) : 0.0;
    const glm::dvec3 position = a + u * ab + v * ac;
    m.u[i] = u;
    m.v[i] = v;
    m.facing[i] = facing;
    m.position[0][i] = position.x;
    m.position[1][i] = position.y;
    m.position[2][i] = position.z;
    m.normal[0][i] = static_cast<float>(area.x * side / divisor);
    m.normal[1][i] = static_cast<float>(area.y * side / divisor);
    m.normal[2][i] = static_cast<float>(area.z * side / divisor);
  }
}

Crossings crossingsOf(const Sight& sight, const TracedScene::Tree& tree, const Places& places,
                      std::span<const PlacedTriangle> shown) {
  Crossings found{};
  for (unsigned i = 0; i < shown.size(); ++i) found.setTriangle(tree, i, shown[i]);
  std::fill_n(found.u, kLanes, 1.0 / 3.0);
  std::fill_n(found.v, kLanes, 1.0 / 3.0);
  Lines lines;
  setLines(sight, places, lines);
  cross(lines, tree.scale, found);
  return found;
}

} // namespace gnomon
