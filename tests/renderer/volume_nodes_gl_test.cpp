// Volumes at nodes of the scene: where these are, and seen as they are.
#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_grids.h"
#include "tests/renderer/scene/animation/animated.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr int kCarrier = 2;

/// A ground of 100 m, and "carrier", below "convoy", which in two seconds moves from 0, 0, 0 to 16, 8, -16 and grows to
/// three times its size. "parked" is not visible in the file.
ScenePtr convoy() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  builder.addRoot({{"name", "convoy"}, {"translation", {-8, 0, 8}}, {"children", {kCarrier}}});
  builder.add("nodes", {{"name", "carrier"}});
  builder.addRoot({{"name", "parked"}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  builder.json["extensionsUsed"] = {"KHR_node_visibility"};
  animate(builder, kCarrier, "translation", {0, 2}, {0, 0, 0, 16, 8, -16}, "VEC3");
  animate(builder, kCarrier, "scale", {0, 2}, {1, 1, 1, 3, 3, 3}, "VEC3");
  SceneBundle bundle = builder.bundle();
  bundle.files["hill.npy"] = testing::byteGrid(6, 5, 4, [](int x, int y, int z) { return 40 * x + 8 * y + 5 * z; });
  return testing::sceneOf(bundle);
}

Json cloud(const Json& place) {
  Json volume{{"file", "hill.npy"},
              {"transferFunction",
               {{{"value", 0}, {"extinction", 0}}, {{"value", 255}, {"color", {1, 0.5, 0.25}}, {"extinction", 0.6}}}}};
  volume.update(place);
  return volume;
}

const Json kBox{{"min", {-4, 3, -4}}, {"max", {4, 5, 2}}};

Json specOf(const std::vector<Json>& volumes, double seconds = 1) {
  return {
      {"width", 64},
      {"height", 64},
      {"camera", {{"eye", {0, 40, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 60}}}}},
      {"lights", {{{"type", "directional"}, {"direction", {0.25, -1, 0}}}}},
      {"antialiasing", "none"},
      {"animation", {{"name", "Move"}, {"timeSeconds", seconds}}},
      {"volumes", volumes},
      {"views", {"color", "shadow"}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

void expectSame(const Frame& one, const Frame& other) {
  for (std::size_t view = 0; view < 2; ++view) EXPECT_EQ(floatsOf(one, view), floatsOf(other, view)) << view;
}

TEST(VolumeNodes, AnAnimationMovesAVolumeAsItsPlaceInTheWorldWould) {
  const ScenePtr scene = convoy();
  // At one second the carrier stands at 0, 4, 0, twice as large.
  const Frame there =
      renderJson(scene, specOf({cloud({{"box", {{"min", {-8, 10, -8}}, {"max", {8, 14, 4}}}}})}).dump());
  for (const Json& node : {Json("carrier"), Json(kCarrier)}) {
    expectSame(renderJson(scene, specOf({cloud({{"node", node}, {"box", kBox}})}).dump()), there);
  }
  const Json matrix{8, 0, 0, 0, 0, 2, 0, 0, 0, 0, 6, 0, -4, 3, -4, 1};
  expectSame(renderJson(scene, specOf({cloud({{"node", "carrier"}, {"matrix", matrix}})}).dump()), there);
  const Frame earlier = renderJson(scene, specOf({cloud({{"node", "carrier"}, {"box", kBox}})}, 0.5).dump());
  EXPECT_NE(floatsOf(earlier), floatsOf(there));
}

TEST(VolumeNodes, WithoutAPlaceOfItsOwnItFillsTheNodesUnitCube) {
  const ScenePtr scene = convoy();
  const Json unit{{"min", {0, 4, 0}}, {"max", {2, 6, 2}}};
  expectSame(renderJson(scene, specOf({cloud({{"node", "carrier"}})}).dump()),
             renderJson(scene, specOf({cloud({{"box", unit}})}).dump()));
}

TEST(VolumeNodes, D2_SwitchesOfItsNodeAndOfThoseAboveHideIt) {
  const ScenePtr scene = convoy();
  const std::vector<Json> volumes{cloud({{"node", "carrier"}, {"box", kBox}})};
  const auto with = [&](const Json& switches) {
    Json spec = specOf(volumes);
    spec["nodes"] = {{{"node", "convoy"}}};
    spec["nodes"][0].update(switches);
    return renderJson(scene, spec.dump());
  };
  const Frame none = renderJson(scene, specOf({}).dump());
  const Frame seen = with({{"visible", true}});
  EXPECT_NE(floatsOf(seen), floatsOf(none));
  const Frame hidden = with({{"visible", false}});
  expectSame(hidden, none);
  ASSERT_EQ(hidden.report.volumes.size(), 1u);
  EXPECT_EQ(hidden.report.volumes[0].voxels, (std::array{0, 0, 0}));

  const Frame unseen = with({{"visible", false}, {"castShadow", true}});
  EXPECT_EQ(floatsOf(unseen, 1), floatsOf(seen, 1));
  EXPECT_NE(floatsOf(unseen, 0), floatsOf(seen, 0));
  EXPECT_NE(floatsOf(unseen, 0), floatsOf(none, 0));
  const Frame shadowless = with({{"castShadow", false}});
  EXPECT_EQ(floatsOf(shadowless, 1), floatsOf(none, 1));
  EXPECT_NE(floatsOf(shadowless, 0), floatsOf(none, 0));
}

TEST(VolumeNodes, WhatTheFileHidesIsNotThere) {
  const ScenePtr scene = convoy();
  const Frame none = renderJson(scene, specOf({}).dump());
  expectSame(renderJson(scene, specOf({cloud({{"node", "parked"}, {"box", kBox}})}).dump()), none);
  const Json other = cloud({{"box", kBox}});
  const Frame two = renderJson(scene, specOf({cloud({{"node", "parked"}, {"box", kBox}}), other}).dump());
  expectSame(two, renderJson(scene, specOf({other}).dump()));
  ASSERT_EQ(two.report.volumes.size(), 2u);
  EXPECT_EQ(two.report.volumes[0].voxels, (std::array{0, 0, 0}));
  EXPECT_EQ(two.report.volumes[1].voxels, (std::array{6, 5, 4}));
  EXPECT_EQ(two.report.volumes[1].values, (std::array{0.0, 247.0}));
}

TEST(VolumeNodes, D5_LightIsMadeAnewWhereItsNodeHasMoved) {
  const ScenePtr scene = convoy();
  const auto reused = [&](double seconds) {
    const std::vector<Json> volumes{cloud({{"node", "carrier"}, {"box", kBox}})};
    return renderJson(scene, specOf(volumes, seconds).dump()).report.volumes.at(0).reused;
  };
  EXPECT_FALSE(reused(0.25));
  EXPECT_TRUE(reused(0.25));
  EXPECT_FALSE(reused(0.75));
}

} // namespace
} // namespace gnomon
