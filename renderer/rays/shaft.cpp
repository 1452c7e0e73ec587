#include "renderer/rays/shaft.h"

#include <algorithm>

namespace gnomon {
namespace {

/// How far a shaft's planes are moved outwards. In the units of the tree, whose coordinates are below 2: ten times what
/// floats lose of a sum of their products.
constexpr double kMargin = 0x1p-18;

/// Where the light's middle lies from a point: a direction of unit length for directional lights, else metres. The
/// light's radius is of the same measure.
glm::dvec3 towards(const LightSource& light, const glm::dvec3& from) {
  return traitsOf(light.type).parallel ? -light.axis : light.position - from;
}

/// A plane that a light touches from inside.
struct LightPlane {
  glm::dvec3 normal{0}; ///< unit length, inwards
  glm::dvec3 on{0};

  double height(const glm::dvec3& point) const { return glm::dot(normal, point - on); }
  bool holds(std::span<const glm::dvec3> points, double rounding) const {
    return std::all_of(points.begin(), points.end(), [&](const glm::dvec3& p) { return height(p) >= -rounding; });
  }
};

constexpr glm::vec4 kBoundsNothing{0, 0, 0, 1};

/// As Shaft::planes have it.
glm::vec4 rounded(const LightPlane& plane, double scale) {
  return {glm::vec3(plane.normal), static_cast<float>(kMargin - glm::dot(plane.normal, plane.on * scale))};
}

/// The plane through a line, of unit length, that has the whole light on the side that `inwards` points to.
std::optional<LightPlane> planeThrough(const LightSource& light, const glm::dvec3& from, const glm::dvec3& along,
                                       const glm::dvec3& inwards) {
  if (along == glm::dvec3(0)) return std::nullopt;
  const glm::dvec3 toLight = towards(light, from);
  const glm::dvec3 across = toLight - along * glm::dot(toLight, along);
  const double distance = glm::length(across);
  if (!(distance > light.radius) || !(distance > 1e-6 * glm::length(toLight))) return std::nullopt;
  const glm::dvec3 away = across / distance;
  glm::dvec3 normal = glm::cross(along, away);
  if (glm::dot(normal, inwards) < 0) normal = -normal;
  // Turned about the line until it touches the light from outside.
  const double sine = light.radius / distance;
  return LightPlane{normal * std::sqrt(1 - sine * sine) + away * sine, from};
}

const glm::dvec3& lowest(const glm::dvec3& up, std::span<const glm::dvec3> points) {
  return *std::min_element(points.begin(), points.end(),
                           [&](const glm::dvec3& a, const glm::dvec3& b) { return glm::dot(up, a) < glm::dot(up, b); });
}

/// The plane in direction `along` that the points touch from inside, too.
std::optional<LightPlane> planeAround(const LightSource& light, std::span<const glm::dvec3> points,
                                      const glm::dvec3& along, const glm::dvec3& inwards, double rounding) {
  constexpr int kTurns = 4;
  glm::dvec3 on = lowest(inwards, points);
  for (int turn = 0; turn < kTurns; ++turn) {
    const auto plane = planeThrough(light, on, along, inwards);
    if (!plane || plane->holds(points, rounding)) return plane;
    on = lowest(plane->normal, points);
  }
  return std::nullopt;
}

/// Where the light ends, as seen from the `middle` of what lies before it.
glm::vec4 endPlane(const LightSource& light, std::span<const glm::dvec3> points, const glm::dvec3& middle,
                   double scale) {
  const glm::dvec3 toLight = towards(light, middle);
  const double distance = glm::length(toLight);
  const LightPlane end{-toLight / distance, middle + toLight * (1 + light.radius / distance)};
  if (traitsOf(light.type).parallel || !(glm::length(end.on * scale) < 4)) return kBoundsNothing;
  return end.holds(points, kMargin / scale / 2) ? rounded(end, scale) : kBoundsNothing;
}

} // namespace

Turn turnOf(const LightSource& light, const FlatBlock& block) {
  constexpr double kUnsure = 1e-5; // about the least cosine of faces()
  bool towards = true;
  bool away = true;
  for (const glm::dvec3& corner : block.corners) {
    const double cosine = glm::dot(block.normal, wayTo(light, corner).direction);
    towards = towards && cosine > 1e-4 + kUnsure;
    away = away && cosine < -kUnsure;
  }
  if (towards) return Turn::towards;
  return away ? Turn::away : Turn::unsure;
}

bool isOver(const LightSource& light, const FlatBlock& block) {
  const glm::dvec3 toLight = towards(light, block.corners[0]);
  return glm::dot(block.normal, toLight) > light.radius + 1e-6 * glm::length(toLight);
}

std::optional<Shaft> shaftTo(const LightSource& light, const FlatBlock& block, double scale) {
  if (!isOver(light, block)) return std::nullopt;
  const glm::dvec3 middle = (block.corners[0] + block.corners[1] + block.corners[2] + block.corners[3]) / 4.0;
  const double rounding = kMargin / scale / 2;
  Shaft shaft;
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec3& from = block.corners[i];
    const glm::dvec3 side = block.corners[(i + 1) % 4] - from;
    shaft.planes[i] = kBoundsNothing;
    if (side == glm::dvec3(0)) continue;
    const auto plane = planeThrough(light, from, unitAlong(side), middle - from);
    // Of a block that lies askew to the light, a far part may lie outside of a plane that is turned to it.
    if (!plane || !plane->holds(block.corners, rounding)) return std::nullopt;
    shaft.planes[i] = rounded(*plane, scale);
  }
  shaft.planes[4] = rounded({block.normal, middle}, scale);
  shaft.planes[5] = endPlane(light, block.corners, middle, scale);
  return shaft;
}

std::optional<Shaft> shaftTo(const LightSource& light, std::span<const glm::dvec3> points, double scale) {
  glm::dvec3 low = points[0], high = points[0];
  for (const glm::dvec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  const glm::dvec3 middle = 0.5 * low + 0.5 * high;
  const glm::dvec3 ahead = unitAlong(towards(light, middle));
  const glm::dvec3 aside = std::abs(ahead.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = unitAlong(glm::cross(ahead, aside));
  const glm::dvec3 up = glm::cross(ahead, right);
  const glm::dvec3& nearest = lowest(-ahead, points);
  if (!(glm::dot(ahead, towards(light, nearest)) > light.radius)) return std::nullopt;
  Shaft shaft;
  const std::array<glm::dvec3, 4> inwards{right, -right, up, -up};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto plane = planeAround(light, points, i < 2 ? up : right, inwards[i], kMargin / scale / 2);
    if (!plane) return std::nullopt;
    shaft.planes[i] = rounded(*plane, scale);
  }
  shaft.planes[4] = rounded({ahead, lowest(ahead, points)}, scale);
  shaft.planes[5] = endPlane(light, points, middle, scale);
  return shaft;
}

bool passesBy(const LightSource& light, const FlatBlock& block, const Triangle& triangle) {
  const glm::dvec3 toLight = towards(light, triangle.a);
  glm::dvec3 normal = unitAlong(triangle.area());
  if (glm::dot(normal, toLight) < 0) normal = -normal;
  if (!(glm::dot(normal, toLight) > light.radius + 1e-9 * glm::length(toLight))) return false;
  const glm::dvec3 largest = triangle.largest();
  return std::all_of(block.corners.begin(), block.corners.end(), [&](const glm::dvec3& corner) {
    return glm::dot(normal, corner - triangle.a) >= -samePlane(normal, glm::max(largest, glm::abs(corner))) / 2;
  });
}

bool passesBeside(const LightSource& light, const FlatBlock& block, const Triangle& triangle, double scale) {
  const std::array<glm::dvec3, 3> corners{triangle.a, triangle.b, triangle.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& from = corners[i];
    const glm::dvec3& across = corners[(i + 2) % 3];
    const auto plane = planeThrough(light, from, unitAlong(corners[(i + 1) % 3] - from), from - across);
    if (plane && plane->height(across) <= 0 && plane->holds(block.corners, -kMargin / scale)) return true;
  }
  return false;
}

} // namespace gnomon
