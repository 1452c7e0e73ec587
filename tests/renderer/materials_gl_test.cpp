// What materials look like and cast, seen in rendered frames.
#include <numeric>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

/// A ground of 20 m with that material.
testing::GlbBuilder ground(const Json& material) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.add("materials", material);
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  return builder;
}

/// The picture of what lies below, as floats.
Json fromAbove(const Json& lights) {
  return {{"width", 16},
          {"height", 16},
          {"camera", {{"eye", {0, 5, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
          {"lights", lights},
          {"toneMapping", "none"},
          {"antialiasing", "none"},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

const Json kSun = Json::parse(R"([{"type":"directional","direction":[0,-1,0],"intensity":3}])");

float redOf(const ScenePtr& scene, const Json& spec) {
  const Frame frame = renderJson(scene, spec.dump());
  return testing::valueAt(frame, 0.5, 0.5);
}

TEST(MaterialFrames, WhatIsUnlitShowsItsColorWhateverTheLight) {
  const ScenePtr scene = testing::sceneOf(ground(Json::parse(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0.5,1,1]},"extensions":{"KHR_materials_unlit":{}}})")));
  for (const Json& lights : {Json::array(), kSun}) EXPECT_NEAR(redOf(scene, fromAbove(lights)), 0.25f, 1e-3f);
}

TEST(MaterialFrames, AWhiteFloorShowsTheAmbientRadiance) {
  const ScenePtr scene = testing::sceneOf(
      ground(Json::parse(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":0}})")));
  Json spec = fromAbove(Json::array());
  spec["ambient"] = {{"intensity", 0.5}};
  EXPECT_NEAR(redOf(scene, spec), 0.5f, 0.03f);
}

TEST(MaterialFrames, AMetalIsNotBlackWithoutLights) {
  const ScenePtr scene =
      testing::sceneOf(ground(Json::parse(R"({"pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.1}})")));
  EXPECT_GT(redOf(scene, fromAbove(Json::array())), 0.2f);
}

TEST(MaterialFrames, SpecularGlossinessMatchesTheSameMetalAndDielectric) {
  const std::pair<const char*, const char*> pairs[] = {
      {R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0.6,0.6,0.6,1],
           "specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.4}}})",
       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.6,0.6,0.6,1],"metallicFactor":0,"roughnessFactor":0.6}})"},
      {R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0,0,0,1],
           "specularFactor":[0.8,0.5,0.2],"glossinessFactor":0.4}}})",
       R"({"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.5,0.2,1],"metallicFactor":1,"roughnessFactor":0.6}})"}};
  for (const auto& [glossy, metallic] : pairs) {
    const float shown = redOf(testing::sceneOf(ground(Json::parse(glossy))), fromAbove(kSun));
    EXPECT_NEAR(shown, redOf(testing::sceneOf(ground(Json::parse(metallic))), fromAbove(kSun)), 0.02f * shown);
  }
}

TEST(MaterialFrames, G2_TheShadowOfGlassIsScaledByWhatItKeeps) {
  for (const double transmission : {0.25, 0.5, 1.0}) {
    testing::GlbBuilder builder = testing::plane();
    builder.json["nodes"][0]["scale"] = {10, 1, 10};
    builder.add("meshes", builder.json["meshes"][0]);
    builder.add("materials",
                {{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", transmission}}}}}});
    builder.json["meshes"][1]["primitives"][0]["material"] = 0;
    builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
    Json spec = fromAbove(kSun);
    spec["camera"]["eye"] = {0, 1, 0};
    spec["shadow"] = {{"filter", {{"type", "pcf"}, {"size", 7}}}};
    spec["views"] = {"shadow"};
    for (const char* technique : {"shadowMap", "rayTraced"}) {
      spec["shadow"]["technique"] = technique;
      const auto frame = renderJson(testing::sceneOf(builder), spec.dump());
      const auto& visibility = floatsOf(frame);
      const double mean = std::accumulate(visibility.begin(), visibility.end(), 0.0) / double(visibility.size());
      EXPECT_NEAR(mean, transmission, 0.06) << technique;
    }
  }
}

TEST(MaterialFrames, AVariantIsChosenByName) {
  testing::GlbBuilder builder = ground(Json::parse(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.25,0,0,1]},"extensions":{"KHR_materials_unlit":{}}})"));
  builder.add(
      "materials",
      Json::parse(
          R"({"pbrMetallicRoughness":{"baseColorFactor":[0.75,0,0,1]},"extensions":{"KHR_materials_unlit":{}}})"));
  builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "midday"}}, {{"name", "night"}}};
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {0}}}};
  const ScenePtr scene = testing::sceneOf(builder);
  Json spec = fromAbove(kSun);
  EXPECT_NEAR(redOf(scene, spec), 0.25f, 1e-3f);
  spec["materialVariant"] = "midday";
  EXPECT_NEAR(redOf(scene, spec), 0.75f, 1e-3f);
  spec["materialVariant"] = "night";
  EXPECT_NEAR(redOf(scene, spec), 0.25f, 1e-3f);
  spec["materialVariant"] = "dawn";
  const Problems problems = testing::refusedJson(scene, spec.dump());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].pointer, "/materialVariant");
  EXPECT_EQ(problems[0].limit, "one of midday, night");
}

} // namespace
} // namespace gnomon
