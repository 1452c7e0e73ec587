#include "renderer/rays/lit_fronts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>

#include "renderer/core/instruction_sets.h"
#include "renderer/rays/shadow_rays.h"
#include "renderer/rays/shaft.h"
#include "renderer/rays/smooth_surface.h"
#include "renderer/rays/tree.h"

namespace gnomon {
namespace {

constexpr std::size_t kMost = TriangleBoxes::kRunTriangles;

/// The triangles of a run whose fronts are turned to the light.
struct TurnedFronts {
  std::size_t count = 0;
  std::uint32_t place[kMost]; ///< in the run
  FlatBlock block[kMost];
  double normal[3][kMost]; ///< unit length
  double least[kMost];     ///< how far along the normal something lies that rises over the triangle

  TurnedFronts() {
    std::fill_n(least, kMost, std::numeric_limits<double>::infinity());
    for (auto& axis : normal) std::fill_n(axis, kMost, 0.0);
  }

  void add(std::uint32_t at, const FlatBlock& front, double rise) {
    place[count] = at;
    block[count] = front;
    for (glm::length_t axis = 0; axis < 3; ++axis) normal[axis][count] = front.normal[axis];
    least[count] = glm::dot(front.normal, front.corners[0]) + rise;
    ++count;
  }

  std::vector<glm::dvec3> corners() const {
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < count; ++i) {
      corners.insert(corners.end(), block[i].corners.begin(), block[i].corners.begin() + 3);
    }
    return corners;
  }
};

/// Of unit length; zero for a sliver.
glm::dvec3 frontNormal(const Triangle& triangle, bool mirrored) {
  if (triangle.isSliver()) return glm::dvec3(0);
  const glm::dvec3 normal = unitAlong(triangle.area());
  return mirrored ? -normal : normal;
}

/// The fronts that a triangle rises over, a bit each.
GNOMON_FOR_EACH_INSTRUCTION_SET std::uint32_t risesOver(const TurnedFronts& fronts, const Triangle& triangle) {
  double highest[kMost];
  std::fill_n(highest, kMost, -std::numeric_limits<double>::infinity());
  for (const glm::dvec3* const corner : {&triangle.a, &triangle.b, &triangle.c}) {
    const double x = corner->x, y = corner->y, z = corner->z;
    for (std::size_t i = 0; i < kMost; ++i) {
      const double along = fronts.normal[0][i] * x + fronts.normal[1][i] * y + fronts.normal[2][i] * z;
      highest[i] = highest[i] < along ? along : highest[i];
    }
  }
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kMost; ++i) bits |= static_cast<std::uint32_t>(highest[i] > fronts.least[i]) << i;
  return bits;
}

/// Those of the turned fronts that see all of the light, a bit each.
std::uint32_t litOf(const TracedScene::Tree& tree, const LightAndCasters& of, const TurnedFronts& fronts) {
  const auto around = shaftTo(of.light, fronts.corners(), tree.scale);
  if (!around) return 0;
  std::array<std::optional<Shaft>, kMost> shafts;
  auto open = static_cast<std::uint32_t>((std::uint64_t{1} << fronts.count) - 1);
  const auto hides = [&](std::size_t i, const Triangle& caster, const std::array<glm::vec3, 3>& corners) {
    const FlatBlock& block = fronts.block[i];
    if (passesBy(of.light, block, caster)) return false;
    if (!shafts[i]) shafts[i] = shaftTo(of.light, block, tree.scale);
    return !shafts[i] || (reachesInto(*shafts[i], corners) && !passesBeside(of.light, block, caster, tree.scale));
  };
  const auto hidesAll = [&](const PlacedTriangle& other) {
    if (of.casts[other.instance] == 0) return false;
    const Triangle caster = tree.triangle(other.instance, other.triangle);
    for (std::uint32_t left = open & risesOver(fronts, caster); left != 0; left &= left - 1) {
      const int i = std::countr_zero(left);
      if (hides(static_cast<std::size_t>(i), caster, tree.corners(other))) open &= ~(1u << i);
    }
    return open == 0;
  };
  return tree.boxes.mayReachInto(*around, tree, hidesAll) ? 0 : open;
}

} // namespace

RunFronts frontsOf(const TracedScene::Tree& tree, const LightAndCasters& of, const TriangleBoxes::Run& run) {
  RunFronts found;
  TurnedFronts turned;
  for (std::uint32_t i = 0; i < run.count; ++i) {
    const Triangle triangle = tree.triangle(run.first.instance, run.first.triangle + i);
    const glm::dvec3 normal = frontNormal(triangle, tree.mirrored[run.first.instance] != 0);
    const FlatBlock front{{triangle.a, triangle.b, triangle.c, triangle.c}, normal};
    const Turn turn = turnOf(of.light, front);
    const PlacedTriangle placed{run.first.instance, run.first.triangle + i};
    const bool dark = turn == Turn::away && !(of.smooth && mayFace(tree, of.light, placed, normal));
    found.set(i, dark ? Front::dark : Front::mixed);
    if (turn == Turn::towards && isOver(of.light, front)) turned.add(i, front, leastRise(normal, triangle));
  }
  if (turned.count == 0) return found;
  for (std::uint32_t lit = litOf(tree, of, turned); lit != 0; lit &= lit - 1) {
    found.set(turned.place[std::countr_zero(lit)], Front::lit);
  }
  return found;
}

void LitFronts::set(std::size_t run, const RunFronts& fronts) {
  std::uint64_t lit = 0, mixed = 0;
  for (std::uint32_t i = 0; i < TriangleBoxes::kRunTriangles; ++i) {
    lit += fronts.of(i) == Front::lit ? 1 : 0;
    mixed += fronts.of(i) == Front::mixed ? 1 : 0;
  }
  runs_[run].store(fronts.bits(), std::memory_order_relaxed);
  known_.fetch_add(1, std::memory_order_relaxed);
  lit_.fetch_add(lit, std::memory_order_relaxed);
  mixed_.fetch_add(mixed, std::memory_order_relaxed);
}

bool LitFronts::areWorthKnowing() const {
  constexpr std::uint64_t kMany = 64;
  return known_.load(std::memory_order_relaxed) < kMany ||
         2 * lit_.load(std::memory_order_relaxed) > mixed_.load(std::memory_order_relaxed);
}

std::shared_ptr<LitFronts> KeptFronts::of(const LightAndCasters& light, std::size_t runs) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.light == light; });
  if (found == kept_.end()) {
    if (kept_.size() == kMostLights) kept_.erase(kept_.begin());
    kept_.push_back({light, nullptr});
    return nullptr;
  }
  std::rotate(found, found + 1, kept_.end());
  Kept& last = kept_.back();
  if (!last.fronts) last.fronts = std::make_shared<LitFronts>(runs);
  return last.fronts->areWorthKnowing() ? last.fronts : nullptr;
}

} // namespace gnomon
