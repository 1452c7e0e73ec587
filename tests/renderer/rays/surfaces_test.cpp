#include "tests/renderer/rays/shapes.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

using nlohmann::json;
using testing::addQuad;
using testing::addSquare;
using testing::GlbBuilder;
using testing::parallelView;
using testing::sunAlong;
using testing::Traced;

/// What one ray straight down at x, z meets.
SurfacePoint below(Traced& traced, double x, double z) {
  traced.width = traced.height = 1;
  traced.camera = parallelView({x, 50, z}, {0, -1, 0}, 1e-3);
  return traced.surface()[0];
}

/// Share of the first light that the floor (the first instance) sees at x, z.
float floorSees(Traced& traced, double x, double z) {
  traced.nodes.assign(traced.scene.scene().nodes.size(), {false, true, true, 1});
  traced.nodes[std::size_t(traced.scene.view().instances[0].node)].visible = true;
  const SurfacePoint point = below(traced, x, z);
  EXPECT_EQ(point.instance, 0u);
  return lightVisibility(traced.input(), 0, std::span(&point, 1), 1)[0];
}

/// A floor at y = 0 and squares of these materials one over the other from 1 m up.
GlbBuilder stack(const std::vector<json>& materials) {
  GlbBuilder builder;
  addSquare(builder, 5, 0);
  for (const json& material : materials) {
    const int node = addSquare(builder, 2, float(builder.json["nodes"].size()));
    builder.json["meshes"][std::size_t(node)]["primitives"][0]["material"] = builder.add("materials", material);
  }
  return builder;
}

json blended(double alpha) {
  return {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
}

TEST(Surfaces, BackFacesAreSeenOnlyWhereTheMaterialIsDoubleSided) {
  for (const bool doubleSided : {false, true}) {
    for (const bool mirrored : {false, true}) {
      GlbBuilder builder = stack({{{"doubleSided", doubleSided}}});
      if (mirrored) builder.json["nodes"][1]["scale"] = {-1, 1, 1};
      // A shear does not turn faces over.
      builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.4, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      Traced traced(builder);
      const SurfacePoint fromAbove = below(traced, 0.1, 0.2);
      EXPECT_EQ(fromAbove.instance, 1u) << "mirroring turns no face over";
      EXPECT_EQ(fromAbove.normal, glm::vec3(0, 1, 0));
      traced.camera = parallelView({0.1, -5, 0.2}, {0, 1, 0}, 1e-3);
      const SurfacePoint fromBelow = traced.surface()[0];
      EXPECT_EQ(fromBelow.instance, doubleSided ? 1u : kNoSurface) << "the floor is single sided";
      if (doubleSided) {
        EXPECT_EQ(fromBelow.normal, glm::vec3(0, -1, 0));
      }
      traced.lights = {sunAlong({0, -1, 0})};
      EXPECT_EQ(floorSees(traced, 0.1, 0.2), 0) << "either side casts";
      traced.lights = {sunAlong({0, 1, 0})};
      EXPECT_EQ(floorSees(traced, 0.1, 0.2), 0) << "turned away";
    }
  }
}

TEST(Surfaces, AMaskLeavesHolesForTheEyeAndTheLight) {
  Traced traced(SceneBundle{testing::readFile(GNOMON_TEST_SCENES "/mask_leaf.glb"), {}});
  traced.lights = {sunAlong({0, -1, 0})};
  std::array<int, 2> squares{};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double x = -0.75 + 0.5 * column;
      const double z = -0.75 + 0.5 * row;
      traced.nodes.clear();
      const bool solid = below(traced, x, z).position.y + traced.anchor().y > 1;
      EXPECT_EQ(floorSees(traced, x, z), solid ? 0 : 1);
      ++squares[solid ? 1 : 0];
    }
  }
  EXPECT_EQ(squares, (std::array{8, 8}));
}

TEST(Surfaces, AMasksCutoffIsTheMaterials) {
  for (const double cutoff : {0.2, 0.6, 1.5}) {
    json material = {{"alphaMode", "MASK"}, {"alphaCutoff", cutoff}};
    material["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 0.5}}};
    Traced traced(stack({material}));
    traced.lights = {sunAlong({0, -1, 0})};
    EXPECT_EQ(below(traced, 0, 0.1).instance, cutoff < 0.5 ? 1u : 0u) << cutoff;
    EXPECT_EQ(floorSees(traced, 0, 0.1), cutoff < 0.5 ? 0 : 1) << cutoff;
  }
}

TEST(Surfaces, BlendedCastersLetTheRestThrough) {
  Traced traced(stack({blended(0.3), blended(0.6)}));
  traced.lights = {sunAlong({0, -1, 0})};
  EXPECT_EQ(below(traced, 0.1, 0.2).instance, 2u) << "seen where alpha is at least 0.5";
  EXPECT_NEAR(floorSees(traced, 0.1, 0.2), 0.7 * 0.4, 1e-6);
  EXPECT_EQ(floorSees(traced, 3, 3), 1);
  traced.lights[0].shadow.emplace().blendedCasters = BlendedCasters::threshold;
  EXPECT_EQ(floorSees(traced, 0.1, 0.2), 0);
  Traced thin(stack({blended(0.3), blended(0.4)}));
  thin.lights = traced.lights;
  EXPECT_EQ(below(thin, 0.1, 0.2).instance, 0u);
  EXPECT_EQ(floorSees(thin, 0.1, 0.2), 1);
}

TEST(Surfaces, EachBlendedCasterIsCountedOnceWhereverRaysLead) {
  GlbBuilder builder;
  addSquare(builder, 3, 0);
  const json material = builder.add("materials", blended(0.3));
  constexpr int kStrips = 24;
  for (int i = 0; i < kStrips; ++i) {
    const float left = -2.0f + 4.0f * float(i) / kStrips;
    const float right = -2.0f + 4.0f * float(i + 1) / kStrips;
    const int node = addQuad(builder, {{left, 2, 2}, {right, 2, 2}, {right, 2, -2}, {left, 2, -2}});
    builder.json["meshes"][std::size_t(node)]["primitives"][0]["material"] = material;
  }
  Traced traced(builder);
  traced.nodes.assign(traced.scene.scene().nodes.size(), {false, true, true, 1});
  traced.nodes[0].visible = true;
  traced.camera = parallelView({0.013, 50, 0.017}, {0, -1, 0}, 2);
  for (const double radius : {0.0, 0.2}) {
    traced.lights = {testing::pointAt({0.01, 4, 0.02}, radius)};
    const std::vector<SurfacePoint> points = traced.surface();
    const std::vector<float> shares = lightVisibility(traced.input(), 0, points, 8);
    for (std::size_t i = 0; i < shares.size(); ++i) ASSERT_NEAR(shares[i], 0.7, 1e-6) << i << " of " << radius;
  }
}

TEST(Surfaces, VertexColoursBringAlpha) {
  GlbBuilder builder = stack({blended(0.5)});
  const std::vector<std::array<float, 4>> colors{{1, 1, 1, 0}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0}};
  builder.json["meshes"][1]["primitives"][0]["attributes"]["COLOR_0"] = builder.addAccessor(colors, "VEC4", 5126, 4);
  Traced traced(builder);
  traced.lights = {sunAlong({0, -1, 0})};
  for (const double x : {-1.5, 0.0, 1.0}) EXPECT_NEAR(floorSees(traced, x, 0.3), 1 - 0.5 * (x + 2) / 4, 1e-4) << x;
}

TEST(Surfaces, NodeSwitchesDecideWhoIsSeenWhoCastsAndWhoReceives) {
  Traced traced(stack({json::object()}));
  traced.lights = {sunAlong({0, -1, 0})};
  for (const bool visible : {false, true}) {
    for (const bool casts : {false, true}) {
      traced.nodes = {{}, {visible, casts, true, 1}};
      const SurfacePoint seen = below(traced, 0, 0.1);
      EXPECT_EQ(seen.instance, visible ? 1u : 0u);
      const std::vector<float> visibility = lightVisibility(traced.input(), 0, std::span(&seen, 1), 1);
      EXPECT_EQ(visibility[0], !visible && casts ? 0 : 1);
    }
  }
  traced.nodes = {{true, true, false, 1}, {false, true, true, 1}};
  const SurfacePoint floor = below(traced, 0, 0.1);
  EXPECT_EQ(lightVisibility(traced.input(), 0, std::span(&floor, 1), 1)[0], 1) << "receives none";
}

TEST(Surfaces, OnlySharedLayersAreLitAndCast) {
  Traced traced(stack({json::object()}));
  traced.lights = {sunAlong({0, -1, 0})};
  for (const int floorLayers : {1, 2}) {
    for (const int casterLayers : {1, 2}) {
      traced.nodes = {{true, true, true, floorLayers}, {false, true, true, casterLayers}};
      traced.lights[0].cullingMask = 2;
      const SurfacePoint floor = below(traced, 0, 0.1);
      EXPECT_EQ(facesLight(traced.input(), 0, std::span(&floor, 1))[0], floorLayers == 2);
      EXPECT_EQ(lightVisibility(traced.input(), 0, std::span(&floor, 1), 1)[0],
                floorLayers == 2 && casterLayers == 2 ? 0 : 1);
    }
  }
}

TEST(Surfaces, ALightWithoutShadowsIsSeenEverywhere) {
  Traced traced(stack({json::object()}));
  traced.lights = {sunAlong({0, -1, 0})};
  traced.lights[0].shadow.emplace().enabled = false;
  EXPECT_EQ(floorSees(traced, 0, 0.1), 1);
}

TEST(Surfaces, RangeAndConeSayWhereALightReaches) {
  Traced traced(stack({}));
  Light lamp = testing::pointAt({0, 2, 0});
  lamp.range = 3;
  Light spot = lamp;
  spot.type = LightType::spot;
  spot.direction = Vec3{0, -1, 0};
  spot.outerConeDegrees = 30; // 1.155 m of floor
  traced.lights = {lamp, spot};
  const auto reached = [&](int light, double x) {
    const SurfacePoint point = below(traced, x, 0);
    return facesLight(traced.input(), light, std::span(&point, 1))[0] != 0;
  };
  EXPECT_TRUE(reached(0, 2.2));
  EXPECT_FALSE(reached(0, 2.3)) << "its distance is 3.05 m";
  EXPECT_TRUE(reached(1, 1.15));
  EXPECT_FALSE(reached(1, 1.16));
}

TEST(Surfaces, ALampInACastersPlaneShinesPastIt) {
  GlbBuilder builder = stack({json::object()}); // a square at 1 m, which the lamp is set into
  Traced traced(builder);
  for (const double offset : {0.0, 1e-9}) {
    traced.lights = {testing::pointAt({0.3, 1 + offset, 0.1})};
    EXPECT_EQ(floorSees(traced, 3, 1), 1) << offset;
  }
  traced.lights = {testing::pointAt({0.3, 1.001, 0.1})};
  EXPECT_EQ(floorSees(traced, 0.2, 0.1), 0);
}

TEST(Surfaces, BlockerDistancesAreThoseToTheNearest) {
  Traced traced(stack({blended(0.3), json::object(), json::object()}));
  traced.lights = {sunAlong({3, -4, 0})};
  traced.nodes.assign(4, {false, true, true, 1});
  traced.nodes[0].visible = true;
  const std::vector<SurfacePoint> points{below(traced, 1, 0), below(traced, 4.9, 0), SurfacePoint{}};
  const std::vector<float> distances = blockerDistances(traced.input(), 0, points);
  EXPECT_NEAR(distances[0], 2 / 0.8, 1e-6) << "past the thin pane at 1 m";
  EXPECT_EQ(distances[1], std::numeric_limits<float>::infinity());
  EXPECT_EQ(distances[2], std::numeric_limits<float>::infinity());
}

} // namespace
} // namespace gnomon
