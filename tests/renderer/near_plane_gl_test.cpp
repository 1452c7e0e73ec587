// The near plane that a camera gets by itself cuts away nothing that is in view.
#include "tests/renderer/box_over_ground.h"

namespace gnomon {
namespace {

using testing::BoxOverGround;
using testing::Sight;

const glm::dvec3 kSunOverGround = glm::normalize(glm::dvec3(0.47, 0.87, 0.17));
const Json kTraced = {{"lights", {{{"direction", {-kSunOverGround.x, -kSunOverGround.y, -kSunOverGround.z}}}}},
                      {"shadow", {{"technique", "rayTraced"}}}};

TEST(NearPlane, AGroundOfAHundredKilometresIsWholeBeforeTheEye) {
  BoxOverGround scene;
  scene.ground = 50000;
  const Sight sight;
  const auto expected = testing::shownOf(scene, sight, {kSunOverGround, false});
  const auto shown = testing::shownOf(testing::shadowFrame(testing::sceneOf(scene.builder()), sight, kTraced));
  EXPECT_GT(testing::countsOf(expected).shadowed, 500);
  EXPECT_GT(testing::countsOf(expected).ground, 10000);
  EXPECT_LE(testing::differing(shown, expected), 12);
}

TEST(NearPlane, ABladeOfGrassTwoMillimetresBeforeTheEyeIsSeen) {
  for (const double ground : {0.05, 10.0, 50000.0}) {
    BoxOverGround scene;
    scene.ground = ground;
    testing::GlbBuilder builder = scene.builder();
    Json primitive = builder.json["meshes"][0]["primitives"][0];
    builder.add("materials", {{"doubleSided", true}});
    primitive["material"] = 0;
    const int mesh = builder.addMesh(primitive);
    // A square of 0.4 mm that faces the eye, 2 mm before it, seen along -z.
    builder.addMeshNode(mesh);
    builder.json["nodes"][2].update({{"scale", {2e-4, 1, 2e-4}},
                                     {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                                     {"translation", {0, 1, 5.998}}});
    Sight sight;
    sight.eye = {0, 1, 6};
    sight.target = {0, 1, 0};
    const Frame frame = testing::shadowFrame(testing::sceneOf(builder), sight, kTraced);
    const std::vector<float>& ids = testing::floatsOf(frame, 1);
    const auto pixels = std::count(ids.begin(), ids.end(), 2.0f);
    // 0.4 of 2 tan(25 degrees) * 2 = 1.865 mm: 29.2 pixels a side
    EXPECT_NEAR(static_cast<double>(pixels), 29.2 * 29.2, 70) << ground;
  }
}

TEST(NearPlane, CascadesAreNotSpentOnWhatLiesBetweenItAndTheFirstReceiver) {
  const ScenePtr scene = testing::sceneOf(BoxOverGround{}.builder());
  Json spec = kTraced;
  spec["shadow"] = {{"partition", {{"mode", "logarithmic"}, {"pssmFactor", 0}}}};
  const LightReport automatic = testing::shadowFrame(scene, Sight{}, spec).report.lights[0];
  EXPECT_GT(automatic.tiles[0].near, 1);
  spec["shadow"]["depthRange"] = {{"mode", "manual"}, {"min", 0}, {"max", 60}};
  const LightReport manual = testing::shadowFrame(scene, Sight{}, spec).report.lights[0];
  EXPECT_GT(manual.tiles[0].far, 0.04) << "the logarithm begins at a ten-thousandth of the range, not at the plane";
}

} // namespace
} // namespace gnomon
