#include "renderer/passes/shader_variants.h"

#include <gmock/gmock.h>

#include "renderer/device/shader_data.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon {
namespace {

using ::testing::Contains;
using ::testing::Not;

TEST(ShaderVariants, APlainMaterialAsksForNoTexture) {
  for (const std::string& define : surfaceProgram(Material{}, {}).defines) {
    EXPECT_EQ(define.find("TEXTURE"), std::string::npos) << define;
  }
}

TEST(ShaderVariants, OnlyTheCoordinatesThatATextureReadsAreInterpolated) {
  Material material;
  material.normal = TextureUse{1, 1};
  const auto defines = surfaceProgram(material, {}).defines;
  EXPECT_THAT(defines, Contains("NORMAL_TEXTURE"));
  EXPECT_THAT(defines, Contains("NORMAL_TEXEL(map) texture(map, surface.uv1)"));
  EXPECT_THAT(defines, Contains("UV1"));
  EXPECT_THAT(defines, Not(Contains("UV0")));
}

TEST(ShaderVariants, G2_AMaskIsCutForEyeAndLight) {
  Material material;
  material.cutoff = 0.5f;
  material.baseColor = TextureUse{0};
  for (const auto& defines : {surfaceProgram(material, {}).defines, maskDefines(&material)}) {
    EXPECT_THAT(defines, Contains("ALPHA_MASK"));
    EXPECT_THAT(defines, Contains("BASE_COLOR_TEXTURE"));
  }
  EXPECT_TRUE(maskDefines(nullptr).empty());
}

TEST(ShaderVariants, X34_OnlyTheShadowOfABlendedMaterialIsDithered) {
  Material material;
  material.cutoff = 0.5f;
  material.lightOpacity = 1.0f;
  EXPECT_THAT(castProgram(&material, BlendedCasters::dither).defines, Contains("ALPHA_DITHER"));
  EXPECT_THAT(castProgram(&material, BlendedCasters::threshold).defines, Not(Contains("ALPHA_DITHER")));
  EXPECT_THAT(depthProgram("survey.vert", &material).defines, Not(Contains("ALPHA_DITHER")));
  EXPECT_THAT(surfaceProgram(material, {}).defines, Contains("ALPHA_MASK"));
  material.lightOpacity.reset();
  EXPECT_THAT(castProgram(&material, BlendedCasters::dither).defines, Not(Contains("ALPHA_DITHER")));
  EXPECT_TRUE(castProgram(nullptr, BlendedCasters::dither).defines.empty());
}

TEST(ShaderVariants, WhereNothingGlowsNoEmissionIsWritten) {
  EXPECT_THAT(surfaceProgram(Material{}, {}).defines, Not(Contains("EMISSION")));
  EXPECT_THAT(surfaceProgram(Material{}, {.emission = true}).defines, Contains("EMISSION"));
  EXPECT_THAT(viewProgram({}).defines, Not(Contains("EMISSION")));
  EXPECT_THAT(viewProgram({.emission = true}).defines, Contains("EMISSION"));
}

TEST(ShaderVariants, N5_WhatLightMapsSayIsWrittenBehindWhatMaterialsGiveOff) {
  EXPECT_THAT(surfaceProgram(Material{}, {}).defines, Not(Contains(::testing::StartsWith("BAKED"))));
  const auto dark = surfaceProgram(Material{}, {.numbered = true, .bakedLights = 3}).defines;
  EXPECT_THAT(dark, ::testing::IsSupersetOf({"BAKED_LIGHTS 3", "BAKED_SHARES 1", "TRIANGLE_NUMBERS 2"}));
  const auto glowing = surfaceProgram(Material{}, {.emission = true, .numbered = true, .bakedLights = 1}).defines;
  EXPECT_THAT(glowing, ::testing::IsSupersetOf({"BAKED_LIGHTS 1", "BAKED_SHARES 2", "TRIANGLE_NUMBERS 3"}));
  EXPECT_THAT(dark, Not(Contains(::testing::StartsWith("SHOWN_SAMPLES"))));
  EXPECT_THAT(surfaceProgram(Material{}, {.bakedLights = 1, .shownSamples = 4}).defines, Contains("SHOWN_SAMPLES 4"));
  EXPECT_THAT(viewProgram({.bakedLights = 2, .firstBaked = 5}).defines,
              ::testing::IsSupersetOf({"BAKED_LIGHTS 2", "FIRST_BAKED 5u"}));
}

/// Every #define that only some materials need.
const char* const kMaterialFeatures[] = {
    "ALPHA_MASK",   "DOUBLE_SIDED", "SPECULAR_GLOSSINESS", "TEXTURE_TRANSFORM", "TANGENTS",
    "TRANSMISSION", "UNLIT",        "VERTEX_COLORS"};

TEST(ShaderVariants, AMaterialWithoutAFeatureHasNoDefineOfIt) {
  Material plain;
  plain.baseColor = TextureUse{0};
  for (const char* feature : kMaterialFeatures) {
    EXPECT_THAT(surfaceProgram(plain, {}).defines, Not(Contains(feature)));
  }
  EXPECT_EQ(surfaceProgram(plain, {}).defines.size(), 3u);
  EXPECT_THAT(viewProgram({}).defines, Not(Contains("UNLIT")));
}

TEST(ShaderVariants, EachFeatureOfAMaterialIsADefineOfItsOwn) {
  Material material;
  const std::size_t plain = surfaceProgram(material, {}).defines.size();
  const auto gains = [&](const Material& featured, const char* define) {
    const auto defines = surfaceProgram(featured, {}).defines;
    EXPECT_THAT(defines, Contains(define));
    EXPECT_EQ(defines.size(), plain + 1) << define;
  };
  Material unlit;
  unlit.unlit = true;
  gains(unlit, "UNLIT");
  Material glossy;
  glossy.specularGlossiness.emplace();
  gains(glossy, "SPECULAR_GLOSSINESS");
  Material glass;
  glass.transmission = 0.5f;
  gains(glass, "TRANSMISSION");
}

TEST(ShaderVariants, OnlyATransformedTextureIsMoved) {
  Material material;
  material.cutoff = 0.5f;
  material.baseColor = TextureUse{0};
  material.normal = TextureUse{1};
  material.normal->transform.emplace();
  const auto defines = surfaceProgram(material, {}).defines;
  EXPECT_THAT(defines, Contains("NORMAL_TEXEL(map) movedTexel(map, surface.uv0, 2)"));
  EXPECT_THAT(defines, Contains("BASE_COLOR_TEXEL(map) texture(map, surface.uv0)"));
  EXPECT_THAT(maskDefines(&material), Not(Contains("TEXTURE_TRANSFORM")));
  material.baseColor->transform.emplace();
  EXPECT_THAT(maskDefines(&material), Contains("TEXTURE_TRANSFORM"));
}

TEST(ShaderVariants, G2_TheAlphaOfGlassIsReadFromNoTexture) {
  Material glass;
  glass.baseColor = TextureUse{0};
  glass.lightOpacity = 0.5f;
  EXPECT_THAT(castProgram(&glass, BlendedCasters::dither).defines,
              ::testing::ElementsAre("ALPHA_MASK", "SEEN_BY_LIGHT", "ALPHA_DITHER"));
}

TEST(ShaderVariants, X14_WhereNoLightTellsThemApartNoGroupsAreWritten) {
  EXPECT_THAT(surfaceProgram(Material{}, {}).defines, Not(Contains("RECEIVER_GROUPS")));
  EXPECT_THAT(surfaceProgram(Material{}, {.receiverGroups = true}).defines, Contains("RECEIVER_GROUPS"));
  EXPECT_THAT(viewProgram({}).defines, Not(Contains("RECEIVER_GROUPS")));
  EXPECT_THAT(viewProgram({.receiverGroups = true}).defines, Contains("RECEIVER_GROUPS"));
}

TEST(ShaderVariants, LinearPicturesAreNotToneMapped) {
  const auto linear = viewProgram({.encoded = false, .tone = toneOf(ToneMapping::aces, false)}).defines;
  EXPECT_THAT(linear, Not(Contains(::testing::StartsWith("TONE"))));
  EXPECT_THAT(linear, Not(Contains("ENCODED")));
}

TEST(ShaderVariants, FiltersThatDifferAreChosenInTheShader) {
  EXPECT_THAT(viewProgram({.shadows = {.kinds = {GNOMON_FILTER_KERNEL}, .texels = {7}}}).defines,
              Contains("FILTER_SIZE 7"));
  EXPECT_THAT(viewProgram({.shadows = {.kinds = {GNOMON_FILTER_KERNEL}, .texels = {1, 7}}}).defines,
              Not(Contains(::testing::HasSubstr("FILTER_SIZE"))));
  EXPECT_THAT(viewProgram({}).defines, Contains("NO_SHADOWS"));
}

TEST(ShaderVariants, OnlyViewsOfOneLightReadWhichItIs) {
  EXPECT_THAT(viewProgram({.view = View::color}).defines, Not(Contains("DEBUG_LIGHT")));
  for (const View view : {View::cascades, View::shadow, View::texelGrid, View::texelDensity, View::blendWeight,
                          View::bias, View::casterIds, View::lightContribution}) {
    EXPECT_THAT(viewProgram({.view = view}).defines, Contains("DEBUG_LIGHT"));
  }
}

TEST(ShaderVariants, CastersAreNamedOnlyWhereTheirNodesAreAskedFor) {
  Material masked;
  masked.cutoff = 0.5f;
  EXPECT_TRUE(castProgram(nullptr, BlendedCasters::dither).fragment.empty());
  EXPECT_THAT(castProgram(&masked, BlendedCasters::dither).defines, Not(Contains("CASTER_NODE")));
  EXPECT_THAT(casterNodeProgram(nullptr, BlendedCasters::dither).defines, Contains("CASTER_NODE"));
  EXPECT_THAT(casterNodeProgram(&masked, BlendedCasters::dither).defines, Contains("ALPHA_MASK"));
}

} // namespace
} // namespace gnomon
