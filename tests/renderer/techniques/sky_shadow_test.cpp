#include "renderer/techniques/sky_shadow.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <tbb/global_control.h>

#include "renderer/prepare/frame_geometry.h"
#include "tests/renderer/rays/shapes.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

using Sampler = std::shared_ptr<const EnvironmentSampler>;

const Sampler& uniformSky() {
  static const auto sampler =
      std::make_shared<const EnvironmentSampler>([](const glm::dvec3& /*direction*/) { return glm::vec3(2.5f); }, 1);
  return sampler;
}

/// What a device knows of a picture of the pixels' centres.
struct DrawnCentres {
  explicit DrawnCentres(const Traced& of) : traced(of), grid{of.width, of.height, {glm::vec2(0.5f)}} {
    const Scene& scene = traced.scene.scene();
    const SceneView& view = traced.scene.view();
    const FrameGeometry geometry = frameGeometry(scene, view, traced.camera.eye);
    const DrawList list = buildDrawList(scene, view, geometry, DrawUse::surface,
                                        std::vector<std::uint8_t>(geometry.slotCount(), std::uint8_t{1}));
    numbers.emplace(scene, view, list);
    std::vector<std::uint32_t> all(list.triangles);
    std::iota(all.begin(), all.end(), 0u);
    const std::vector<PlacedTriangle> placed = numbers->of(all);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> found;
    for (std::uint32_t i = 0; i < placed.size(); ++i) found[{placed[i].instance, placed[i].triangle}] = i;
    std::vector<std::uint32_t> pixels(grid.pixels());
    std::iota(pixels.begin(), pixels.end(), 0u);
    for (const SurfacePoint& hit : firstHits(traced.input(), samplesOf(grid, pixels))) {
      shown.push_back(hit.instance == kNoSurface ? kNoNumber : found.at({hit.instance, hit.triangle}));
    }
  }

  SkyShadow shadow(int samples, const Sampler& sampler = uniformSky()) const {
    const ShownNumbers order = inOrder(grid, shown);
    const PicturePoints points(traced.input(), grid, *numbers, order, {});
    return skyShadow(points, {sampler}, samples);
  }

  const Traced& traced;
  SampleGrid grid;
  std::optional<TriangleNumbers> numbers;
  std::vector<std::uint32_t> shown;
};

/// The mean share of a square of pixels in the middle of the picture.
double middleOf(const SkyShadow& shadow, const Traced& traced, int half) {
  double sum = 0;
  int count = 0;
  for (int y = traced.height / 2 - half; y < traced.height / 2 + half; ++y) {
    for (int x = traced.width / 2 - half; x < traced.width / 2 + half; ++x) {
      sum += shadow.values[static_cast<std::size_t>(y * traced.width + x)].y / 65535.0;
      ++count;
    }
  }
  return sum / count;
}

TEST(SkyShadow, OpenPlaneGetsAllWithoutNoise) {
  GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({1, 5, 7}, {0, 0, 0}, 50);
  const SkyShadow shadow = DrawnCentres(traced).shadow(1);
  EXPECT_TRUE(std::all_of(shadow.values.begin(), shadow.values.end(),
                          [](const glm::u16vec4& value) { return value == glm::u16vec4(65535); }));
  EXPECT_EQ(shadow.rays, shadow.tracedPixels) << "a lobe as wide as the cosine gets no rays of its own";
}

TEST(SkyShadow, WallHidesWhatItsElevationSays) {
  for (const double elevation : {20.0, 45.0, 70.0}) {
    GlbBuilder builder;
    testing::addSquare(builder, 2, 0);
    const auto height = static_cast<float>(std::tan(glm::radians(elevation)));
    testing::addQuad(builder, {{-1000, 0, -1}, {1000, 0, -1}, {1000, height, -1}, {-1000, height, -1}});
    Traced traced(builder);
    traced.camera = testing::parallelView({0, 50, 0}, {0, -1, 0}, 0.02);
    const SkyShadow shadow = DrawnCentres(traced).shadow(16);
    const double lost = (1 - std::cos(glm::radians(elevation))) / 2;
    EXPECT_NEAR(middleOf(shadow, traced, 24), 1 - lost, 0.004) << elevation;
  }
}

TEST(SkyShadow, SphereHidesTheSquareOfItsRadiusOverItsHeight) {
  GlbBuilder builder;
  testing::addSquare(builder, 2, 0);
  testing::addSphere(builder, {0, 2, 0}, 1, 96);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({2, 0.4, 2}, {0, 0, 0}, 0.3);
  EXPECT_NEAR(middleOf(DrawnCentres(traced).shadow(16), traced, 8), 0.75, 0.005);
}

TEST(SkyShadow, NothingArrivesInAClosedBox) {
  GlbBuilder builder;
  using testing::Point;
  const Point a{-1, 0, -1}, b{1, 0, -1}, c{1, 0, 1}, d{-1, 0, 1}, e{-1, 2, -1}, f{1, 2, -1}, g{1, 2, 1}, h{-1, 2, 1};
  for (const std::vector<Point>& side :
       {std::vector<Point>{d, c, b, a}, {e, f, g, h}, {a, b, f, e}, {b, c, g, f}, {c, d, h, g}, {d, a, e, h}}) {
    testing::addQuad(builder, side);
  }
  Traced traced(builder);
  traced.camera = testing::perspectiveView({0.3, 1, 0.8}, {0, 0.2, -0.5}, 60);
  traced.camera.near = 1e-3;
  const SkyShadow shadow = DrawnCentres(traced).shadow(4);
  EXPECT_GT(shadow.tracedPixels, 0u);
  const auto lit = std::count_if(shadow.values.begin(), shadow.values.end(),
                                 [](const glm::u16vec4& value) { return value != glm::u16vec4(0); });
  EXPECT_EQ(lit, static_cast<std::ptrdiff_t>(shadow.values.size() - shadow.tracedPixels));
}

Traced spheresOverFloor() {
  GlbBuilder builder;
  testing::addSquare(builder, 4, 0);
  testing::addSphere(builder, {0, 0.5, 0}, 0.5, 32);
  testing::addSphere(builder, {1.2, 0.7, 0.4}, 0.6, 32);
  Traced traced(builder);
  traced.width = 96;
  traced.height = 72;
  traced.camera = testing::perspectiveView({1, 3, 4}, {0.3, 0.2, 0.2}, 40);
  return traced;
}

double rmsOf(const SkyShadow& a, const SkyShadow& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    const double off = (a.values[i].y - b.values[i].y) / 65535.0;
    sum += off * off;
  }
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

TEST(SkyShadow, FewRaysComeCloseToMany) {
  const Traced traced = spheresOverFloor();
  const DrawnCentres drawn(traced);
  const SkyShadow truth = drawn.shadow(256);
  const double four = rmsOf(drawn.shadow(4), truth);
  EXPECT_LT(four, 0.02);
  EXPECT_LT(rmsOf(drawn.shadow(16), truth), four);
}

TEST(SkyShadow, IsTheSameForAnyNumberOfThreads) {
  const Traced traced = spheresOverFloor();
  const DrawnCentres drawn(traced);
  const auto with = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return drawn.shadow(4);
  };
  const SkyShadow one = with(1);
  const SkyShadow two = with(2);
  EXPECT_TRUE(std::equal(one.values.begin(), one.values.end(), two.values.begin(), two.values.end()));
  EXPECT_EQ(one.rays, two.rays);
}

/// A window of light in darkness: nearly all directions bring nothing.
TEST(SkyShadow, FindsASmallWindow) {
  const glm::dvec3 towards = glm::normalize(glm::dvec3(0.6, 0.7, 0.2));
  const auto window = std::make_shared<const EnvironmentSampler>(
      [&](const glm::dvec3& d) { return glm::vec3(glm::dot(d, towards) > 0.995 ? 1000.0f : 0.05f); }, 2);
  EXPECT_GT(window->share(), 0);
  EXPECT_EQ(uniformSky()->share(), 0);
  const Traced traced = spheresOverFloor();
  const DrawnCentres drawn(traced);
  EXPECT_LT(rmsOf(drawn.shadow(4, window), drawn.shadow(256, window)), 0.08);
}

} // namespace
} // namespace gnomon
