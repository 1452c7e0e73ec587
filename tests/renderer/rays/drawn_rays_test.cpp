#include "renderer/rays/traced_light.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

constexpr int kPixels = 48; ///< of the picture, pixels, which are a millimetre wide

/// A ground, and close above it a sheet whose rim runs across the columns of the picture: seen from far above, under a
/// low sun from the sheet's side.
Traced sheetOver(float height) {
  GlbBuilder builder;
  testing::addSquare(builder, 5, 0);
  const float lean = 0.02f;
  testing::addQuad(builder, {{-lean, height, 1}, {1, height, 1}, {1, height, -1}, {lean, height, -1}});
  Traced traced(builder);
  traced.width = traced.height = kPixels;
  traced.camera = testing::parallelView(traced.anchor() + glm::dvec3(0, 10, 0), {0, -1, 0}, kPixels * 1e-3);
  traced.lights = {testing::sunAlong({-2, -1, 0})};
  return traced;
}

std::vector<float> sharesOfDrawn(const Traced& traced, const std::vector<SurfacePoint>& points) {
  const TracedLight light(traced.input(), 0);
  std::vector<float> shares(points.size());
  for (std::size_t first = 0; first < points.size(); first += DrawnPlaces::kCount) {
    DrawnPlaces places;
    for (std::size_t i = 0; i < DrawnPlaces::kCount; ++i) {
      const std::size_t pixel = first + i;
      places.x[i] = float(pixel % kPixels) + 0.5f;
      places.y[i] = float(pixel / kPixels) + 0.5f;
      places.shown[i] = {points[pixel].instance, points[pixel].triangle};
    }
    std::array<std::uint8_t, DrawnPlaces::kCount> away{};
    light.visibility(places, 0, 1, std::span(shares).subspan(first, DrawnPlaces::kCount), away);
  }
  return shares;
}

TEST(DrawnRays, MeetWhatLiesCloseAboveTheSurface) {
  const Traced traced = sheetOver(1e-4f);
  const std::vector<SurfacePoint> points = traced.surface();
  const std::vector<float> exact = lightVisibility(traced.input(), 0, points, 1);
  const std::vector<float> drawn = sharesOfDrawn(traced, points);
  EXPECT_GT(std::count(exact.begin(), exact.end(), 0.0f), 5) << "the shadow is a fifth of a pixel wide";
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(drawn[i], exact[i]) << i % kPixels << ", " << i / kPixels;
}

} // namespace
} // namespace gnomon
