#include "renderer/bake/flat_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "renderer/core/stop.h"

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
  return {glm::min(t[0], glm::min(t[1], t[2])), glm::max(t[0], glm::max(t[1], t[2]))};
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

/// A quarter turn against the clock, of length 1.
glm::dvec2 unitAcross(const glm::dvec2& v) {
  return glm::dvec2(-v.y, v.x) / std::hypot(v.x, v.y);
}

/// The directions from `first` against the clock to `last` (length 1), half a turn at most.
class Arc {
 public:
  /// Those that do not point along `v`.
  explicit Arc(const glm::dvec2& v) : first_(unitAcross(v)), last_(-first_) {}

  const glm::dvec2& first() const { return first_; }
  const glm::dvec2& last() const { return last_; }
  glm::dvec2 middle() const { return unitAcross(first_ - last_); }

  /// Leaves out those that point along `v`; false where none is left.
  bool cut(const glm::dvec2& v) {
    const bool cutsFirst = glm::dot(first_, v) > 0, cutsLast = glm::dot(last_, v) > 0;
    if (cutsFirst && cutsLast) return false;
    if (cutsFirst) first_ = unitAcross(v);
    if (cutsLast) last_ = -unitAcross(v);
    return true;
  }

 private:
  glm::dvec2 first_, last_;
};

/// Triangles in halves of halves, each with its box, in search of two that overlap. Two groups are compared as wholes
/// before their halves are: nothing in them overlaps if along some direction one group ends where the other begins.
/// The directions tried are those of the axes, which part most groups of a mesh, and a few found by cutting down all
/// others, which part the long triangles of fans and slanted strips, whose boxes all meet.
class Tree {
 public:
  Tree(std::span<const FlatTriangle> triangles, double slack) : slack_(slack) {
    for (const FlatTriangle& t : triangles) {
      const double area = signedArea(t);
      if (area != 0 && std::isfinite(area)) triangles_.push_back(t);
    }
    if (triangles_.empty()) return;
    addGroup(0, static_cast<std::uint32_t>(triangles_.size()));
    const glm::dvec2 farthest = glm::max(glm::abs(groups_[0].box.low), glm::abs(groups_[0].box.high));
    // `overlap` and the sums here round by less than this, so that groups are never parted where it sees more.
    harmless_ = slack - 1e-13 * std::max(farthest.x, farthest.y);
  }

  bool anyOverlap() const { return !groups_.empty() && anyWithin(0); }

 private:
  static constexpr std::uint32_t kFew = 8;

  struct Group {
    Box box;
    std::uint32_t first = 0, count = 0; ///< in triangles_
    std::uint32_t second = 0;           ///< its second half in groups_, after all of the first half; 0 = not halved
  };

  /// Adds the group and its halves, and brings its triangles in their order.
  void addGroup(std::uint32_t first, std::uint32_t count) {
    stopIfAsked();
    const auto begin = triangles_.begin() + first;
    const auto end = begin + count;
    const auto middleOf = [](const FlatTriangle& t) { return t[0] + t[1] + t[2]; }; // three times
    Group group{{}, first, count, 0};
    Box middles;
    for (auto t = begin; t != end; ++t) {
      for (const glm::dvec2& corner : *t) group.box.add(corner);
      middles.add(middleOf(*t));
    }
    const std::size_t at = groups_.size();
    groups_.push_back(group);
    if (count <= kFew) return;
    const glm::dvec2 extent = middles.high - middles.low;
    const int axis = extent.x > extent.y ? 0 : 1;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](const FlatTriangle& a, const FlatTriangle& b) {
      return middleOf(a)[axis] < middleOf(b)[axis];
    });
    addGroup(first, half);
    groups_[at].second = static_cast<std::uint32_t>(groups_.size());
    addGroup(first + half, count - half);
  }

  bool anyWithin(std::uint32_t i) const {
    const Group& group = groups_[i];
    if (group.second != 0) return anyWithin(i + 1) || anyWithin(group.second) || anyBetween(i + 1, group.second);
    for (std::uint32_t a = 1; a < group.count; ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        if (doOverlap(triangles_[group.first + a], triangles_[group.first + b])) return true;
      }
    }
    return false;
  }

  bool anyBetween(std::uint32_t i, std::uint32_t k) const {
    const Group &a = groups_[i], &b = groups_[k];
    if (areApart(a.box, b.box)) return false;
    stopIfAsked();
    if (a.second == 0 && b.second == 0) return anyOfEach(a, b);
    if (canBeParted(i, k)) return false;
    if (a.second != 0 && (b.second == 0 || a.count >= b.count)) return anyBetween(i + 1, k) || anyBetween(a.second, k);
    return anyBetween(i, k + 1) || anyBetween(i, b.second);
  }

  bool anyOfEach(const Group& a, const Group& b) const {
    for (std::uint32_t m = a.first; m < a.first + a.count; ++m) {
      if (areApart(boxOf(triangles_[m]), b.box)) continue;
      for (std::uint32_t n = b.first; n < b.first + b.count; ++n) {
        if (doOverlap(triangles_[m], triangles_[n])) return true;
      }
    }
    return false;
  }

  bool doOverlap(const FlatTriangle& a, const FlatTriangle& b) const {
    return !areApart(boxOf(a), boxOf(b)) && overlap(a, b, slack_);
  }

  bool areApart(const Box& a, const Box& b) const {
    const glm::dvec2 reach = glm::min(a.high - b.low, b.high - a.low); // of one past where the other begins
    const double least = std::min(reach.x, reach.y);
    return least < 0 || least <= harmless_;
  }

  /// Whether a direction was found along which the first group ends where the second begins. Where it reaches past
  /// that by `v`, every direction along `v` is out; what remains is an arc, of which the ends and the middle are
  /// tried. The ends run across a line from a corner to a corner, so they hit groups that touch along a side exactly.
  bool canBeParted(std::uint32_t i, std::uint32_t k) const {
    constexpr int kRounds = 4;
    const auto middleOf = [](const Box& box) { return 0.5 * box.low + 0.5 * box.high; };
    const glm::dvec2 fromTo = middleOf(groups_[k].box) - middleOf(groups_[i].box);
    const double length = std::hypot(fromTo.x, fromTo.y);
    glm::dvec2 past(0);
    const auto parts = [&](const glm::dvec2& direction) {
      past = reachPast(i, k, direction);
      return glm::dot(past, direction) <= harmless_;
    };
    if (parts(length > 0 ? fromTo / length : glm::dvec2(1, 0))) return true;
    Arc arc(past);
    for (int round = 0; round < kRounds; ++round) {
      if (parts(arc.first())) return true;
      if (!arc.cut(past)) return false;
      if (parts(arc.last())) return true;
      if (!arc.cut(past)) return false;
      if (parts(arc.middle())) return true;
      if (!arc.cut(past)) return false;
    }
    return false;
  }

  /// From the first corner of the one group along `direction` to the last of the other.
  glm::dvec2 reachPast(std::uint32_t i, std::uint32_t k, const glm::dvec2& direction) const {
    stopIfAsked();
    Farthest last, first;
    findFarthest(i, direction, last);
    findFarthest(k, -direction, first);
    return last.corner - first.corner;
  }

  struct Farthest {
    glm::dvec2 corner{0};
    double along = -kInfinity;
  };

  void findFarthest(std::uint32_t i, const glm::dvec2& direction, Farthest& found) const {
    const Group& group = groups_[i];
    if (group.second == 0) {
      for (std::uint32_t t = group.first; t < group.first + group.count; ++t) {
        for (const glm::dvec2& corner : triangles_[t]) {
          const double along = glm::dot(direction, corner);
          if (along > found.along) found = {corner, along};
        }
      }
      return;
    }
    const auto bound = [&](std::uint32_t half) {
      const Box& box = groups_[half].box;
      return glm::dot(direction,
                      glm::dvec2(direction.x > 0 ? box.high.x : box.low.x, direction.y > 0 ? box.high.y : box.low.y));
    };
    std::array<std::uint32_t, 2> halves{i + 1, group.second};
    std::array<double, 2> bounds{bound(halves[0]), bound(halves[1])};
    const std::size_t better = bounds[1] > bounds[0] ? 1 : 0;
    for (const std::size_t half : {better, 1 - better}) {
      if (bounds[half] > found.along) findFarthest(halves[half], direction, found);
    }
  }

  std::vector<FlatTriangle> triangles_;
  std::vector<Group> groups_; ///< each followed by its first half
  double slack_;
  double harmless_ = 0; ///< what reaches past another by this much overlaps nothing
};

} // namespace

// Of two convex shapes that do not meet, a side of one has the other on its outer side (the separating axis theorem).
bool overlap(const FlatTriangle& a, const FlatTriangle& b, double slack) {
  if (signedArea(a) == 0 || signedArea(b) == 0) return false;
  return leastDepth(a, b) > slack && leastDepth(b, a) > slack;
}

bool anyOverlap(std::span<const FlatTriangle> triangles, double slack) {
  return Tree(triangles, slack).anyOverlap();
}

} // namespace gnomon
