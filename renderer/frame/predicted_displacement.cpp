#include "renderer/frame/predicted_displacement.h"

#include <algorithm>

#include "renderer/core/stop.h"
#include "renderer/reference/shadow_edges.h"
#include "renderer/shadow/predicted_error.h"

namespace gnomon {
namespace {

/// What the camera sees of the light's receivers, as a reference has it.
Reference seenSurfaces(const CameraView& view, int width, int height, std::span<const MapFootprint> footprints) {
  Reference seen;
  seen.width = width;
  seen.height = height;
  seen.surface.resize(footprints.size());
  seen.pixelWidth.resize(footprints.size());
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    if (i % static_cast<std::size_t>(width) == 0) stopIfAsked();
    const double depth = footprints[i].viewDepth;
    if (!(depth > 0)) continue;
    const glm::dvec2 pixel(static_cast<double>(i % static_cast<std::size_t>(width)) + 0.5,
                           static_cast<double>(i / static_cast<std::size_t>(width)) + 0.5);
    const glm::dvec2 ndc(2 * pixel.x / width - 1, 1 - 2 * pixel.y / height);
    seen.surface[i] = {pointAt(view, ndc, depth), footprints[i].normal, 0, 0};
    seen.pixelWidth[i] = static_cast<float>(2 * view.halfSize.y / height * (view.perspective ? depth : 1.0));
  }
  return seen;
}

/// The picture around a pixel's side.
struct EdgeWalk {
  const Reference& seen;
  std::span<const std::uint8_t> receiver;
  std::span<const float> shown;

  std::optional<std::size_t> at(std::size_t from, const glm::dvec2& way) const {
    const auto width = static_cast<std::size_t>(seen.width);
    const glm::ivec2 to = glm::ivec2(from % width, from / width) + glm::ivec2(glm::round(way));
    if (to.x < 0 || to.y < 0 || to.x >= seen.width || to.y >= seen.height) return std::nullopt;
    return static_cast<std::size_t>(to.y) * width + static_cast<std::size_t>(to.x);
  }

  /// Whether another surface rises from this one before the place where the edge is supposed to be. There, as at the
  /// foot of a wall in the light, is no true edge: a filter that reaches into the wall makes one.
  bool endsAtFoot(std::size_t from, const glm::dvec2& shift) const {
    const auto there = at(from, shift);
    if (!there || receiver[*there] == 0) return false;
    const glm::dvec3 way = seen.surface[*there].position - seen.surface[from].position;
    return glm::dot(way, glm::dvec3(seen.surface[from].normal)) > seen.pixelWidth[from];
  }

  /// Pixels from a side along a direction until the shadow's class changes, kFarthest at most: an edge is never moved
  /// past the next one, which moves with it.
  double widthAlong(std::size_t from, const glm::dvec2& direction) const {
    for (int step = 1; step < kFarthest; ++step) {
      const auto there = at(from, direction * static_cast<double>(step));
      if (!there || receiver[*there] == 0) return kFarthest;
      if (isLit(shown[*there]) != isLit(shown[from])) return step;
    }
    return kFarthest;
  }

  static constexpr int kFarthest = 4;
};

} // namespace

bool readsMap(std::span<const LitLight> lights, int light) {
  if (light < 0) return false;
  const LitLight& lit = lights[static_cast<std::size_t>(light)];
  return lit.tileCount > 0 && lit.visibilityLayer < 0;
}

std::optional<PredictedDisplacement> displacementOf(const CameraView& view, const FrameSpec& spec,
                                                    const ShadowPlan& plan, const PlannedLight& planned,
                                                    std::span<const MapFootprint> footprints,
                                                    std::span<const float> shown) {
  const Reference seen = seenSurfaces(view, spec.width, spec.height, footprints);
  const SurfaceLinks links = surfaceLinks(seen);
  std::vector<std::uint8_t> receiver(footprints.size());
  for (std::size_t i = 0; i < receiver.size(); ++i) receiver[i] = footprints[i].viewDepth > 0 ? 1 : 0;
  std::vector<MapReading> readings;
  const auto tiles =
      std::span(plan.tiles)
          .subspan(static_cast<std::size_t>(planned.firstTile), static_cast<std::size_t>(planned.tileCount));
  for (const ShadowTile& tile : tiles) readings.push_back(readingOf(tile, spec.atlas.samples));

  const EdgeWalk walk{seen, receiver, shown};
  PredictedDisplacement sum;
  forEachCrack(seen, links, receiver, shown, [&](const PixelPair& pair) {
    const auto normal = edgeNormal(seen, receiver, shown, pair);
    // From the first pixel to the second.
    glm::dvec2 across = normal.value_or(pair.across ? glm::dvec2(1, 0) : glm::dvec2(0, 1));
    if ((pair.across ? across.x : across.y) < 0) across = -across;
    const double length = 0.5 * lengthAlong(pair, normal);
    const double room = std::min(walk.widthAlong(pair.a, -across), walk.widthAlong(pair.b, across));
    for (const std::size_t side : {pair.a, pair.b}) {
      const MapFootprint& map = footprints[side];
      const glm::dvec2 shift(map.shift);
      if (walk.endsAtFoot(side, shift)) continue;
      const EdgeOnTexels edge{across, glm::dvec2(map.texelU), glm::dvec2(map.texelV), shift, room};
      const MapReading reading = overDisc(readings[static_cast<std::size_t>(map.tile)], map.penumbra);
      sum.mean += length * expectedDisplacement(edge, reading);
      sum.length += length;
    }
  });
  if (!(sum.length > 0)) return std::nullopt;
  sum.mean /= sum.length;
  return sum;
}

} // namespace gnomon
