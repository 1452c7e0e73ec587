#include "renderer/cpu/raster/raster_wide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

namespace gnomon::cpu {
namespace {

/// A corner in clip space. `own`: which of the triangle's corners it is, -1 = clipping made it.
struct ClipCorner {
  glm::dvec4 clip{0, 0, 0, 1};
  int own = -1;
};

/// Each of six planes adds a corner at most.
struct ClipPolygon {
  std::array<ClipCorner, 9> corners;
  std::size_t count = 0;
};

/// Inside where dot(plane, clip) >= 0. An edge is cut from its inner end, so that both triangles that share it agree.
ClipPolygon cut(const ClipPolygon& polygon, const glm::dvec4& plane) {
  ClipPolygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner& from = polygon.corners[i];
    const ClipCorner& to = polygon.corners[(i + 1) % polygon.count];
    const double fromSide = glm::dot(plane, from.clip);
    const double toSide = glm::dot(plane, to.clip);
    if (fromSide >= 0) kept.corners[kept.count++] = from;
    if ((fromSide >= 0) == (toSide >= 0)) continue;
    const bool outwards = fromSide >= 0;
    const glm::dvec4& inner = outwards ? from.clip : to.clip;
    const glm::dvec4& outer = outwards ? to.clip : from.clip;
    const double innerSide = outwards ? fromSide : toSide;
    const double outerSide = outwards ? toSide : fromSide;
    kept.corners[kept.count++] = {inner + (outer - inner) * (innerSide / (innerSide - outerSide)), -1};
  }
  return kept;
}

/// What of a triangle lies within |x| <= guard.x w and |y| <= guard.y w, and, where `depth` says so, 0 <= z <= w. The
/// same edge is cut at the same place whichever triangle it belongs to. (Sutherland and Hodgman, "Reentrant Polygon
/// Clipping", 1974.)
ClipPolygon clipped(const std::array<glm::dvec4, 3>& triangle, const glm::dvec2& guard, bool depth) {
  const std::array planes{glm::dvec4(0, 0, -1, 1),       glm::dvec4(0, 0, 1, 0),       glm::dvec4(1, 0, 0, guard.x),
                          glm::dvec4(-1, 0, 0, guard.x), glm::dvec4(0, 1, 0, guard.y), glm::dvec4(0, -1, 0, guard.y)};
  ClipPolygon polygon;
  for (int i = 0; i < 3; ++i) polygon.corners[polygon.count++] = {triangle[static_cast<std::size_t>(i)], i};
  for (const glm::dvec4& plane : std::span(planes).subspan(depth ? 0 : 2)) {
    polygon = cut(polygon, plane);
    if (polygon.count < 3) return {};
  }
  return polygon;
}

glm::ivec2 snapped(const glm::dvec2& at) {
  return {static_cast<int>(std::nearbyint(at.x)), static_cast<int>(std::nearbyint(at.y))};
}

std::int64_t areaOf(const std::array<glm::ivec2, 3>& corners) {
  const glm::i64vec2 p(corners[0]), q(corners[1]), r(corners[2]);
  return (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
}

/// False only where the triangle surely has no sample in a square whose corners, in 1/256 of a pixel, are these.
bool mayTouch(const WideTriangle& triangle, const glm::i64vec2& least, const glm::i64vec2& most) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::i64vec2 from(triangle.corners[i]);
    const glm::i64vec2 to(triangle.corners[(i + 1) % 3]);
    const std::int64_t a = from.y - to.y;
    const std::int64_t b = to.x - from.x;
    if (a * ((a > 0 ? most.x : least.x) - from.x) + b * ((b > 0 ? most.y : least.y) - from.y) < 0) return false;
  }
  return true;
}

/// Adds the squares that the triangle, the `index`th, may touch; false where it touches none.
bool addTouches(const RasterView& view, WideTriangle& triangle, std::uint32_t index, TriangleGroup& group) {
  const auto& c = triangle.corners;
  const PixelBox pixels =
      pixelsWithin(view, glm::min(glm::min(c[0], c[1]), c[2]), glm::max(glm::max(c[0], c[1]), c[2]));
  if (pixels.empty()) return false;
  triangle.blocks = {pixels.x0 / kBlockSide, pixels.y0 / kBlockSide, pixels.x1 / kBlockSide, pixels.y1 / kBlockSide};
  const std::size_t before = group.touches.size();
  constexpr std::int64_t kSide = std::int64_t{kSquareSide} * kSubpixels;
  for (int y = pixels.y0 / kSquareSide; y <= pixels.y1 / kSquareSide; ++y) {
    for (int x = pixels.x0 / kSquareSide; x <= pixels.x1 / kSquareSide; ++x) {
      const glm::i64vec2 least(x * kSide, y * kSide);
      if (!isWanted(view, pixels, x, y) || !mayTouch(triangle, least, least + kSide)) continue;
      group.touches.add({static_cast<std::uint32_t>(y * view.squaresAcross + x), kWideEntry | index});
    }
  }
  return group.touches.size() != before;
}

/// Through three corners.
DepthPlane planeThrough(const std::array<glm::ivec2, 3>& at, const std::array<double, 3>& z) {
  const double scale = kSubpixels / static_cast<double>(areaOf(at));
  const glm::dvec2 q(at[1] - at[0]), r(at[2] - at[0]);
  DepthPlane plane;
  plane.dx = ((z[1] - z[0]) * r.y - (z[2] - z[0]) * q.y) * scale;
  plane.dy = ((z[2] - z[0]) * q.x - (z[1] - z[0]) * r.x) * scale;
  plane.first = z[0] - (plane.dx * at[0].x + plane.dy * at[0].y) / kSubpixels;
  return plane;
}

/// False where snapping made most of the area.
bool isAsLarge(const std::array<glm::dvec2, 3>& at, const std::array<glm::ivec2, 3>& snappedAt) {
  const glm::dvec2 q = at[1] - at[0], r = at[2] - at[0];
  const double share = (q.x * r.y - r.x * q.y) / static_cast<double>(areaOf(snappedAt));
  return share > 0.5 && share < 2;
}

/// Through the corners where they are, not where they are snapped to, as drivers of OpenGL do; behind the eye, too: z /
/// w is linear on the picture. Nothing where the triangle is seen edge-on.
std::optional<DepthPlane> planeOf(const RasterView& view, const std::array<WideCorner, 3>& corners) {
  const auto column = [&](int i) { return glm::dvec3(corners[0].clip[i], corners[1].clip[i], corners[2].clip[i]); };
  const auto det = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return glm::dot(a, glm::cross(b, c));
  };
  const glm::dvec3 x = column(0), y = column(1), z = column(2), w = column(3);
  const double all = det(x, y, w);
  const glm::dvec3 factors = glm::dvec3(det(z, y, w), det(x, z, w), det(x, y, z)) / all;
  if (!std::isfinite(factors.x + factors.y + factors.z)) return std::nullopt;
  const glm::dvec2 steps = glm::dvec2(factors) * 2.0 / glm::dvec2(view.width, view.height);
  return DepthPlane{factors.z - factors.x - factors.y, steps.x, steps.y};
}

/// `plane`: what it is part of lies on; where there is none, or its shape is not its own, its snapped corners say.
void addMeasured(const WideDraw& draw, const std::array<WideCorner, 3>& corners, std::uint32_t number,
                 const std::optional<DepthPlane>& plane, TriangleGroup& group) {
  WideTriangle triangle;
  std::array<glm::dvec2, 3> at;
  std::array<double, 3> z;
  for (std::size_t i = 0; i < 3; ++i) {
    at[i] = corners[i].at;
    z[i] = corners[i].z;
    triangle.corners[i] = snapped(at[i]);
  }
  const std::int64_t area = areaOf(triangle.corners);
  if (area == 0 || (draw.facing != Facing::both && (area > 0) != (draw.facing == Facing::counterClockwise))) return;
  triangle.plane = plane && isAsLarge(at, triangle.corners) ? *plane : planeThrough(triangle.corners, z);
  const auto [least, most] = std::minmax({z[0], z[1], z[2]});
  const auto inRange = [&](double depth) {
    const auto own = static_cast<float>(depth);
    return draw.view.range == DepthRange::clamped ? std::clamp(own, 0.0f, 1.0f) : own;
  };
  triangle.least = inRange(least);
  triangle.most = inRange(most);
  triangle.number = number;
  triangle.holed = draw.holed;
  triangle.turned = area < 0;
  if (triangle.turned) std::swap(triangle.corners[1], triangle.corners[2]);
  if (addTouches(draw.view, triangle, static_cast<std::uint32_t>(group.wide.size()), group)) {
    group.wide.push_back(triangle);
  }
}

} // namespace

void addWide(const WideDraw& draw, const std::array<WideCorner, 3>& corners, std::uint32_t number,
             TriangleGroup& group) {
  const std::optional<DepthPlane> plane = planeOf(draw.view, corners);
  if (corners[0].placed && corners[1].placed && corners[2].placed) {
    addMeasured(draw, corners, number, plane, group);
    return;
  }
  constexpr double kLeastDivisor = 1e-300; // the guard leaves x = y = 0 of what has none
  const ClipPolygon polygon = clipped({corners[0].clip, corners[1].clip, corners[2].clip}, draw.view.guard(),
                                      draw.view.range == DepthRange::reversed);
  std::array<WideCorner, 9> placed;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipCorner& corner = polygon.corners[i];
    // A corner that the triangle shares with others has the place that they have.
    if (corner.own >= 0 && corners[static_cast<std::size_t>(corner.own)].placed) {
      placed[i] = corners[static_cast<std::size_t>(corner.own)];
      continue;
    }
    const double w = std::max(corner.clip.w, kLeastDivisor);
    placed[i].at = glm::dvec2(corner.clip) / w * draw.view.middle() + draw.view.middle();
    placed[i].z = corner.clip.z / w;
  }
  for (std::size_t i = 2; i < polygon.count; ++i) {
    addMeasured(draw, {placed[0], placed[i - 1], placed[i]}, number, plane, group);
  }
}

} // namespace gnomon::cpu
