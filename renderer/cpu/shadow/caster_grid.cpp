#include "renderer/cpu/shadow/caster_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/core/parallel.h"
#include "renderer/cpu/shadow/largest_seen.h"
#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {
namespace {

/// Texels by which corners may be rounded as they are drawn, and some room.
constexpr double kMargin = 0.25;

struct Rectangle {
  glm::dvec2 low, high;
};

/// The greatest depth of a plane.
double mostOver(const DepthPlane& plane, const Rectangle& texels) {
  return plane.first + plane.dx * (plane.dx < 0 ? texels.low.x : texels.high.x) +
         plane.dy * (plane.dy < 0 ? texels.low.y : texels.high.y);
}

/// By how much `other` comes nearer to the light than `plane`, at most.
double nearerOver(const DepthPlane& plane, const DepthPlane& other, const Rectangle& texels) {
  return mostOver({plane.first - other.first, plane.dx - other.dx, plane.dy - other.dy}, texels);
}

double areaBetween(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Through three corners; nothing where the light sees them on a line.
std::optional<DepthPlane> planeThrough(const glm::dvec3 (&corners)[3]) {
  const glm::dvec3 q = corners[1] - corners[0], r = corners[2] - corners[0];
  const double area = areaBetween(glm::dvec2(q), glm::dvec2(r));
  DepthPlane plane;
  plane.dx = (q.z * r.y - r.z * q.y) / area;
  plane.dy = (r.z * q.x - q.z * r.x) / area;
  plane.first = corners[0].z - plane.dx * corners[0].x - plane.dy * corners[0].y;
  if (!std::isfinite(plane.first)) return std::nullopt;
  return plane;
}

struct Interval {
  double least, most;
};

/// A triangle's outline on the tile.
class Outline {
 public:
  explicit Outline(const glm::dvec3 (&corners)[3]) {
    const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
    const double turn = areaBetween(b - a, c - a) < 0 ? -1.0 : 1.0;
    const glm::dvec2 ends[3][2] = {{a, b}, {b, c}, {c, a}};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 way = turn * (ends[i][1] - ends[i][0]);
      sides_[i] = {ends[i][0], way, way.x / way.y};
    }
  }

  /// Where along x it may have texels of the rows from `low` to `high`, not cut to its corners' own x; least > most
  /// where it has none.
  Interval columns(double low, double high) const {
    constexpr double kFar = 1e6; // texels, beyond every tile
    Interval columns{-kFar, kFar};
    for (const Side& side : sides_) {
      const double up = (side.way.x > 0 ? high : low) - side.from.y; // of what lies farthest inside
      if (side.way.y < 0) columns.least = std::max(columns.least, side.from.x + side.slope * up);
      if (side.way.y > 0) columns.most = std::min(columns.most, side.from.x + side.slope * up);
      if (side.way.y == 0 && side.way.x * up < 0) return {kFar, -kFar};
    }
    return {std::min(columns.least, kFar), std::max(columns.most, -kFar)};
  }

 private:
  /// The triangle lies to its left.
  struct Side {
    glm::dvec2 from, way;
    double slope; ///< x along each y
  };
  std::array<Side, 3> sides_;
};

/// False only where the triangle lies outside of the texels.
bool mayTouch(const glm::dvec3 (&corners)[3], const Rectangle& texels) {
  const glm::dvec2 a(corners[0]), b(corners[1]), c(corners[2]);
  const glm::dvec2 least = glm::min(glm::min(a, b), c), most = glm::max(glm::max(a, b), c);
  const Interval columns = Outline(corners).columns(texels.low.y, texels.high.y);
  return least.y <= texels.high.y && most.y >= texels.low.y && std::max(least.x, columns.least) <= texels.high.x &&
         std::min(most.x, columns.most) >= texels.low.x;
}

bool tellsOpen(const shared::LightData& light) {
  const bool guesses = light.filterKind == GNOMON_FILTER_PCSS || GNOMON_READS_MOMENTS(light.filterKind);
  return light.type == GNOMON_DIRECTIONAL && light.visibilityLayer == 0 && light.hasManualBias == 0 && !guesses;
}

} // namespace

CasterGrid::CasterGrid(const FrameScene& scene, const ShadowTile& tile, std::span<const std::uint8_t> casters,
                       std::span<const std::uint32_t> seen)
    : tolerance_(0.5 * tile.depthBias),
      across_((tile.rect.width + kCellSide - 1) / kCellSide),
      up_((tile.rect.height + kCellSide - 1) / kCellSide),
      nearest_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_),
               std::numeric_limits<float>::infinity()) {
  const glm::dvec2 half(0.5 * tile.rect.width, 0.5 * tile.rect.height);
  glm::dmat4 texelsFromClip(1.0);
  texelsFromClip[0][0] = half.x;
  texelsFromClip[1][1] = half.y;
  texelsFromClip[3] = glm::dvec4(half, 0.0, 1.0);
  texelsFromRelative_ = texelsFromClip * tile.clipFromRelative;
  for (const std::uint32_t number : seen) {
    const Corners corners = cornersOf(scene, number);
    const bool casts = casters[number / kClusterTriangles] != 0;
    if (const auto plane = planeThrough(corners.at)) {
      seen_.push_back({number, casts, corners, *plane});
    } else if (casts) {
      addTriangle(corners);
    }
  }
  for (std::size_t slot = 0; slot < casters.size(); ++slot) {
    if (casters[slot] != 0) addSlot(scene, slot, seen);
  }
}

/// As a whole where its triangles are not large: one by one they take longer. Those that are seen have been added.
void CasterGrid::addSlot(const FrameScene& scene, std::size_t slot, std::span<const std::uint32_t> seen) {
  const Aabb box = transformed(texelsFromRelative_, scene.geometry.slotBounds[slot]);
  const TexelBox cells = cellsAround(glm::dvec2(box.min), glm::dvec2(box.max));
  const auto triangles = static_cast<int>(scene.slots[slot].triangles);
  const auto first = static_cast<std::uint32_t>(slot) * kClusterTriangles;
  const auto seenHere = std::lower_bound(seen.begin(), seen.end(), first);
  const bool holdsSeen = seenHere != seen.end() && *seenHere < first + kClusterTriangles;
  const int count = std::max(cells.x1 - cells.x0 + 1, 0) * std::max(cells.y1 - cells.y0 + 1, 0);
  constexpr int kLargeTriangle = 32; // cells
  if (!holdsSeen && count <= kLargeTriangle * triangles) {
    addBox(cells, box.min.z);
    return;
  }
  for (std::uint32_t i = first; i < first + static_cast<std::uint32_t>(triangles); ++i) {
    if (!std::binary_search(seen.begin(), seen.end(), i)) addTriangle(cornersOf(scene, i));
  }
}

void CasterGrid::addTriangle(const Corners& corners) {
  const auto& [a, b, c] = corners.at;
  const TexelBox cells = cellsAround(glm::dvec2(glm::min(glm::min(a, b), c)), glm::dvec2(glm::max(glm::max(a, b), c)));
  const double nearest = std::min({a.z, b.z, c.z});
  const auto plane = planeThrough(corners.at);
  if (!plane || (cells.x1 - cells.x0 < 2 && cells.y1 - cells.y0 < 2)) {
    addBox(cells, nearest);
    return;
  }
  const Outline outline(corners.at);
  for (int row = cells.y0; row <= cells.y1; ++row) {
    const double low = row * kCellSide - kMargin, high = (row + 1) * kCellSide + kMargin;
    const Interval columns = outline.columns(low, high);
    const int first = std::max(cells.x0, static_cast<int>(std::ceil((columns.least - kMargin) / kCellSide - 1.0)));
    const int last = std::min(cells.x1, static_cast<int>(std::floor((columns.most + kMargin) / kCellSide)));
    // The plane's least depth in a cell is that of one of its corners.
    const double edge = plane->dx < 0 ? kCellSide + kMargin : -kMargin;
    const double depth = plane->first + plane->dx * edge + plane->dy * (plane->dy < 0 ? high : low);
    float* const depths = nearest_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(across_);
    for (int column = first; column <= last; ++column) {
      const double here = depth + plane->dx * (column * kCellSide);
      depths[column] = std::min(depths[column], static_cast<float>(std::max(here, nearest)));
    }
  }
}

void CasterGrid::addBox(const TexelBox& cells, double nearest) {
  const auto depth = static_cast<float>(nearest);
  for (int row = cells.y0; row <= cells.y1; ++row) {
    float* const first = nearest_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(across_);
    for (int column = cells.x0; column <= cells.x1; ++column) first[column] = std::min(first[column], depth);
  }
}

CasterGrid::Corners CasterGrid::cornersOf(const FrameScene& scene, std::uint32_t triangle) const {
  const Slot& slot = scene.slots[triangle / kClusterTriangles];
  const glm::dmat4& relativeFromLocal = scene.geometry.instances[slot.instance].relativeFromLocal;
  const std::uint32_t* const indices = scene.scene.welded.data() + slot.firstIndex + 3 * (triangle % kClusterTriangles);
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 local(scene.scene.positions[slot.baseVertex + indices[i]]);
    corners.at[i] = glm::dvec3(texelsFromRelative_ * (relativeFromLocal * glm::dvec4(local, 1.0)));
  }
  return corners;
}

TexelBox CasterGrid::cellsAround(const glm::dvec2& low, const glm::dvec2& high) const {
  const auto cell = [](double texel, int count) {
    return static_cast<int>(std::floor(std::clamp(texel / kCellSide, -1.0, static_cast<double>(count))));
  };
  return {std::max(cell(low.x - kMargin, across_), 0), std::max(cell(low.y - kMargin, up_), 0),
          std::min(cell(high.x + kMargin, across_), across_ - 1), std::min(cell(high.y + kMargin, up_), up_ - 1)};
}

bool CasterGrid::isOpen(std::uint32_t triangle, const TexelBox& texels) const {
  const auto own =
      std::find_if(seen_.begin(), seen_.end(), [&](const SeenTriangle& seen) { return seen.number == triangle; });
  if (own == seen_.end()) return false;
  const Rectangle asked{{texels.x0, texels.y0}, glm::dvec2(texels.x1, texels.y1) + 1.0};
  const Rectangle around{asked.low - kMargin, asked.high + kMargin};
  for (const SeenTriangle& other : seen_) {
    if (!other.casts || other.number == triangle || !mayTouch(other.corners.at, around)) continue;
    if (nearerOver(own->plane, other.plane, asked) > tolerance_) return false;
  }
  const double most = mostOver(own->plane, asked);
  const int x1 = std::min(texels.x1 / kCellSide, across_ - 1), y1 = std::min(texels.y1 / kCellSide, up_ - 1);
  for (int row = std::max(texels.y0, 0) / kCellSide; row <= y1; ++row) {
    for (int column = std::max(texels.x0, 0) / kCellSide; column <= x1; ++column) {
      if (nearest_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) +
                   static_cast<std::size_t>(column)] < most) {
        return false;
      }
    }
  }
  return true;
}

std::vector<CasterGrid> casterGrids(const FrameScene& scene, const ShadowPlan& plan,
                                    std::span<const shared::LightData> lights, std::span<const TileCasters> casters,
                                    const DepthBuffer& surfaces) {
  std::vector<CasterGrid> grids(plan.tiles.size());
  std::vector<std::size_t> told;
  for (const shared::LightData& light : lights) {
    for (std::uint32_t i = 0; tellsOpen(light) && i < light.tileCount; ++i) {
      if (plan.tiles[light.firstTile + i].rect.width > 0) told.push_back(light.firstTile + i);
    }
  }
  if (told.empty()) return grids;
  const std::vector<std::uint32_t> seen = largestSeen(surfaces);
  if (seen.empty()) return grids;
  forEach(told.size(), [&](std::size_t i) {
    grids[told[i]] = CasterGrid(scene, plan.tiles[told[i]], casters[told[i]].slots, seen);
  });
  return grids;
}

} // namespace gnomon::cpu
