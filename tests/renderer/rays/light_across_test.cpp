#include "renderer/rays/shaft.h"
#include "tests/renderer/rays/any_scene.h"

namespace gnomon {
namespace {

using testing::GlbBuilder;
using testing::Point;
using testing::Traced;

constexpr int kSide = 8; ///< of a block, pixels

/// What is asked of a block, and what its points say one by one.
struct Block {
  LightAcross across = LightAcross::unsure;
  std::vector<float> shares;
  std::vector<std::uint8_t> turnedAway;
};

/// The blocks of a picture that show one triangle each.
std::vector<Block> blocksOf(const Traced& traced, int samples) {
  const TraceInput input = traced.input();
  const TracedLight light(input, 0);
  const std::vector<SurfacePoint> surface = traced.surface();
  std::vector<Block> blocks;
  for (int y = 0; y < traced.height; y += kSide) {
    for (int x = 0; x < traced.width; x += kSide) {
      std::vector<SurfacePoint> points;
      for (int i = 0; i < kSide * kSide; ++i) {
        points.push_back(surface[static_cast<std::size_t>((y + i / kSide) * traced.width + x + i % kSide)]);
      }
      const PlacedTriangle shown{points[0].instance, points[0].triangle};
      const bool alone = std::all_of(points.begin(), points.end(), [&](const SurfacePoint& point) {
        return point.instance == shown.instance && point.triangle == shown.triangle;
      });
      if (!alone || shown.instance == kNoSurface) continue;
      const glm::vec2 first(float(x) + 0.5f, float(y) + 0.5f);
      Block block{light.across({first, first + float(kSide - 1), shown}), std::vector<float>(points.size()),
                  std::vector<std::uint8_t>(points.size())};
      light.visibility(points, samples, block.shares, block.turnedAway);
      blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

TEST(LightAcross, IsWhatEveryPointOfTheBlockSays) {
  std::size_t lit = 0, away = 0;
  EXPECT_TRUE(rc::check([&] {
    std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
    GlbBuilder builder;
    testing::addSquare(builder, *rc::gen::element(4.0f, 300.0f), 0);
    testing::addSquare(builder, 1, 0); // in the same plane
    testing::addTriangles(builder, random, *rc::gen::element(1, 5, 40, 2000));
    Traced traced(builder);
    traced.camera = testing::anyView(random);
    traced.lights = {testing::anyLight(random)};
    for (const Block& block : blocksOf(traced, 16)) {
      if (block.across == LightAcross::unsure) continue;
      const bool isLit = block.across == LightAcross::lit;
      isLit ? ++lit : ++away;
      for (std::size_t i = 0; i < block.shares.size(); ++i) {
        RC_ASSERT(block.shares[i] == (isLit ? 1.0f : 0.0f));
        RC_ASSERT(block.turnedAway[i] == (isLit ? 0 : 1));
      }
    }
  }));
  EXPECT_GT(lit, 100u);
  EXPECT_GT(away, 100u);
}

/// A floor seen along it, under a lamp near the block's end.
TEST(LightAcross, AShaftHoldsAllOfALongBlock) {
  const LightSource lamp{.type = LightType::point, .position = {1.9, 2, 1.8}, .radius = 0.2};
  const FlatBlock block{{{{15.4, 0, 12.6}, {14.9, 0, 13.1}, {1.6, 0, -1.1}, {2.1, 0, -1.6}}}, {0, 1, 0}};
  const double scale = 1.0 / 256;
  const auto shaft = shaftTo(lamp, block, scale);
  ASSERT_TRUE(shaft.has_value());
  for (const glm::vec4& plane : shaft->planes) {
    for (const glm::dvec3& corner : block.corners) {
      EXPECT_GE(glm::dot(glm::dvec3(plane), corner * scale) + double{plane.w}, 0.0);
    }
  }
}

/// A square over a floor: the sun's rays reach all blocks but those in its shadow, and those at the rim.
TEST(LightAcross, FindsTheBlocksThatNothingStandsOver) {
  GlbBuilder builder;
  testing::addSquare(builder, 50, 0);
  testing::addSquare(builder, 1, 1);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({0, 6, 7}, {0, 0, 0}, 60);
  for (const double size : {0.0, 2.0}) {
    traced.lights = {testing::sunAlong({0.3, -1, 0.2}, size)};
    std::size_t lit = 0, found = 0;
    for (const Block& block : blocksOf(traced, 16)) {
      if (std::any_of(block.shares.begin(), block.shares.end(), [](float share) { return share < 1; })) continue;
      ++lit;
      found += block.across == LightAcross::lit ? 1 : 0;
    }
    EXPECT_GT(lit, 20u);
    EXPECT_GE(found + 4, lit) << size;
  }
}

TEST(LightAcross, ATriangleOfAnotherInstanceThatThrowsNoShadowHidesNothing) {
  GlbBuilder builder;
  testing::addSquare(builder, 50, 0);
  testing::addSquare(builder, 40, 3);
  Traced traced(builder);
  traced.camera = testing::perspectiveView({0, 2, 2}, {0, 0, 0}, 40);
  traced.lights = {testing::sunAlong({0.1, -1, 0.2})};
  const auto litBlocks = [&] {
    const std::vector<Block> blocks = blocksOf(traced, 1);
    return std::count_if(blocks.begin(), blocks.end(), [](const Block& b) { return b.across == LightAcross::lit; });
  };
  EXPECT_EQ(litBlocks(), 0);
  traced.nodes.resize(2);
  traced.nodes[1].castShadow = false;
  EXPECT_GT(litBlocks(), 10);
}

} // namespace
} // namespace gnomon
