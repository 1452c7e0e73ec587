#include "renderer/techniques/traced_shadow.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <rapidcheck.h>
#include <tbb/global_control.h>

#include "renderer/prepare/frame_geometry.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

/// A square over a floor and a sphere beside it, which ends in faces turned away from the sun.
Traced scene() {
  GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  testing::addSquare(builder, 1, 1);
  testing::addSphere(builder, {2, 0.8, 1.5}, 0.7, 12);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({1, 5, 7}, {0.3, 0, 0.2}, 50);
  traced.lights = {testing::sunAlong({0.31, -1, 0.17})};
  return traced;
}

/// What a device knows of a picture: the number of the triangle that each sample shows.
struct Drawn {
  TriangleNumbers numbers;
  std::vector<std::uint32_t> shown;
  std::vector<float> truth; ///< share of the light at each sample
};

Drawn drawn(const Traced& traced, const SampleGrid& grid, int samples = 1) {
  const Scene& scene = traced.scene.scene();
  const SceneView& view = traced.scene.view();
  const FrameGeometry geometry = frameGeometry(scene, view, traced.camera.eye);
  const DrawList list = buildDrawList(scene, view, geometry, DrawUse::surface,
                                      std::vector<std::uint8_t>(geometry.slotCount(), std::uint8_t{1}));
  Drawn drawn{TriangleNumbers(scene, view, list), {}, {}};
  std::vector<std::uint32_t> pixels(grid.pixels());
  std::iota(pixels.begin(), pixels.end(), 0u);
  const std::vector<SurfacePoint> hits = firstHits(traced.input(), samplesOf(grid, pixels));
  std::vector<std::uint32_t> all(list.triangles);
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<PlacedTriangle> placed = drawn.numbers.of(all);
  for (const SurfacePoint& hit : hits) {
    const auto found = std::find_if(placed.begin(), placed.end(), [&](const PlacedTriangle& of) {
      return of.instance == hit.instance && of.triangle == hit.triangle;
    });
    drawn.shown.push_back(found == placed.end() ? kNoNumber : static_cast<std::uint32_t>(found - placed.begin()));
  }
  drawn.truth = lightVisibility(traced.input(), 0, hits, samples);
  return drawn;
}

TEST(TracedShadow, IsTheTruthInPicturesOfAnySize) {
  Traced traced = scene();
  EXPECT_TRUE(rc::check([&] {
    // Sizes that blocks of 32 x 16 pixels and squares of 4 x 4 do not divide.
    SampleGrid grid{*rc::gen::inRange(1, 70), *rc::gen::inRange(1, 40), {{0.5f, 0.5f}}};
    if (*rc::gen::arbitrary<bool>()) {
      grid.positions = {{0.375f, 0.125f}, {0.875f, 0.375f}, {0.125f, 0.625f}, {0.625f, 0.875f}};
    }
    traced.width = grid.width;
    traced.height = grid.height;
    const Drawn picture = drawn(traced, grid);
    const TraceInput input = traced.input();
    const ShownNumbers shown = inOrder(grid, picture.shown);
    const PicturePoints points(input, grid, picture.numbers, shown, {});
    const TracedShadow shadow = tracedShadow(points, input, 0, 1);
    RC_ASSERT(shadow.values.size() == picture.truth.size());
    RC_ASSERT(shadow.tracedPixels <= grid.pixels());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < picture.truth.size(); ++i) {
      // One ray a pixel decides where its neighbours agree with it.
      const std::size_t first = i / grid.samples() * grid.samples();
      const auto own = std::span(picture.truth).subspan(first, grid.samples());
      const bool agree = std::all_of(own.begin(), own.end(), [&](float share) { return share == own[0]; });
      if (shadow.values[i] != unorm16(picture.truth[i]) && (agree || grid.samples() == 1)) ++wrong;
    }
    RC_ASSERT(wrong == 0u);
  }));
}

SampleGrid centres(int width, int height) {
  return {width, height, {{0.5f, 0.5f}}};
}

UnfilledVector<std::uint16_t> traced(const Traced& traced, const SampleGrid& grid, const Drawn& picture, int samples) {
  const TraceInput input = traced.input();
  const ShownNumbers shown = inOrder(grid, picture.shown);
  const PicturePoints points(input, grid, picture.numbers, shown, {});
  return tracedShadow(points, input, 0, samples).values;
}

double rms(const UnfilledVector<std::uint16_t>& values, const std::vector<float>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = values[i] / 65535.0 - double{truth[i]};
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(truth.size()));
}

TEST(TracedShadow, OfALightThatIsAskedForAgainTakesFewerRaysAndIsTheSame) {
  Traced traced = scene();
  const SampleGrid grid = centres(traced.width, traced.height);
  for (const double size : {0.0, 2.0}) {
    traced.lights = {testing::sunAlong({0.31, -1, 0.17}, size)};
    const Drawn picture = drawn(traced, grid);
    const TraceInput input = traced.input();
    const ShownNumbers shown = inOrder(grid, picture.shown);
    const PicturePoints points(input, grid, picture.numbers, shown, {});
    const Traced fresh = scene(); // which no light was asked for
    const TraceInput firstInput{fresh.scene, traced.camera, grid.width, grid.height, traced.lights, {}};
    const PicturePoints firstPoints(firstInput, grid, picture.numbers, shown, {});
    const TracedShadow first = tracedShadow(firstPoints, firstInput, 0, 16);
    const TracedShadow again = tracedShadow(points, input, 0, 16);
    EXPECT_EQ(first.values, again.values) << size;
    EXPECT_LT(again.tracedPixels, first.tracedPixels) << size;
  }
}

TEST(TracedShadow, N6_PenumbrasAreThoseOfALightSampledAllOver) {
  Traced scene = gnomon::scene();
  EXPECT_TRUE(rc::check([&] {
    const SampleGrid grid = centres(*rc::gen::inRange(30, 80), *rc::gen::inRange(20, 60));
    scene.width = grid.width;
    scene.height = grid.height;
    const double size = *rc::gen::element(0.53, 5.0, 15.0);
    scene.lights = {*rc::gen::arbitrary<bool>() ? testing::sunAlong({0.31, -1, 0.17}, size)
                                                : testing::pointAt({-1, 4, 0.3}, 0.04 * size)};
    const Drawn picture = drawn(scene, grid, 4096);
    const auto values = traced(scene, grid, picture, 16);
    RC_ASSERT(rms(values, picture.truth) < 0.035);
    RC_ASSERT(rms(traced(scene, grid, picture, 256), picture.truth) < 0.012);
    // Another run's threads meet the pixels in another order, and so does one alone.
    RC_ASSERT(traced(scene, grid, picture, 16) == values);
    {
      const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
      RC_ASSERT(traced(scene, grid, picture, 16) == values);
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < picture.truth.size(); ++i) {
      wrong += std::abs(values[i] / 65535.0 - double{picture.truth[i]}) > 0.4 ? 1 : 0;
    }
    RC_ASSERT(wrong == 0u);
  }));
}

TEST(TracedShadow, NoPenumbraIsMissed) {
  // Wires over a floor: their umbra ends before it, and most of the sun is seen everywhere.
  using Wires = std::pair<float, float>; // how wide they are, and how far they are turned
  for (const auto& [width, turn] :
       {Wires{0.03f, 0.0f}, Wires{0.05f, 0.0f}, Wires{0.1f, 0.0f}, Wires{0.03f, 0.4f}, Wires{0.03f, 0.8f},
        Wires{0.03f, 1.2f}, Wires{0.03f, 1.6f}, Wires{0.03f, 2.0f}, Wires{0.03f, 2.4f}, Wires{0.03f, 2.8f}}) {
    const auto at = [cosine = std::cos(turn), sine = std::sin(turn)](float across, float along) {
      return testing::Point{across * cosine - along * sine, 1, across * sine + along * cosine};
    };
    GlbBuilder builder;
    testing::addSquare(builder, 4, 0);
    for (const float x : {-1.7f, -0.4f, 1.13f}) {
      testing::addQuad(builder, {at(x, 3), at(x + width, 3), at(x + width, -3), at(x, -3)});
    }
    Traced wires(builder);
    wires.camera = testing::parallelView({0, 0.5, 0}, {0, -1, 0}, 6);
    wires.width = wires.height = 120;
    wires.lights = {testing::sunAlong({0.2, -1, 0.1}, 15)};
    const SampleGrid grid = centres(wires.width, wires.height);
    const Drawn picture = drawn(wires, grid, 1024);
    const auto values = traced(wires, grid, picture, 64);
    std::size_t darkened = 0;
    std::size_t missed = 0;
    for (std::size_t i = 0; i < picture.truth.size(); ++i) {
      if (picture.truth[i] > 0.9f) continue;
      ++darkened;
      missed += values[i] == 65535 ? 1 : 0;
    }
    EXPECT_GT(darkened, 200u) << width;
    EXPECT_LT(static_cast<double>(missed), 0.01 * static_cast<double>(darkened)) << width << " turned by " << turn;
    EXPECT_LT(rms(values, picture.truth), 0.02) << width << " turned by " << turn;
  }
}

TEST(TracedShadow, N1_ALightOfNoSizeIsTheLimitOfSmallOnes) {
  Traced scene = gnomon::scene();
  const SampleGrid grid = centres(80, 60);
  scene.width = grid.width;
  scene.height = grid.height;
  const Drawn sharp = drawn(scene, grid);
  scene.lights = {testing::sunAlong({0.31, -1, 0.17}, 1e-4)};
  const auto values = traced(scene, grid, sharp, 16);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < values.size(); ++i) differing += values[i] != unorm16(sharp.truth[i]) ? 1 : 0;
  EXPECT_LE(differing, 3u);
}

} // namespace
} // namespace gnomon
