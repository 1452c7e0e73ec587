#include "renderer/rays/triangle_boxes.h"

#include <algorithm>
#include <array>
#include <bit>

#include "renderer/core/instruction_sets.h"
#include "renderer/core/parallel.h"
#include "renderer/rays/tree.h"

namespace gnomon {
namespace {

constexpr int kMostQuestions = 96; ///< of a row of boxes, or of a run's triangles, each; then rays are cheaper

struct Extent {
  glm::vec3 low{1e30f};
  glm::vec3 high{-1e30f};

  void add(const glm::vec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
};

Extent extentOf(const BoxRow& row) {
  Extent extent;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    extent.low[axis] = *std::min_element(std::begin(row.low[axis]), std::end(row.low[axis]));
    extent.high[axis] = *std::max_element(std::begin(row.high[axis]), std::end(row.high[axis]));
  }
  return extent;
}

/// Rows of the boxes `extentAt(i)`. What is left of the last one lies outside of every shaft.
template <class ExtentAt>
std::vector<BoxRow> rowsOf(std::size_t count, const ExtentAt& extentAt) {
  std::vector<BoxRow> rows((count + kLanes - 1) / kLanes);
  forEach(rows.size(), [&](std::size_t row) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = row * kLanes + lane;
      const Extent extent = i < count ? extentAt(i) : Extent{};
      for (glm::length_t axis = 0; axis < 3; ++axis) {
        rows[row].low[axis][lane] = extent.low[axis];
        rows[row].high[axis][lane] = extent.high[axis];
      }
    }
  });
  return rows;
}

/// The boxes that no plane of the shaft leaves outside, a bit each.
GNOMON_FOR_EACH_INSTRUCTION_SET std::uint32_t boxesIn(const Shaft& shaft, const BoxRow& row) {
  alignas(64) int inside[kLanes];
  std::fill_n(inside, kLanes, -1);
  for (const glm::vec4& plane : shaft.planes) {
    const float* x = plane.x < 0 ? row.low[0] : row.high[0]; // the corner that lies farthest inside
    const float* y = plane.y < 0 ? row.low[1] : row.high[1];
    const float* z = plane.z < 0 ? row.low[2] : row.high[2];
    const float nx = plane.x, ny = plane.y, nz = plane.z, w = plane.w;
    for (unsigned i = 0; i < kLanes; ++i) inside[i] &= nx * x[i] + ny * y[i] + nz * z[i] + w < 0 ? 0 : -1;
  }
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < kLanes; ++i) bits |= static_cast<std::uint32_t>(inside[i]) & 1u << i;
  return bits;
}

} // namespace

bool reachesInto(const Shaft& shaft, const std::array<glm::vec3, 3>& corners) {
  return std::none_of(shaft.planes.begin(), shaft.planes.end(), [&](const glm::vec4& plane) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const glm::vec3& corner) { return glm::dot(glm::vec3(plane), corner) + plane.w < 0; });
  });
}

TriangleBoxes::TriangleBoxes(const TracedScene::Tree& tree) {
  for (std::uint32_t instance = 0; instance < tree.view->instances.size(); ++instance) {
    const std::uint32_t count = tree.primitive(instance).indexCount / 3;
    firstRun_.push_back(runs_.size());
    for (std::uint32_t first = 0; first < count; first += kRunTriangles) {
      runs_.push_back({{instance, first}, std::min(kRunTriangles, count - first)});
    }
  }
  levels_.push_back(rowsOf(runs_.size(), [&](std::size_t run) {
    Extent extent;
    for (std::uint32_t i = 0; i < runs_[run].count; ++i) {
      const PlacedTriangle& first = runs_[run].first;
      for (const glm::vec3& corner : tree.corners({first.instance, first.triangle + i})) extent.add(corner);
    }
    return extent;
  }));
  while (levels_.back().size() > 1) {
    const std::vector<BoxRow>& below = levels_.back();
    levels_.push_back(rowsOf(below.size(), [&](std::size_t row) { return extentOf(below[row]); }));
  }
}

bool TriangleBoxes::mayReachInto(const Shaft& shaft, const TracedScene::Tree& tree,
                                 const std::function<bool(const PlacedTriangle&)>& casts) const {
  if (runs_.empty()) return false;
  struct Row {
    std::size_t level, number;
  };
  std::array<Row, kMostQuestions * kLanes> open;
  std::size_t count = 0;
  open[count++] = {levels_.size() - 1, 0};
  int questions = 0;
  while (count > 0) {
    const Row at = open[--count];
    if (++questions > kMostQuestions) return true;
    for (std::uint32_t in = boxesIn(shaft, levels_[at.level][at.number]); in != 0; in &= in - 1) {
      const std::size_t box = at.number * kLanes + static_cast<std::size_t>(std::countr_zero(in));
      if (at.level > 0) {
        open[count++] = {at.level - 1, box};
        continue;
      }
      if (++questions > kMostQuestions) return true;
      const Run& run = runs_[box];
      for (std::uint32_t i = 0; i < run.count; ++i) {
        const PlacedTriangle triangle{run.first.instance, run.first.triangle + i};
        if (reachesInto(shaft, tree.corners(triangle)) && casts(triangle)) return true;
      }
    }
  }
  return false;
}

std::size_t TriangleBoxes::bytes() const {
  std::size_t bytes = runs_.capacity() * sizeof(Run) + firstRun_.capacity() * sizeof(std::size_t);
  for (const std::vector<BoxRow>& level : levels_) bytes += level.capacity() * sizeof(BoxRow);
  return bytes;
}

} // namespace gnomon
