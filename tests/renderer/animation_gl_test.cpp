// A frame shows the scene as its animation has it, and so do the shadows, the plan and the rays.
#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::sceneOf;
using testing::valueAt;

/// A ground of 20 by 20 m seen from straight above, and a cube 3 m over it that flies from x = -6 to x = 6 within two
/// seconds. Seen from above and lit at 45 degrees from -X, its shadow lies 4 m further towards +X.
ScenePtr flight() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.addMeshNode(testing::addCube(builder));
  builder.json["nodes"][1]["translation"] = {-6, 4, 0};
  animate(builder, 1, "translation", {0, 2}, {-6, 4, 0, 6, 4, 0}, "VEC3");
  return sceneOf(builder);
}

Json specOf(const std::vector<std::string>& views) {
  return {{"width", 96},
          {"height", 96},
          {"camera",
           {{"eye", {0, 30, 0}},
            {"target", {0, 0, 0}},
            {"up", {0, 0, -1}},
            {"orthographic", {{"height", 20}, {"far", 60}}}}},
          {"lights", {{{"type", "directional"}, {"direction", {1, -1, 0}}}}},
          {"antialiasing", "none"},
          {"views", views},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

Json atTime(Json spec, double seconds) {
  spec["animation"] = {{"name", "Move"}, {"timeSeconds", seconds}};
  return spec;
}

/// A place of the ground as a share of the picture's width.
double across(double x) {
  return (x + 10) / 20;
}

TEST(AnimatedFrames, AShadowFollowsWhatThrowsIt) {
  const ScenePtr scene = flight();
  for (const double seconds : {0.0, 0.5, 0.75}) {
    const double x = -6 + 6 * seconds;
    const Frame frame = renderJson(scene, atTime(specOf({"shadow", "depth"}), seconds).dump());
    EXPECT_NEAR(valueAt(frame, across(x), 0.5, 1), 25, 0.1) << "the cube's top, at " << seconds << " s";
    EXPECT_EQ(valueAt(frame, across(x + 4), 0.5), 0) << "its shadow";
    EXPECT_NEAR(valueAt(frame, across(x + 7), 0.5), 1, 1e-3) << "ahead of it";
    EXPECT_NEAR(valueAt(frame, across(x - 2), 0.5), 1, 1e-3) << "where it came from";
  }
}

TEST(AnimatedFrames, WithoutAnAnimationAFrameShowsTheRestPose) {
  const ScenePtr scene = flight();
  const Json spec = specOf({"shadow"});
  const std::vector<float> rest = floatsOf(renderJson(scene, spec.dump()));
  EXPECT_EQ(floatsOf(renderJson(scene, atTime(spec, 0).dump())), rest);
  EXPECT_NE(floatsOf(renderJson(scene, atTime(spec, 1).dump())), rest);
  EXPECT_EQ(floatsOf(renderJson(scene, spec.dump())), rest) << "poses leave nothing behind";
  EXPECT_EQ(floatsOf(renderJson(scene, atTime(spec, 7).dump())), floatsOf(renderJson(scene, atTime(spec, 2).dump())));
}

/// A ground that shows its color, which fades from red to green, and from blue to black in the variant "night".
ScenePtr fading() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  for (int i = 0; i < 2; ++i) builder.add("materials", {{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  auto& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "night"}}};
  primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {0}}}};
  animatePointer(builder, "/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 2}, {1, 0, 0, 1, 0, 1, 0, 1},
                 "VEC4");
  animatePointer(builder, "/materials/1/pbrMetallicRoughness/baseColorFactor", {0, 2}, {0, 0, 1, 1, 0, 0, 0, 1},
                 "VEC4");
  return sceneOf(builder);
}

TEST(AnimatedFrames, PointersMoveMaterialsAlsoThoseOfVariants) {
  const ScenePtr scene = fading();
  Json spec = specOf({"color"});
  spec["toneMapping"] = "none";
  for (const double seconds : {0.0, 0.5, 2.0}) {
    const auto fade = static_cast<float>(seconds / 2);
    const auto day = floatsOf(renderJson(scene, atTime(spec, seconds).dump()));
    EXPECT_NEAR(day[0], 1 - fade, 2e-3) << seconds;
    EXPECT_NEAR(day[1], fade, 2e-3) << seconds;
    Json variant = atTime(spec, seconds);
    variant["materialVariant"] = "night";
    const auto night = floatsOf(renderJson(scene, variant.dump()));
    EXPECT_NEAR(night[0], 0, 2e-3) << seconds;
    EXPECT_NEAR(night[2], 1 - fade, 2e-3) << seconds;
  }
}

TEST(AnimatedFrames, APlanIsOfThePose) {
  const ScenePtr scene = flight();
  const RendererInfo& device = testing::sharedRenderer().info();
  const auto castersAt = [&](double seconds) {
    Json json = atTime(specOf({"shadow"}), seconds);
    json["camera"]["target"] = {6, 0, 0};
    json["camera"]["eye"] = {6, 30, 0};
    json["camera"]["orthographic"]["height"] = 2;
    const auto plan = planFrame(scene, *decodeFrameSpec(testing::withMaps(json).dump()), device);
    EXPECT_TRUE(plan);
    return plan ? plan->lights.at(0).casterTriangles : 0;
  };
  EXPECT_LT(castersAt(0), castersAt(1.333)) << "far from what is seen, and then casting on it";
}

} // namespace
} // namespace gnomon
