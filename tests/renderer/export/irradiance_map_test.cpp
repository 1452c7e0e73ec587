#include <cmath>
#include <gtest/gtest.h>

#include "renderer/export/baked_glb.h"
#include "renderer/scene/gltf_loader.h"
#include "tests/support/glb_builder.h"

namespace gnomon {
namespace {

/// A square of ground from -1 to 1 in its light map of 16 texels a metre, half of it shadowed.
class IrradianceMapTest : public ::testing::Test {
 protected:
  IrradianceMapTest() {
    auto layout = lightMapLayout(*scene_, view(), {16.0, {}});
    EXPECT_TRUE(layout);
    baked_.layout = std::make_shared<const LightMapLayout>(*std::move(layout));
    baked_.map.width = baked_.layout->width;
    baked_.map.height = baked_.layout->height;
    baked_.map.shares.assign(std::size_t(baked_.map.width) * std::size_t(baked_.map.height), 32768);
    light_.shadow = Shadow{};
    light_.intensity = 2;
  }

  const SceneView& view() const { return scene_->scenes[0]; }
  IrradianceMap map(std::span<const NodeSwitches> nodes = {}) const {
    const ShadowedLight shadowed{light_, baked_};
    return irradianceMap(*scene_, view(), nodes, {&shadowed, 1});
  }

  /// What the map has at a place of the ground.
  glm::vec3 at(const IrradianceMap& map, double x, double z) const {
    for (std::uint32_t triangle = 0; triangle < 2; ++triangle) {
      const FlatTriangle flat = baked_.layout->flat({0, triangle});
      std::array<glm::dvec2, 3> ground;
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3& corner = scene_->positions[scene_->indices[3 * triangle + k]];
        ground[k] = {corner.x, corner.z};
      }
      const double area = signedArea(ground);
      const double u = signedArea({ground[0], {x, z}, ground[2]}) / area;
      const double v = signedArea({ground[0], ground[1], {x, z}}) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      const glm::dvec2 place = flat[0] + u * (flat[1] - flat[0]) + v * (flat[2] - flat[0]);
      return map.texels[std::size_t(place.y) * std::size_t(map.width) + std::size_t(place.x)];
    }
    return glm::vec3(-1);
  }

  const std::shared_ptr<const Scene> scene_ = *loadGltf(testing::plane().bundle());
  BakedLight baked_;
  Light light_;
};

TEST_F(IrradianceMapTest, ASunArrivesByTheCosineOfItsAngle) {
  light_.direction = Vec3{1, -1, 0};
  light_.color = Vec3{1, 0.5, 0};
  const glm::vec3 arriving = at(map(), 0.2, 0.3);
  EXPECT_NEAR(arriving.r, 0.5 * 2 * std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(arriving.g, 0.25 * 2 * std::sqrt(0.5), 1e-3);
  EXPECT_EQ(arriving.b, 0);
  light_.direction = Vec3{0, 1, 0};
  EXPECT_EQ(at(map(), 0.2, 0.3), glm::vec3(0)) << "from below";
}

TEST_F(IrradianceMapTest, ALampFadesByDistanceAndEndsAtItsConeAndRange) {
  light_.type = LightType::point;
  light_.position = Vec3{0, 1, 0};
  for (const double x : {0.0, 0.3, 0.6}) {
    const double squared = 1 + x * x;
    EXPECT_NEAR(at(map(), x, 0.0).r, 0.5 * 2 / squared / std::sqrt(squared), 0.04) << x;
  }
  light_.range = 1.1;
  EXPECT_EQ(at(map(), 0.9, 0.5).r, 0);
  EXPECT_GT(at(map(), 0.05, 0.05).r, 0);
  light_.range.reset();
  light_.type = LightType::spot;
  light_.direction = Vec3{0, -1, 0};
  light_.innerConeDegrees = 10;
  light_.outerConeDegrees = 20;
  EXPECT_EQ(at(map(), 0.9, 0.0).r, 0);
  EXPECT_NEAR(at(map(), 0.05, 0.05).r, 1, 0.05);
}

TEST_F(IrradianceMapTest, NodesMayTakeNoShadowOrNoLight) {
  light_.direction = Vec3{0, -1, 0};
  std::vector<NodeSwitches> nodes(1);
  nodes[0].receiveShadow = false;
  EXPECT_NEAR(at(map(nodes), 0.2, 0.3).r, 2, 1e-3);
  nodes[0] = {};
  nodes[0].layers = 2;
  light_.cullingMask = 1;
  EXPECT_EQ(at(map(nodes), 0.2, 0.3).r, 0);
  light_.shadow->strength = 0.5;
  EXPECT_NEAR(at(map(), 0.2, 0.3).r, 1.5, 1e-3);
  light_.shadow->color = {0, 0.5, 1};
  EXPECT_NEAR(at(map(), 0.2, 0.3).r, 1.5, 1e-3);
  EXPECT_NEAR(at(map(), 0.2, 0.3).g, 1.75, 1e-3);
  EXPECT_NEAR(at(map(), 0.2, 0.3).b, 2, 1e-3);
}

TEST_F(IrradianceMapTest, AGlbOfItLoadsAgainAndItsSizeIsBounded) {
  light_.direction = Vec3{0, -1, 0};
  const IrradianceMap arriving = map();
  const auto file = bakedGlb(*scene_, view(), {}, *baked_.layout, arriving, 1 << 20);
  ASSERT_TRUE(file);
  SceneBundle bundle;
  bundle.model = *file;
  const auto again = loadGltf(bundle);
  ASSERT_TRUE(again) << again.problems().front().detail;
  EXPECT_EQ((*again)->summary.triangles, 2u);
  const auto none = bakedGlb(*scene_, view(), {}, *baked_.layout, arriving, 1000);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.problems().front().code, ProblemCode::tooLarge);
  std::vector<NodeSwitches> hidden(1);
  hidden[0].visible = false;
  const auto empty = bakedGlb(*scene_, view(), hidden, *baked_.layout, arriving, 1 << 20);
  ASSERT_TRUE(empty);
  EXPECT_LT(empty->size(), file->size());
}

} // namespace
} // namespace gnomon
