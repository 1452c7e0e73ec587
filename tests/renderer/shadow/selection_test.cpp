// Why a cascade is chosen by view depth, and not as the finest tile that holds the point.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/renderer/shadow/plan_lookup.h"

namespace gnomon {
namespace {

/// A level ground seen from 1.7 m above it, 10 degrees downwards, to 100 m.
PlanInput groundView(double azimuth, double elevation, Stabilization stabilization) {
  PlanInput input = simplePlan(1, 100);
  input.view.halfSize = {0.8, 0.45};
  input.view.eye = {0, 1.7, 0};
  turn(input.view, 0, -0.17);
  ReceiverDepths& seen = input.receivers;
  seen.range = {};
  for (int block = 0; block < seen.columns * seen.rows; ++block) {
    DepthSpan span;
    for (const double edge : {0.0, 1.0}) {
      const double y = 1 - 2 * (block / seen.columns + edge) / seen.rows;
      const double fall = -(input.view.forward.y + input.view.up.y * input.view.halfSize.y * y);
      const double depth = fall > 0.017 ? 1.7 / fall : 0;
      if (depth <= 0) continue;
      if (span.empty()) span = {static_cast<float>(depth), static_cast<float>(depth)};
      span.nearest = std::min(span.nearest, static_cast<float>(depth));
      span.farthest = std::max(span.farthest, static_cast<float>(depth));
    }
    seen.blocks[static_cast<std::size_t>(block)] = span;
    if (span.empty()) continue;
    if (seen.range.empty()) seen.range = span;
    seen.range.nearest = std::min(seen.range.nearest, span.nearest);
    seen.range.farthest = std::max(seen.range.farthest, span.farthest);
  }
  ShadowCaster& sun = input.casters[0];
  sun.direction = -glm::dvec3(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                              -std::cos(azimuth) * std::cos(elevation));
  sun.shadow.stabilization = stabilization;
  if (stabilization != Stabilization::none) sun.shadow.depthRange = {DepthRangeMode::manual, 0, 100};
  return input;
}

double texelSide(const ShadowTile& tile) {
  return std::sqrt(tile.space.fit.texelSize.x * tile.space.fit.texelSize.y);
}

/// How much finer a texel the finest tile has than the one chosen by depth: the mean over the picture's points, 1 = no.
double gain(const PlanInput& input) {
  const ShadowPlan plan = planShadows(input);
  const ReceiverDepths& seen = input.receivers;
  double sum = 0;
  int count = 0;
  for (int block = 0; block < seen.columns * seen.rows; ++block) {
    const DepthSpan& span = seen.blocks[static_cast<std::size_t>(block)];
    if (span.empty()) continue;
    const glm::dvec2 ndc((block % seen.columns + 0.5) * 2 / seen.columns - 1,
                         1 - (block / seen.columns + 0.5) * 2 / seen.rows);
    const double depth = 0.5 * (span.nearest + span.farthest);
    const auto chosen = tilesRead(plan, plan.lights[0], depth);
    if (chosen.empty()) continue;
    double finest = texelSide(*chosen[0]);
    for (const ShadowTile& tile : plan.tiles) {
      if (isServed(tile, pointAt(input.view, ndc, depth))) finest = std::min(finest, texelSide(tile));
    }
    sum += finest / texelSide(*chosen[0]);
    ++count;
  }
  return sum / count;
}

TEST(Selection, X15_X22_TheFinestTileThatHoldsAPointIsHardlyFinerThanThatOfItsDepth) {
  for (const auto stabilization : {Stabilization::none, Stabilization::projectionSnapping}) {
    double sum = 0;
    double least = 1;
    int views = 0;
    for (const double azimuth : {0.3, 1.2, 2.4, 3.6, 5.1}) {
      for (const double elevation : {0.3, 0.8, 1.3}) {
        const double finer = gain(groundView(azimuth, elevation, stabilization));
        sum += finer;
        least = std::min(least, finer);
        ++views;
      }
    }
    std::printf("%s fit: texels of the finest tile %.3f of those by depth, at best %.3f\n",
                stabilization == Stabilization::none ? "tight" : "stable", sum / views, least);
    EXPECT_GT(sum / views, 0.9);
  }
}

} // namespace
} // namespace gnomon
