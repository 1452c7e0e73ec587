#include <numbers>

#include "renderer/image/picture_encode.h"
#include "renderer/scene/animation/posed_scene.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kLight = "/extensions/KHR_lights_punctual/lights/0";

/// A cube of a material, with a camera and a light on its node.
testing::GlbBuilder lit(json light, json material = json::object()) {
  testing::GlbBuilder builder = testing::cube();
  builder.add("materials", std::move(material));
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 10}}}});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {std::move(light)};
  builder.json["nodes"][0]["camera"] = 0;
  builder.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  return builder;
}

Result<std::shared_ptr<const Scene>> posedAt(const testing::GlbBuilder& builder, double seconds) {
  const auto scene = std::make_shared<const Scene>(load(builder));
  EXPECT_THAT(scene->summary.warnings, IsEmpty());
  AnimationMoment moment;
  moment.index = 0;
  moment.timeSeconds = seconds;
  return posedScene(scene, {moment});
}

TEST(MovedProperties, LightsChangeAndKeepTheirPlace) {
  testing::GlbBuilder builder = lit({{"type", "spot"}, {"intensity", 8}, {"spot", {{"outerConeAngle", 0.5}}}});
  builder.json["nodes"][0]["translation"] = {1, 2, 3};
  animatePointer(builder, std::string(kLight) + "/color", {0, 1}, {1, 1, 1, 1, 0, 0.5f}, "VEC3");
  animatePointer(builder, std::string(kLight) + "/spot/outerConeAngle", {0, 1}, {0.5f, 1}, "SCALAR");
  animatePointer(builder, std::string(kLight) + "/range", {0, 1}, {4, 6}, "SCALAR");
  const auto posed = posedAt(builder, 0.5);
  ASSERT_TRUE(posed);
  const Light& light = (*posed)->scenes[0].lights.at(0).light;
  EXPECT_EQ(*light.color, (Vec3{1, 0.5, 0.75}));
  EXPECT_EQ(light.intensity, 8);
  EXPECT_EQ(light.range, 5);
  EXPECT_NEAR(light.outerConeDegrees, 0.75 * 180 / std::numbers::pi, 1e-6);
  EXPECT_EQ(*light.position, (Vec3{1, 2, 3}));
}

TEST(MovedProperties, CamerasZoom) {
  testing::GlbBuilder builder = lit({{"type", "point"}});
  animatePointer(builder, "/cameras/0/perspective/yfov", {0, 1}, {1, 2}, "SCALAR");
  const auto posed = posedAt(builder, 0.25);
  ASSERT_TRUE(posed);
  const SceneCamera& camera = (*posed)->scenes[0].cameras.at(0);
  EXPECT_NEAR(camera.perspective->fovYDegrees, 1.25 * 180 / std::numbers::pi, 1e-6);
  EXPECT_EQ(camera.perspective->far, 10);
}

TEST(MovedProperties, MaterialsAreRepaintedWithTheTexturesThatTheyHave) {
  testing::GlbBuilder builder = lit({{"type", "point"}}, json::parse(R"({"emissiveFactor": [1, 1, 0.5],
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}},
        "normalTexture": {"index": 0, "scale": 0.5, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0]}}}})"));
  const Image pixel{1, 1, {"R", "G", "B"}, std::vector<std::uint8_t>(3, 255)};
  builder.add("images", {{"bufferView", builder.addView(*encodePng(pixel, 1))}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  animatePointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 1}, {0, 0, 0, 1, 1, 1, 1, 1},
                 "VEC4");
  animatePointer(builder, "/materials/0/extensions/KHR_materials_emissive_strength/emissiveStrength", {0, 1}, {2, 4},
                 "SCALAR");
  animatePointer(builder, "/materials/0/normalTexture/extensions/KHR_texture_transform/offset", {0, 1},
                 {0.25f, 0, 0.75f, 1}, "VEC2");
  const auto posed = posedAt(builder, 0.5);
  ASSERT_TRUE(posed);
  const Material& material = (*posed)->materials[0];
  EXPECT_EQ(material.baseColorFactor, glm::vec4(0.5f, 0.5f, 0.5f, 1));
  EXPECT_EQ(material.emissiveFactor, glm::vec3(3, 3, 1.5f));
  EXPECT_EQ(material.normalScale, 0.5f);
  ASSERT_TRUE(material.normal);
  EXPECT_EQ(material.normal->image, 0);
  EXPECT_EQ(material.normal->transform->offset, glm::vec2(0.5f));
  EXPECT_EQ((*posed)->materials.size(), 2u) << "and the default material";
}

TEST(MovedProperties, ASplineIsHeldAtTheEndOfARange) {
  testing::GlbBuilder builder = lit({{"type", "point"}});
  animatePointer(builder, "/materials/0/pbrMetallicRoughness/roughnessFactor", {0, 1}, {0, 1, 8, 0, 1, 0}, "SCALAR",
                 "CUBICSPLINE");
  const auto posed = posedAt(builder, 0.5);
  ASSERT_TRUE(posed);
  EXPECT_EQ((*posed)->materials[0].roughnessFactor, 1);
}

TEST(MovedProperties, MembersThatNoLongerFitEachOtherAreAProblem) {
  testing::GlbBuilder cone = lit({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.4}, {"outerConeAngle", 0.5}}}});
  animatePointer(cone, std::string(kLight) + "/spot/outerConeAngle", {0, 1}, {0.5f, 0.1f}, "SCALAR");
  testing::GlbBuilder planes = lit({{"type", "point"}});
  animatePointer(planes, "/cameras/0/perspective/znear", {0, 1}, {1, 50}, "SCALAR");
  testing::GlbBuilder nothing = lit({{"type", "point"}});
  animatePointer(nothing, "/cameras/0/perspective/znear", {0, 1}, {0, 1, -8, 0, 1, 0}, "SCALAR", "CUBICSPLINE");
  for (const auto& [builder, seconds] : {std::pair(cone, 0.9), std::pair(planes, 0.9), std::pair(nothing, 0.3)}) {
    EXPECT_TRUE(posedAt(builder, 0));
    const auto posed = posedAt(builder, seconds);
    ASSERT_FALSE(posed);
    EXPECT_EQ(posed.problems()[0].pointer, "/animation");
    EXPECT_THAT(posed.problems()[0].detail, HasSubstr("glTF does not allow"));
  }
}

TEST(MovedProperties, VisibilityHidesWhatIsBelowANode) {
  testing::GlbBuilder builder = lit({{"type", "point"}});
  builder.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
  builder.json["scenes"][0]["nodes"] = {1};
  builder.add("nodes", {{"children", {0}}});
  const std::vector<std::uint8_t> own{0, 1};
  const std::vector<std::uint8_t> above{1, 0};
  addChannel(builder, pointerTarget("/nodes/0/extensions/KHR_node_visibility/visible"), {0, 1},
             builder.addAccessor(own, "SCALAR", 5121, 2), "STEP");
  addChannel(builder, pointerTarget("/nodes/1/extensions/KHR_node_visibility/visible"), {0, 2},
             builder.addAccessor(above, "SCALAR", 5121, 2), "STEP");
  const Scene rest = load(builder);
  EXPECT_THAT(rest.scenes[0].instances, IsEmpty());
  EXPECT_THAT(rest.scenes[0].lights, IsEmpty());
  for (const double seconds : {0.0, 1.0, 1.9, 2.0}) {
    const auto posed = posedAt(builder, seconds);
    ASSERT_TRUE(posed);
    const SceneView& view = (*posed)->scenes[0];
    const std::size_t shown = seconds >= 1 && seconds < 2 ? 1 : 0;
    EXPECT_EQ(view.instances.size(), shown) << seconds;
    EXPECT_EQ(view.lights.size(), shown) << seconds;
    EXPECT_EQ(view.cameras.size(), 1u) << "a camera sees, whether or not it is seen";
    EXPECT_EQ(view.bounds.empty(), shown == 0);
  }
}

} // namespace
} // namespace gnomon
