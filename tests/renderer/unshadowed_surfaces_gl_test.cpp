// What receives no shadow decides nothing about the shadows of the rest, however large or near it is.
#include "tests/renderer/box_over_ground.h"

namespace gnomon {
namespace {

using testing::BoxOverGround;
using testing::Sight;

const glm::dvec3 kSunOverBox = glm::normalize(glm::dvec3(0.47, 0.87, 0.17));

Json sun() {
  return {{"type", "directional"}, {"direction", {-kSunOverBox.x, -kSunOverBox.y, -kSunOverBox.z}}, {"cullingMask", 1}};
}
Json lamp() {
  return {{"type", "point"}, {"position", {2, 9, 1}}, {"intensity", 300}, {"cullingMask", 1}};
}
Json spotLamp() {
  Json spot = lamp();
  spot.update({{"type", "spot"}, {"direction", {-0.2, -1, -0.1}}, {"outerConeDegrees", 50}});
  return spot;
}

/// With a cube around it all, node 2, `shell` metres to each side, seen from inside; 0 = without.
ScenePtr within(double shell, bool unlit) {
  testing::GlbBuilder builder = BoxOverGround{}.builder();
  if (shell > 0) {
    Json material = {{"doubleSided", true}};
    if (unlit) material["extensions"] = {{"KHR_materials_unlit", Json::object()}};
    builder.json["extensionsUsed"] = {"KHR_materials_unlit"};
    const int index = builder.add("materials", material);
    Json primitive = builder.json["meshes"][1]["primitives"][0];
    const auto r = static_cast<float>(shell);
    primitive["attributes"]["POSITION"] = builder.addPoints(
        {{-r, -r, -r}, {r, -r, -r}, {-r, r, -r}, {r, r, -r}, {-r, -r, r}, {r, -r, r}, {-r, r, r}, {r, r, r}});
    primitive["material"] = index;
    builder.addMeshNode(builder.addMesh(primitive));
  }
  return testing::sceneOf(builder);
}

struct Way {
  const char* name;
  bool unlit;
  Json switches;
};

const std::vector<Way>& waysToReceiveNothing() {
  static const std::vector<Way> ways{
      {"unlit", true, {{"node", 2}, {"castShadow", false}}},
      {"receiveShadow false", false, {{"node", 2}, {"castShadow", false}, {"receiveShadow", false}}},
      {"another layer", false, {{"node", 2}, {"layers", 2}}},
  };
  return ways;
}

void expectAsWithout(const Json& light, const testing::Source& source, const Json& shadow) {
  const Sight sight;
  const Json spec = {{"lights", {light}}, {"shadow", shadow}};
  const Frame alone = testing::shadowFrame(within(0, false), sight, spec);
  const auto expected = testing::shownOf(BoxOverGround{}, sight, source);
  EXPECT_LE(testing::differing(testing::shownOf(alone), expected), 120) << light;
  EXPECT_GT(testing::countsOf(expected).shadowed, 500);
  for (const Way& way : waysToReceiveNothing()) {
    Json with = spec;
    with["nodes"] = {way.switches};
    const Frame frame = testing::shadowFrame(within(10000, way.unlit), sight, with);
    EXPECT_LE(testing::differing(testing::shownOf(frame), testing::shownOf(alone)), 12) << way.name << light << shadow;
    const LightReport& a = alone.report.lights[0];
    const LightReport& b = frame.report.lights[0];
    ASSERT_EQ(a.tiles.size(), b.tiles.size());
    for (std::size_t i = 0; i < a.tiles.size(); ++i) {
      ASSERT_EQ(a.tiles[i].matrix.has_value(), b.tiles[i].matrix.has_value()) << way.name << i;
      EXPECT_NEAR(b.tiles[i].texelSize[0], a.tiles[i].texelSize[0], 0.05 * a.tiles[i].texelSize[0]) << way.name << i;
      EXPECT_NEAR(b.tiles[i].far, a.tiles[i].far, 0.01 * a.tiles[i].far) << way.name << i;
    }
    ASSERT_TRUE(a.predictedError && b.predictedError) << way.name;
    EXPECT_NEAR(b.predictedError->max, a.predictedError->max, 0.05 * a.predictedError->max) << way.name << light;
    EXPECT_GT(frame.report.depthRange[1], 9000) << "all that is seen";
  }
}

TEST(UnshadowedSurfaces, AShellDoesNotCoarsenTheCascadesOfASun) {
  for (const Json& shadow : {Json::object(), Json{{"filter", {{"type", "hard"}}}, {"cascadeCount", 1}}}) {
    expectAsWithout(sun(), {kSunOverBox, false}, shadow);
  }
}

TEST(UnshadowedSurfaces, AShellDoesNotCoarsenTheFacesOfSpotsAndPoints) {
  for (const Json& light : {lamp(), spotLamp()}) expectAsWithout(light, {{2, 9, 1}, true}, Json::object());
}

TEST(UnshadowedSurfaces, LightsOfOtherLayersHaveReceiversOfTheirOwn) {
  const Sight sight;
  Json far = sun();
  far["cullingMask"] = 2;
  const Json spec = {{"lights", {sun(), far}}, {"nodes", {{{"node", 2}, {"layers", 2}}}}};
  const Frame frame = testing::shadowFrame(within(10000, false), sight, spec);
  EXPECT_LT(frame.report.lights[0].tiles.back().far, 200);
  EXPECT_GT(frame.report.lights[1].tiles.back().far, 9000);
}

TEST(UnshadowedSurfaces, WhereNothingInViewReceivesNothingIsDrawn) {
  Sight up;
  up.target = up.eye + glm::dvec3(0.1, 1, 0.1);
  const Json spec = {{"lights", {sun()}}, {"nodes", {waysToReceiveNothing()[0].switches}}};
  const Frame frame = testing::shadowFrame(within(1000, true), up, spec);
  EXPECT_TRUE(frame.report.lights[0].tiles.empty());
  EXPECT_EQ(frame.report.lights[0].note, "nothing in view receives its shadow");
}

} // namespace
} // namespace gnomon
