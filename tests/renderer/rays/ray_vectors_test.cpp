#include <algorithm>
#include <random>

#include "renderer/rays/traced_light.h"
#include "renderer/rays/traced_scene.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

/// For trees that are built while it lives.
class With {
 public:
  explicit With(RayVectors vectors) { useRayVectors(vectors); }
  ~With() { useRayVectors(RayVectors::widest); }
  With(const With&) = delete;
  With& operator=(const With&) = delete;
};

constexpr int kPictureSide = 48;
constexpr std::uint32_t kRays = 8;

/// Balls over a ground, so many that their tree is shared, or one.
Traced balls(int count, RayVectors vectors) {
  GlbBuilder builder;
  testing::addSquare(builder, 5, -1);
  const int ball =
      builder.json["nodes"][std::size_t(testing::addSphere(builder, {0, 0, 0}, count > 1 ? 0.4 : 2, 16))]["mesh"];
  for (int i = 1; i < count; ++i) {
    const int node = builder.addMeshNode(ball);
    builder.json["nodes"][std::size_t(node)]["translation"] = {-3 + 0.7 * (i % 9), 0.1 * (i % 4), -3 + 0.7 * (i / 9)};
  }
  const With with(vectors);
  Traced traced(builder);
  traced.width = traced.height = kPictureSide;
  traced.camera = testing::perspectiveView(traced.anchor() + glm::dvec3(2, 7, 9), traced.anchor(), 80);
  traced.lights = {testing::sunAlong({0.4, -1, 0.2}), testing::sunAlong({0.4, -1, 0.2}, 8)};
  return traced;
}

/// What drawn pixels see of a light, where sixteen of which each but every third shows something are asked about at
/// once.
std::vector<float> drawnShares(const Traced& traced, int light, const std::vector<SurfacePoint>& points) {
  const TracedLight traces(traced.input(), light, kRays);
  std::vector<float> shares;
  for (std::size_t first = 0; first + DrawnPlaces::kCount <= points.size(); first += DrawnPlaces::kCount) {
    DrawnPlaces places;
    for (std::size_t i = 0; i < DrawnPlaces::kCount; ++i) {
      const std::size_t pixel = first + i;
      places.x[i] = float(pixel % kPictureSide) + 0.5f;
      places.y[i] = float(pixel / kPictureSide) + 0.5f;
      places.shown[i] = {pixel % 3 != 0 ? points[pixel].instance : kNoSurface, points[pixel].triangle};
    }
    std::array<float, DrawnPlaces::kCount> seen{};
    std::array<std::uint8_t, DrawnPlaces::kCount> away{};
    traces.visibility(places, 0, kRays, seen, away);
    shares.insert(shares.end(), seen.begin(), seen.end());
  }
  return shares;
}

int differing(const std::vector<float>& a, const std::vector<float>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += std::abs(a[i] - b[i]) > 0.2f;
  return count;
}

TEST(RayVectors, AllOfThemFindTheSame) {
  for (const int count : {1, 81}) {
    const Traced widest = balls(count, RayVectors::widest);
    const std::vector<SurfacePoint> points = widest.surface();
    for (const RayVectors vectors : {RayVectors::avx2, RayVectors::sse4}) {
      SCOPED_TRACE(std::to_string(count) + (vectors == RayVectors::avx2 ? " avx2" : " sse4"));
      const Traced narrow = balls(count, vectors);
      EXPECT_LE(narrow.scene.tree().packets, vectors == RayVectors::avx2 ? 8u : 4u);
      EXPECT_LE(testing::showingOthers(narrow.surface(), points), 2);
      for (int light = 0; light < 2; ++light) {
        const std::vector<float> shares = drawnShares(narrow, light, points);
        EXPECT_GT(std::count(shares.begin(), shares.end(), 1.0f), 200);
        EXPECT_GT(std::count(shares.begin(), shares.end(), 0.0f), 10);
        EXPECT_LE(differing(shares, drawnShares(widest, light, points)), 2);
        EXPECT_LE(differing(lightVisibility(narrow.input(), light, points, 5),
                            lightVisibility(widest.input(), light, points, 5)),
                  2);
      }
    }
  }
}

} // namespace
} // namespace gnomon
