// What materials look like and cast, seen in rendered frames.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "renderer/image/picture_encode.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/tone_curves.h"
#include "tests/support/webp_builder.h"

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

/// As bytes, at default settings but for these.
std::array<int, 3> shownBytes(const ScenePtr& scene, Json settings) {
  settings["width"] = settings["height"] = 16;
  settings["camera"] = {{"eye", {0, 5, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}};
  settings["lights"] = kSun;
  const Frame frame = renderJson(scene, settings.dump());
  const auto& pixels = std::get<std::vector<std::uint8_t>>(frame.images[0].image.pixels);
  const std::size_t middle = pixels.size() / 256 * (8 * 16 + 8);
  return {pixels[middle], pixels[middle + 1], pixels[middle + 2]};
}

TEST(MaterialFrames, WhatGlowsIsToneMappedAsPublished) {
  for (const std::array<double, 3>& glow :
       {std::array{0.9, 0.9, 0.9}, std::array{0.18, 0.18, 0.18}, std::array{0.7, 0.02, 0.01}, std::array{0.0, 0.0, 0.0},
        std::array{0.6, 0.35, 0.25}, std::array{0.03, 0.5, 1.0}}) {
    const ScenePtr scene =
        testing::sceneOf(ground({{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 1}}},
                                 {"emissiveFactor", glow}}));
    for (const auto& [word, tone] : {std::pair{"neutral", ToneMapping::neutral}, std::pair{"agx", ToneMapping::agx},
                                     std::pair{"none", ToneMapping::none}}) {
      for (const double exposure : {0.0, 2.0}) {
        const std::array<int, 3> shown =
            shownBytes(scene, {{"toneMapping", word}, {"exposure", exposure}, {"ambient", {{"intensity", 0}}}});
        const glm::dvec3 expected =
            testing::publishedTone(tone, glm::dvec3(glow[0], glow[1], glow[2]) * std::exp2(exposure));
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(shown[static_cast<std::size_t>(i)], testing::srgbByte(expected[i]), 1)
              << word << " " << exposure << " " << glow[0] << " channel " << i;
      }
    }
  }
}

TEST(MaterialFrames, WhatIsUnlitShowsItsColorAsItIsPastExposureAndToneMapping) {
  const ScenePtr scene = testing::sceneOf(ground(Json::parse(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[1,0.21763764,0,1]},"extensions":{"KHR_materials_unlit":{}}})")));
  const std::array<int, 3> orange{255, 128, 0};
  for (const char* settings : {"{}", R"({"exposure":2})", R"({"exposure":-3,"toneMapping":"none"})",
                               R"({"antialiasing":"none"})", R"({"toneMapping":"none"})"}) {
    EXPECT_EQ(shownBytes(scene, Json::parse(settings)), orange) << settings;
  }
  Json spec = fromAbove(kSun);
  spec["exposure"] = 4;
  EXPECT_NEAR(redOf(scene, spec), 1.0f, 1e-3f) << "in linear numbers, too";
}

TEST(MaterialFrames, AWhiteFloorShowsTheAmbientRadiance) {
  const ScenePtr scene = testing::sceneOf(
      ground(Json::parse(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1],"metallicFactor":0}})")));
  Json spec = fromAbove(Json::array());
  spec["ambient"] = {{"intensity", 0.5}};
  EXPECT_NEAR(redOf(scene, spec), 0.5f, 0.03f);
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

/// A ground that shows a texture of 4 x 4 colors at these corners' coordinates, in the order of testing::plane().
testing::GlbBuilder pictured(const std::array<glm::dvec2, 4>& corners, const Json& transform) {
  testing::GlbBuilder builder = ground({{"extensions", {{"KHR_materials_unlit", Json::object()}}}});
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 16; ++i) {
    for (const int step : {17, 53, 91}) texels.push_back(static_cast<std::uint8_t>(i * step % 256));
  }
  const Image image{4, 4, {"R", "G", "B"}, texels};
  builder.add("images", {{"bufferView", builder.addView(*encodePng(image, 1))}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"extensions", transform}};
  std::vector<glm::vec2> coordinates(corners.begin(), corners.end());
  builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      builder.addAccessor(coordinates, "VEC2", 5126, coordinates.size());
  return builder;
}

/// KHR_texture_transform's own formula: translation * rotation * scale, for a picture with v downwards.
TEST(MaterialFrames, TexturesAreLaidAsTheirTransformSays) {
  const double angle = 0.4;
  const glm::dvec2 scale(1.5, -0.75);
  const glm::dvec2 offset(0.2, 0.6);
  const std::array<glm::dvec2, 4> plain{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::array<glm::dvec2, 4> moved{};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec2 scaled = plain[i] * scale;
    moved[i] = offset + glm::dvec2(std::cos(angle) * scaled.x + std::sin(angle) * scaled.y,
                                   -std::sin(angle) * scaled.x + std::cos(angle) * scaled.y);
  }
  Json transform;
  transform["KHR_texture_transform"] = {
      {"offset", {offset.x, offset.y}}, {"rotation", angle}, {"scale", {scale.x, scale.y}}};
  Json spec = fromAbove(Json::array());
  spec["camera"]["eye"] = {0, 20, 0};
  const auto pictureOf = [&](const testing::GlbBuilder& builder) {
    return floatsOf(renderJson(testing::sceneOf(builder), spec.dump()));
  };
  const std::vector<float> shown = pictureOf(pictured(plain, transform));
  const std::vector<float> wanted = pictureOf(pictured(moved, Json::object()));
  ASSERT_EQ(shown.size(), wanted.size());
  for (std::size_t i = 0; i < shown.size(); ++i) ASSERT_NEAR(shown[i], wanted[i], 4e-3) << i;
  EXPECT_NE(shown, pictureOf(pictured(plain, Json::object())));
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

TEST(MaterialFrames, ATextureInWebpLooksAndCastsLikeTheSamePng) {
  constexpr int kSide = 8;
  Bytes rgba;
  for (int i = 0; i < kSide * kSide; ++i) {
    for (const int value : {20 + 3 * i, 250 - 2 * i, 128, i % 3 == 0 ? 0 : 200}) {
      rgba.push_back(static_cast<std::uint8_t>(value));
    }
  }
  const auto frameOf = [&](const Bytes& image, const Json& texture) {
    testing::GlbBuilder builder = ground(Json::parse(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"alphaMode":"MASK","doubleSided":true})"));
    builder.add("images", {{"bufferView", builder.addView(image)}});
    builder.add("textures", texture);
    builder.addRoot({{"mesh", 0}, {"translation", {0, 2, 0}}});
    Json spec = fromAbove(kSun);
    spec["views"] = {"color", "shadow"};
    return renderJson(testing::sceneOf(builder), spec.dump());
  };
  const auto png = encodePng({kSide, kSide, {"R", "G", "B", "A"}, rgba}, 1);
  ASSERT_TRUE(png);
  const Frame expected = frameOf(*png, {{"source", 0}});
  const Frame frame =
      frameOf(testing::losslessWebp(kSide, kSide, rgba), {{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}});
  for (const std::size_t view : {0u, 1u}) EXPECT_EQ(floatsOf(frame, view), floatsOf(expected, view));
  const auto [least, most] = std::minmax_element(floatsOf(frame).begin(), floatsOf(frame).end());
  EXPECT_GT(*most, 2 * *least) << "the texture is seen";
}

TEST(MaterialFrames, ATextureIsReadAtTheCoordinatesThatItNames) {
  const auto png = encodePng({2, 1, {"R", "G", "B"}, Bytes{51, 51, 51, 204, 204, 204}}, 1);
  ASSERT_TRUE(png);
  const auto shownWith = [&](int texCoord) {
    testing::GlbBuilder builder = ground(Json::parse(
        R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}},"extensions":{"KHR_materials_unlit":{}}})"));
    builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = texCoord;
    builder.add("images", {{"bufferView", builder.addView(*png)}});
    builder.add("samplers", {{"magFilter", 9728}, {"minFilter", 9728}});
    builder.add("textures", {{"source", 0}, {"sampler", 0}});
    for (const int set : {0, 1, 2, 3}) {
      const std::vector<float> corners(8, set == 2 ? 0.75f : 0.25f); // the bright texel, and the dark one
      builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_" + std::to_string(set)] =
          builder.addAccessor(corners, "VEC2", 5126, 4);
    }
    return redOf(testing::sceneOf(builder), fromAbove(Json::array()));
  };
  for (const int set : {0, 1, 3}) EXPECT_NEAR(shownWith(set), 0.0331f, 2e-3f) << set;
  EXPECT_NEAR(shownWith(2), 0.6038f, 4e-3f);
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
