#include "renderer/techniques/traced_shadow.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <rapidcheck.h>

#include "renderer/prepare/frame_geometry.h"
#include "tests/renderer/reference/shapes.h"

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

Drawn drawn(const Traced& traced, const SampleGrid& grid) {
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
  drawn.truth = lightVisibility(traced.input(), 0, hits, 1);
  return drawn;
}

TEST(TracedShadow, IsTheTruthInPicturesOfAnySizeWhateverTheMapIsSureOf) {
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
    const auto asks = *rc::gen::container<std::vector<bool>>(grid.pixels(), rc::gen::arbitrary<bool>());
    std::vector<Verdict> verdicts;
    std::uint64_t unsure = grid.pixels();
    if (*rc::gen::arbitrary<bool>()) {
      unsure = 0;
      for (std::size_t pixel = 0; pixel < grid.pixels(); ++pixel) {
        // Sure only where all samples agree.
        const auto own = std::span(picture.truth).subspan(pixel * grid.samples(), grid.samples());
        const bool agree = std::all_of(own.begin(), own.end(), [&](float share) { return share == own[0]; });
        const Verdict sure = own[0] == 1 ? Verdict::lit : Verdict::shadow;
        verdicts.push_back(asks[pixel] || !agree ? Verdict::unsure : sure);
        unsure += verdicts.back() == Verdict::unsure ? 1 : 0;
      }
    }
    const TraceInput input = traced.input();
    const ShownNumbers shown = inOrder(grid, picture.shown);
    const PicturePoints points(input, grid, picture.numbers, shown, {});
    const TracedShadow shadow = tracedShadow(points, input, 0, 1, verdicts);
    RC_ASSERT(shadow.values.size() == picture.truth.size());
    RC_ASSERT(verdicts.empty() || shadow.tracedPixels >= unsure);
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

} // namespace
} // namespace gnomon
