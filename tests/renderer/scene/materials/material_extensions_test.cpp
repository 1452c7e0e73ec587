#include <numbers>

#include "renderer/image/picture_encode.h"
#include "renderer/scene/document/read_model.h"
#include "renderer/scene/materials/materials.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(MaterialExtensions, ATransformScalesThenTurnsThenMoves) {
  const auto transform = transformOf(
      readTextureInfo({{"extensions",
                        {{"KHR_texture_transform",
                          {{"offset", {0.5, 0.25}}, {"rotation", std::numbers::pi / 2}, {"scale", {2, 3}}}}}}}));
  ASSERT_TRUE(transform);
  // The extension's own matrices: u' = 2 cos u + 3 sin v + 0.5, v' = -2 sin u + 3 cos v + 0.25.
  const glm::vec2 moved = transform->axes * glm::vec2(0.1f, 0.2f) + transform->offset;
  EXPECT_NEAR(moved.x, 3 * 0.2f + 0.5f, 1e-6f);
  EXPECT_NEAR(moved.y, -2 * 0.1f + 0.25f, 1e-6f);
}

TEST(MaterialExtensions, ATransformThatMovesNothingIsNone) {
  EXPECT_FALSE(transformOf(readTextureInfo(json::object())));
  const gltf::TextureInfo still =
      readTextureInfo({{"extensions", {{"KHR_texture_transform", {{"texCoord", 1}, {"scale", {1, 1}}}}}}});
  EXPECT_FALSE(transformOf(still));
  EXPECT_EQ(still.texCoord, 1);
}

/// A plane with that material.
testing::GlbBuilder withMaterial(const json& material) {
  testing::GlbBuilder builder = testing::plane();
  builder.add("materials", material);
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  return builder;
}

TEST(MaterialExtensions, ReadsUnlitAndSpecularGlossiness) {
  const Scene scene = load(withMaterial(json::parse(R"({"extensions": {"KHR_materials_unlit": {},
      "KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 0.4], "specularFactor": [0.5, 0.6, 0.7],
                                              "glossinessFactor": 0.25}}})")));
  const Material& material = onlyMaterial(scene);
  EXPECT_TRUE(material.unlit);
  ASSERT_TRUE(material.specularGlossiness);
  EXPECT_EQ(material.baseColorFactor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.specularGlossiness->specularFactor, glm::vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(material.specularGlossiness->glossinessFactor, 0.25f);
}

TEST(MaterialExtensions, G2_GlassCastsByWhatItKeepsAndIsWarnedOf) {
  json glass = {{"name", "Glass"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 0.75}}}}}};
  Scene scene = load(withMaterial(glass));
  EXPECT_EQ(onlyMaterial(scene).transmission, 0.75f);
  EXPECT_EQ(onlyMaterial(scene).lightOpacity, 0.25f);
  EXPECT_FALSE(hasHoles(onlyMaterial(scene)));
  EXPECT_EQ(onlyMaterial(scene).baseColorFactor.a, 1);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("\"Glass\" is transmissive")));

  glass["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0;
  scene = load(withMaterial(glass));
  EXPECT_TRUE(stopsAllLight(onlyMaterial(scene)));

  glass["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 2;
  EXPECT_THAT(problemsOf(withMaterial(glass)),
              ElementsAre(ProblemAt(ProblemCode::invalidScene,
                                    "/materials/0/extensions/KHR_materials_transmission/transmissionFactor")));
}

TEST(MaterialExtensions, ATextureThatHasOnlyBasisUniversalIsLeftOut) {
  testing::GlbBuilder builder = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  builder.add("images", {{"bufferView", builder.addView(Bytes(16, 0))}, {"mimeType", "image/ktx2"}});
  builder.add("textures", {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}});
  builder.json["extensionsUsed"] = {"KHR_texture_basisu"};
  const Scene scene = load(builder);
  EXPECT_FALSE(scene.materials[0].baseColor);
  EXPECT_THAT(scene.summary.warnings, ::testing::Contains(HasSubstr("/textures/0 has only a KTX 2 image")));
}

TEST(MaterialExtensions, EveryMinificationFilterIsKept) {
  const std::pair<int, MinFilter> filters[] = {{9728, MinFilter::nearest},
                                               {9729, MinFilter::linear},
                                               {9984, MinFilter::nearestMipmapNearest},
                                               {9985, MinFilter::linearMipmapNearest},
                                               {9986, MinFilter::nearestMipmapLinear},
                                               {9987, MinFilter::linearMipmapLinear}};
  const Image pixel{1, 1, {"R", "G", "B"}, std::vector<std::uint8_t>{1, 2, 3}};
  for (const auto& [code, filter] : filters) {
    testing::GlbBuilder builder = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    builder.add("images", {{"bufferView", builder.addView(*encodePng(pixel, 1))}, {"mimeType", "image/png"}});
    builder.add("samplers", {{"minFilter", code}});
    builder.add("textures", {{"source", 0}, {"sampler", 0}});
    EXPECT_EQ(onlyMaterial(load(builder)).baseColor->minFilter, filter) << code;
  }
}

} // namespace
} // namespace gnomon
