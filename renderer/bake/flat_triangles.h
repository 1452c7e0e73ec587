#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace gnomon {

/// A triangle in the plane of a map. Either way round.
using FlatTriangle = std::array<glm::dvec2, 3>;

/// Twice the area; less than 0 where the corners go round with the clock.
inline double signedArea(const FlatTriangle& t) {
  const glm::dvec2 ab = t[1] - t[0];
  const glm::dvec2 ac = t[2] - t[0];
  return ab.x * ac.y - ab.y * ac.x;
}

/// Whether the insides of two of them meet by more than `slack`, in their unit. Sides and corners may touch; what has
/// no area overlaps nothing.
bool overlap(const FlatTriangle& a, const FlatTriangle& b, double slack);

/// Whether any two of them do. Memory grows as their number n, time about as n log n, for fans and slanted strips of
/// long triangles too; where many lie across each other's way without an overlap it may come near n squared. Listens to
/// what the thread's task does (core/stop.h).
bool anyOverlap(std::span<const FlatTriangle> triangles, double slack);

} // namespace gnomon
