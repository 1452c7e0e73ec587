#include "renderer/bake/flat_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Box {
  glm::dvec2 low{kInfinity};
  glm::dvec2 high{-kInfinity};

  void add(const glm::dvec2& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

Box boxOf(const FlatTriangle& t) {
  Box box;
  for (const glm::dvec2& corner : t) box.add(corner);
  return box;
}

/// By how much the triangles would have to move apart along the normal of a side of `a`.
double leastDepth(const FlatTriangle& a, const FlatTriangle& b) {
  const double turn = signedArea(a) < 0 ? -1 : 1;
  double least = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 side = a[(i + 1) % 3] - a[i];
    const double length = glm::length(side);
    if (!(length > 0)) continue;
    const glm::dvec2 inwards = turn / length * glm::dvec2(-side.y, side.x);
    double deepest = -kInfinity;
    for (const glm::dvec2& corner : b) deepest = std::max(deepest, glm::dot(inwards, corner - a[i]));
    least = std::min(least, deepest);
  }
  return least;
}

/// The cells of a grid over all triangles, about as many as these, each with the triangles whose boxes reach into it.
class Cells {
 public:
  explicit Cells(std::span<const FlatTriangle> triangles) {
    Box all;
    for (const FlatTriangle& t : triangles) {
      boxes_.push_back(boxOf(t));
      all.add(boxes_.back().low);
      all.add(boxes_.back().high);
    }
    low_ = all.low;
    const glm::dvec2 extent = glm::max(all.high - all.low, glm::dvec2(1e-300));
    const double side = std::clamp(std::sqrt(static_cast<double>(triangles.size())), 1.0, 2048.0);
    columns_ = static_cast<int>(side);
    scale_ = static_cast<double>(columns_) / extent;
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(columns_));
  }

  /// Calls `each(other)` for the triangles added before whose boxes meet number `i`'s, some of them twice, until it
  /// returns true; gives whether it did. Then adds number `i`.
  template <class Each>
  bool meetAndAdd(std::uint32_t i, Each each) {
    const Box& box = boxes_[i];
    const glm::ivec2 first = cellOf(box.low);
    const glm::ivec2 last = cellOf(box.high);
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        std::vector<std::uint32_t>& cell = cells_[static_cast<std::size_t>(y * columns_ + x)];
        for (const std::uint32_t other : cell) {
          const Box& b = boxes_[other];
          const bool apart = glm::any(glm::lessThan(b.high, box.low)) || glm::any(glm::lessThan(box.high, b.low));
          if (!apart && each(other)) return true;
        }
        cell.push_back(i);
      }
    }
    return false;
  }

 private:
  glm::ivec2 cellOf(const glm::dvec2& p) const {
    return glm::clamp(glm::ivec2((p - low_) * scale_), glm::ivec2(0), glm::ivec2(columns_ - 1));
  }

  std::vector<Box> boxes_;
  glm::dvec2 low_{0}, scale_{1};
  int columns_ = 1;
  std::vector<std::vector<std::uint32_t>> cells_;
};

} // namespace

// Of two convex shapes that do not meet, a side of one has the other on its outer side (the separating axis theorem).
bool overlap(const FlatTriangle& a, const FlatTriangle& b, double slack) {
  if (signedArea(a) == 0 || signedArea(b) == 0) return false;
  return leastDepth(a, b) > slack && leastDepth(b, a) > slack;
}

bool anyOverlap(std::span<const FlatTriangle> triangles, double slack) {
  Cells cells(triangles);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (signedArea(triangles[i]) == 0) continue;
    if (cells.meetAndAdd(i, [&](std::uint32_t other) { return overlap(triangles[i], triangles[other], slack); })) {
      return true;
    }
  }
  return false;
}

} // namespace gnomon
