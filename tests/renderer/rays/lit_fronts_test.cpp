#include "renderer/rays/lit_fronts.h"

#include "renderer/rays/tree.h"
#include "tests/renderer/rays/any_scene.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Traced;

/// A light that a frame asked about before.
TracedLight knownLight(const TraceInput& input, int rays) {
  TracedLight(input, 0, rays);
  return TracedLight(input, 0, rays);
}

/// What the fronts of a scene's triangles see of its light, in their order.
std::vector<Front> frontsIn(const Traced& traced) {
  const TracedScene::Tree& tree = traced.scene.tree();
  const LightAndCasters of{lightSource(traced.lights[0], tree.anchor),
                           std::vector<std::uint8_t>(tree.view->instances.size(), 1)};
  std::vector<Front> fronts;
  for (std::size_t i = 0; i < tree.boxes.runs(); ++i) {
    const TriangleBoxes::Run& run = tree.boxes.run(i);
    const RunFronts found = frontsOf(tree, of, run);
    for (std::uint32_t k = 0; k < run.count; ++k) fronts.push_back(found.of(k));
  }
  return fronts;
}

auto countOf(const std::vector<Front>& fronts, Front front) {
  return std::count(fronts.begin(), fronts.end(), front);
}

void addAnySurface(GlbBuilder& builder, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const glm::dvec3 wave(3 * unit(random), 3 * unit(random), 0.5 * unit(random));
  const int cells = *rc::gen::element(3, 12, 40);
  int node = 0;
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      node = testing::addSphere(builder, {unit(random), 1, unit(random)}, 0.8, cells);
      break;
    case 1: // with hills and hollows
      node = testing::addGrid(builder, cells, [&](double x, double z) {
        return glm::dvec3(3 * x, 0.5 + wave.z * std::sin(wave.x * x + 2) * std::cos(wave.y * z), 3 * z);
      });
      break;
    default:
      node = testing::addTriangles(builder, random, cells);
  }
  if (*rc::gen::arbitrary<bool>()) builder.json["nodes"][std::size_t(node)]["scale"] = {-1, 1.5, 0.7};
  if (*rc::gen::arbitrary<bool>()) return;
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"].back()["primitives"][0]["material"] = 0;
}

TEST(LitFronts, AreWhatEveryPointOfTheTriangleSays) {
  std::size_t lit = 0, away = 0;
  EXPECT_TRUE(rc::check([&] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    GlbBuilder builder;
    testing::addSquare(builder, 4, 0);
    for (int i = *rc::gen::inRange(1, 4); i > 0; --i) addAnySurface(builder, random);
    Traced traced(builder);
    traced.camera = testing::anyView(random);
    traced.lights = {testing::anyLight(random)};
    constexpr int kRays = 16;
    const TracedLight light = knownLight(traced.input(), kRays);
    const std::vector<SurfacePoint> points = traced.surface();
    std::vector<float> shares(points.size());
    std::vector<std::uint8_t> turnedAway(points.size());
    light.visibility(points, kRays, shares, turnedAway);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const LightAcross across = light.across(PlacedTriangle{points[i].instance, points[i].triangle});
      if (points[i].instance == kNoSurface || across == LightAcross::unsure) continue;
      const bool isLit = across == LightAcross::lit;
      isLit ? ++lit : ++away;
      RC_ASSERT(shares[i] == (isLit ? 1.0f : 0.0f));
      RC_ASSERT(turnedAway[i] == (isLit ? 0 : 1));
    }
  }));
  EXPECT_GT(lit, 1000u);
  EXPECT_GT(away, 1000u);
}

TEST(LitFronts, OfABallAreLitOrDark) {
  GlbBuilder builder;
  testing::addSphere(builder, {0, 3, 0}, 1, 24);
  testing::addSquare(builder, 300, 0); // whose plane the ball's fronts are turned to
  Traced traced(builder);
  traced.lights = {testing::sunAlong({0.3, -1, 0.2})};
  std::vector<Front> fronts = frontsIn(traced);
  fronts.resize(fronts.size() - 2);
  EXPECT_GT(countOf(fronts, Front::lit), 400);
  EXPECT_GT(countOf(fronts, Front::dark), 400);
  EXPECT_LE(countOf(fronts, Front::mixed), 2 * 24) << "but those at the poles that have no area";
}

/// A round valley: every triangle has neighbours that rise over it.
TEST(LitFronts, OfAHollowAreLitWhereItsRimThrowsNoShadow) {
  GlbBuilder builder;
  testing::addGrid(builder, 8, [](double x, double z) { return glm::dvec3(x, 0.2 * (x * x + z * z), z); });
  Traced traced(builder);
  traced.lights = {testing::sunAlong({0.01, -1, 0.02})};
  EXPECT_GT(countOf(frontsIn(traced), Front::lit), 100);
  traced.lights = {testing::sunAlong({1, -0.2, 0})};
  EXPECT_GT(countOf(frontsIn(traced), Front::mixed), 20);
}

TEST(LitFronts, AreMixedUnderACaster) {
  GlbBuilder builder;
  testing::addSquare(builder, 1, 0);
  testing::addSquare(builder, 0.1f, 1);
  Traced traced(builder);
  traced.lights = {testing::sunAlong({0, -1, 0})};
  EXPECT_EQ(frontsIn(traced), (std::vector<Front>{Front::mixed, Front::mixed, Front::lit, Front::lit}));
  traced.lights = {testing::sunAlong({5, -1, 0})}; // past the floor
  EXPECT_EQ(frontsIn(traced), (std::vector<Front>(4, Front::lit)));
  traced.lights = {testing::sunAlong({5, 1, 0})};
  EXPECT_EQ(frontsIn(traced), (std::vector<Front>(4, Front::dark)));
}

TEST(LitFronts, AreAskedForFromTheSecondFrameOfALight) {
  GlbBuilder builder;
  testing::addSquare(builder, 1, 0);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({0, 3, 3}, {0, 0, 0}, 40);
  const auto across = [&] { return TracedLight(traced.input(), 0).across(PlacedTriangle{0, 0}); };
  traced.lights = {testing::sunAlong({0, -1, 0})};
  EXPECT_EQ(across(), LightAcross::unsure);
  EXPECT_EQ(across(), LightAcross::lit);
  traced.lights = {testing::sunAlong({0.1, -1, 0})};
  EXPECT_EQ(across(), LightAcross::unsure) << "another light";
  traced.camera = testing::perspectiveView({0, -3, 3}, {0, 0, 0}, 40);
  EXPECT_EQ(across(), LightAcross::turnedAway) << "seen from below";
  traced.lights = {testing::sunAlong({0, -1, 0})};
  EXPECT_EQ(across(), LightAcross::turnedAway) << "the first one is remembered";
}

TEST(LitFronts, ASceneOfFewIsAskedNoMore) {
  LitFronts fronts(100);
  RunFronts few;
  for (std::uint32_t i = 0; i < TriangleBoxes::kRunTriangles; ++i) few.set(i, i < 8 ? Front::lit : Front::mixed);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(fronts.areWorthKnowing(), i < 64);
    fronts.set(i, few);
  }
  EXPECT_EQ(fronts.of(7).of(7), Front::lit);
  EXPECT_EQ(fronts.of(7).of(8), Front::mixed);
}

} // namespace
} // namespace gnomon
