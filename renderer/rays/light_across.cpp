#include <algorithm>
#include <chrono>
#include <cmath>

#include "renderer/rays/crossings.h"
#include "renderer/rays/smooth_surface.h"
#include "renderer/rays/traced_light.h"

namespace gnomon {
namespace {

/// Where the corners of the block lie on the triangle that shows there; nothing where one of them lies outside of it.
std::optional<FlatBlock> blockOn(const Triangle& triangle, const Sight& sight, const DrawnBlock& block) {
  if (triangle.isSliver()) return std::nullopt;
  const glm::dvec3 area = triangle.area();
  const glm::dvec3 sides[] = {triangle.b - triangle.a, triangle.c - triangle.b, triangle.a - triangle.c};
  Places places{};
  for (unsigned i = 0; i < 4; ++i) {
    places.x[i] = i == 0 || i == 3 ? block.first.x : block.last.x;
    places.y[i] = i < 2 ? block.first.y : block.last.y;
  }
  Lines lines;
  setLines(sight, places, lines);
  FlatBlock flat;
  for (unsigned i = 0; i < 4; ++i) {
    const glm::dvec3 origin(lines.origin[0][i], lines.origin[1][i], lines.origin[2][i]);
    const glm::dvec3 direction(lines.direction[0][i], lines.direction[1][i], lines.direction[2][i]);
    const double distance = glm::dot(triangle.a - origin, area) / glm::dot(direction, area);
    if (!(distance > 0 && distance < HUGE_VAL)) return std::nullopt;
    const glm::dvec3 corner = origin + direction * distance;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& from = k == 0 ? triangle.a : k == 1 ? triangle.b : triangle.c;
      if (!(glm::dot(glm::cross(sides[k], corner - from), area) >= 0)) return std::nullopt;
    }
    flat.corners[i] = corner;
    if (i == 0) flat.normal = area / (glm::dot(direction, area) > 0 ? -glm::length(area) : glm::length(area));
  }
  return flat;
}

/// What the camera sees of a triangle: its front, or its back; nothing where it sees it edge-on.
std::optional<bool> showsFront(const Triangle& triangle, const Sight& sight, bool mirrored) {
  const glm::dvec3 along = sight.slope == glm::dvec2(0) ? sight.middle : triangle.a - sight.origin;
  const glm::dvec3 area = triangle.area();
  const double facing = glm::dot(area, along);
  if (!(facing * facing > 1e-12 * glm::dot(area, area) * glm::dot(along, along))) return std::nullopt;
  return (facing < 0) != mirrored;
}

double heightOver(const FlatBlock& block, const Triangle& triangle) {
  const auto height = [&](const glm::dvec3& corner) { return glm::dot(block.normal, corner - block.corners[0]); };
  return std::max({height(triangle.a), height(triangle.b), height(triangle.c)});
}

} // namespace

LightAcross TracedLight::across(const DrawnBlock& block) const {
  const State& of = *state_;
  const PlacedTriangle& shown = block.shown;
  if (shown.instance == kNoSurface || of.shadowed[shown.instance] == 0) return LightAcross::lit;
  const TracedScene::Tree& tree = of.casters.tree;
  const Triangle own = tree.triangle(shown.instance, shown.triangle);
  const auto flat = blockOn(own, of.sight, block);
  if (!flat) return LightAcross::unsure;
  const Turn turn = turnOf(of.from.light, *flat);
  if (turn == Turn::unsure) return LightAcross::unsure;
  if (turn == Turn::away) {
    const bool lit = of.from.smooth && mayFace(tree, of.from.light, shown, flat->normal);
    return lit ? LightAcross::unsure : LightAcross::turnedAway;
  }
  const auto shaft = shaftTo(of.from.light, *flat, tree.scale);
  if (!shaft) return LightAcross::unsure;
  const double rise = leastRise(flat->normal, own);
  const auto casts = [&](const PlacedTriangle& other) {
    return of.casters.opacity[other.instance] != Opacity::none &&
           heightOver(*flat, tree.triangle(other.instance, other.triangle)) > rise;
  };
  return tree.boxes.mayReachInto(*shaft, tree, casts) ? LightAcross::unsure : LightAcross::lit;
}

std::optional<RunFronts> TracedLight::State::frontsOf(std::size_t run) const {
  constexpr std::int64_t kNanosecondsAPixel = 50;
  const RunFronts known = fronts->of(run);
  if (known.bits() != 0) return known;
  const bool mayFindOut = nanoseconds.load(std::memory_order_relaxed) < kNanosecondsAPixel * input.width * input.height;
  if (!mayFindOut || !fronts->areWorthKnowing()) return std::nullopt;
  const auto begin = std::chrono::steady_clock::now();
  const RunFronts found = gnomon::frontsOf(casters.tree, from, casters.tree.boxes.run(run));
  fronts->set(run, found);
  nanoseconds.fetch_add(std::chrono::nanoseconds(std::chrono::steady_clock::now() - begin).count(),
                        std::memory_order_relaxed);
  return found;
}

bool TracedLight::knowsTriangles() const {
  return state_->fronts != nullptr;
}

LightAcross TracedLight::across(const PlacedTriangle& shown) const {
  const State& of = *state_;
  if (shown.instance == kNoSurface || of.shadowed[shown.instance] == 0) return LightAcross::lit;
  if (!of.fronts) return LightAcross::unsure;
  const TracedScene::Tree& tree = of.casters.tree;
  const auto fronts = of.frontsOf(tree.boxes.runOf(shown));
  if (!fronts) return LightAcross::unsure;
  const Front front = fronts->of(TriangleBoxes::placeInRun(shown));
  if (front == Front::mixed) return LightAcross::unsure;
  const auto shows =
      showsFront(tree.triangle(shown.instance, shown.triangle), of.sight, tree.mirrored[shown.instance] != 0);
  if (!shows || (!*shows && front == Front::dark)) return LightAcross::unsure;
  return *shows && front == Front::lit ? LightAcross::lit : LightAcross::turnedAway;
}

} // namespace gnomon
