#include "renderer/rays/drawn_points.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/instruction_sets.h"
#include "renderer/rays/disc_place.h"

namespace gnomon {
namespace {

constexpr float kHalf = 0x1p-24f; ///< what rounding changes a float at most, relative to it

inline float sumOfSizes(const glm::vec3& v) {
  return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
}

inline float clamped(float value, float low, float high) {
  return value < low ? low : (high < value ? high : value);
}

inline void put(const glm::vec3& v, float (&to)[3][kLanes], unsigned i) {
  to[0][i] = v.x;
  to[1][i] = v.y;
  to[2][i] = v.z;
}

} // namespace

DrawnView drawnView(const Sight& sight, double scale) {
  const glm::dvec3 eye = sight.origin * scale;
  DrawnView view;
  view.eyeHigh = glm::vec3(eye);
  view.eyeLow = glm::vec3(eye - glm::dvec3(view.eyeHigh));
  view.middle = glm::vec3(sight.middle);
  view.right = glm::vec3(sight.right);
  view.up = glm::vec3(sight.up);
  view.size = glm::vec2(sight.size);
  view.spread = glm::vec2(sight.spread * scale);
  view.slope = glm::vec2(sight.slope);
  return view;
}

DrawnLight drawnLight(const LightSource& source, const glm::dvec3& eye, double scale) {
  DrawnLight light;
  light.directional = traitsOf(source.type).parallel;
  light.radius = static_cast<float>(light.directional ? source.radius : source.radius * scale);
  light.toward = glm::vec3(-source.axis);
  light.position = glm::vec3((source.position - eye) * scale);
  light.range = static_cast<float>(source.range * scale);
  light.axis = glm::vec3(source.axis);
  if (traitsOf(source.type).hasCone) light.cosOuter = static_cast<float>(source.cosOuter);
  return light;
}

namespace {

bool showsOne(const DrawnPlaces& places) {
  return std::all_of(std::begin(places.shown), std::end(places.shown), [&](const PlacedTriangle& other) {
    return other.instance == places.shown[0].instance && other.triangle == places.shown[0].triangle;
  });
}

} // namespace

void setTriangles(const TracedScene::Tree& tree, const DrawnPlaces& places, DrawnPoints& points) {
  if (showsOne(places)) {
    points.setTriangle(tree, 0, places.shown[0]);
    for (auto* corner : {&points.a, &points.b, &points.c}) {
      for (auto& axis : *corner) std::fill_n(axis, kLanes, axis[0]);
    }
    return;
  }
  for (unsigned i = 0; i < kLanes; ++i) points.setTriangle(tree, i, places.shown[i]);
}

// A point is where the line of sight crosses the plane (Moeller and Trumbore, 1997). Of a triangle that is small beside
// its distance, the weights of its corners keep the point in the true plane whatever its shape; of a large one, the
// line does, if the triangle is no sliver. Either way the point lies off the plane by a few roundings of the corner and
// of itself, as seen from the eye.
GNOMON_FOR_EACH_INSTRUCTION_SET void findPoints(DrawnView view, const DrawnPlaces& places, DrawnPoints& points) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const float x = 2 * places.x[i] / view.size.x - 1;
    const float y = 1 - 2 * places.y[i] / view.size.y;
    const glm::vec3 way = view.middle + (view.right * (x * view.slope.x) + view.up * (y * view.slope.y));
    const glm::vec3 origin = view.right * (x * view.spread.x) + view.up * (y * view.spread.y);
    const glm::vec3 a = laneOf(points.a, i);
    const glm::vec3 ab = laneOf(points.b, i) - a;
    const glm::vec3 ac = laneOf(points.c, i) - a;
    const glm::vec3 corner = (a - view.eyeHigh) - view.eyeLow;
    const glm::vec3 from = origin - corner;
    const glm::vec3 area = glm::cross(ab, ac);
    const float steepness = glm::dot(way, area);
    const float over = 1.0f / steepness;
    const float depth = -glm::dot(from, area) * over;
    const float acrossB = glm::dot(way, glm::cross(from, ac)) * over;
    const float acrossC = glm::dot(way, glm::cross(ab, from)) * over;
    const float u = clamped(acrossB, 0.0f, 1.0f);
    const float v = clamped(acrossC, 0.0f, 1.0f - u);
    const float squares = glm::dot(ab, ab) * glm::dot(ac, ac);
    const float squared = glm::dot(area, area);
    const int small = when(glm::dot(ab, ab) + glm::dot(ac, ac) <= glm::dot(corner, corner));
    const int within = when(u == acrossB) & when(v == acrossC);
    const glm::vec3 relative = select(small, corner + (ab * u + ac * v), origin + way * depth);
    const float size = std::sqrt(squared);
    const glm::vec3 normal = area * (select(when(steepness > 0), -1.0f, 1.0f) / size);
    const glm::vec3 position = (relative + view.eyeLow) + view.eyeHigh;
    const float unsure = 16 * kHalf * (sumOfSizes(corner) + sumOfSizes(relative));
    const float lost = 2 * kHalf * sumOfSizes(normal * position);
    const glm::vec2 sides = (view.slope * depth + view.spread) * 2.0f / view.size; // of the pixel, where the point lies
    const float thinnest = select(small, 1e-8f, 1.0f / 16);
    points.sure[i] = when(squared > 1e-30f) & when(squared > thinnest * squares) & (within | small) &
                     when(16 * unsure < sides.x) & when(16 * unsure < sides.y) &
                     when(steepness * steepness > 1e-6f * squared * glm::dot(way, way));
    points.turn[i] = 1e-6f + 8 * kHalf * std::sqrt(squares) / size;
    points.unsure[i] = unsure;
    points.u[i] = u;
    points.v[i] = v;
    put(position + normal * lost, points.start, i);
    put(relative, points.relative, i);
    put(normal, points.normal, i);
  }
}

namespace {

constexpr float kLeastCosine = 1e-4f; // as faces()

GNOMON_FOR_EACH_INSTRUCTION_SET void aimAtSun(DrawnLight light, DrawnPoints& points) {
  for (unsigned i = 0; i < kLanes; ++i) {
    const float cosine = glm::dot(laneOf(points.normal, i), light.toward);
    points.sure[i] &= when(std::fabs(cosine - kLeastCosine) > points.turn[i]);
    points.faces[i] = when(cosine > kLeastCosine);
    points.reached[i] = -1;
    points.length[i] = HUGE_VALF;
    put(light.toward, points.toward, i);
  }
}

GNOMON_FOR_EACH_INSTRUCTION_SET void aimAtLamp(DrawnLight light, DrawnPoints& points) {
  const float farthest = sumOfSizes(light.position);
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::vec3 relative = laneOf(points.relative, i);
    const glm::vec3 offset = light.position - relative;
    const float length = std::sqrt(glm::dot(offset, offset));
    const glm::vec3 toward = offset * (1.0f / length);
    const float cosine = glm::dot(laneOf(points.normal, i), toward);
    const float ofAxis = -glm::dot(light.axis, toward);
    points.sure[i] &= when(length > 0x1p-10f * (sumOfSizes(relative) + farthest)) &
                      when(std::fabs(cosine - kLeastCosine) > points.turn[i] + 0x1p-12f) &
                      (when(length < light.range * 0.9999f) | when(length > light.range * 1.0001f)) &
                      when(std::fabs(ofAxis - light.cosOuter) > 0x1p-12f);
    points.faces[i] = when(cosine > kLeastCosine);
    points.reached[i] = when(length < light.range) & when(ofAxis > light.cosOuter);
    points.length[i] = length;
    put(toward, points.toward, i);
  }
}

} // namespace

GNOMON_FOR_EACH_INSTRUCTION_SET void aimAside(const DrawnLight& to, const SquarePlaces& places, DrawnPoints& points) {
  const DrawnLight light = to;
  const int isLamp = when(!light.directional);
  const float infinite = light.directional ? HUGE_VALF : 0.0f;
  for (unsigned i = 0; i < kLanes; ++i) {
    const glm::vec3 middle = select(isLamp, light.position - laneOf(points.relative, i), light.toward);
    const glm::vec3 n = middle * (1.0f / std::sqrt(glm::dot(middle, middle)));
    // As discFacing.
    const float sign = select(when(n.z < 0), -1.0f, 1.0f);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    const glm::vec3 across(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const glm::vec3 up(b, sign + n.y * n.y * a, -n.y);
    const glm::vec2 place = discPlace(places.x[i], places.y[i]) * light.radius;
    const glm::vec3 offset = middle + across * place.x + up * place.y;
    const float length = std::sqrt(glm::dot(offset, offset));
    const glm::vec3 toward = offset * (1.0f / length);
    const float cosine = glm::dot(laneOf(points.normal, i), toward);
    points.sure[i] &= when(std::fabs(cosine) > points.turn[i] + 0x1p-12f);
    points.leaves[i] = when(cosine > 0);
    points.length[i] = length + infinite;
    put(toward, points.toward, i);
  }
}

void aim(const DrawnLight& light, DrawnPoints& points) {
  if (light.directional) {
    aimAtSun(light, points);
  } else {
    aimAtLamp(light, points);
  }
}

} // namespace gnomon
