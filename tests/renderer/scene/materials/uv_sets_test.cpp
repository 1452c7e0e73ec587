#include "renderer/image/picture_encode.h"
#include "renderer/scene/materials/materials.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

UvSets setsFor(const std::vector<int>& used) {
  return uvSetsFor(used);
}

TEST(UvSets, KeepsTheFirstTwoSetsInTheirOwnPlaces) {
  EXPECT_EQ(setsFor({}), (UvSets{-1, -1}));
  EXPECT_EQ(setsFor({0}), (UvSets{0, -1}));
  EXPECT_EQ(setsFor({1, 1}), (UvSets{-1, 1}));
  for (const auto& used : {std::vector{0, 1}, std::vector{1, 0}, std::vector{1, 0, 7}}) {
    EXPECT_EQ(setsFor(used), (UvSets{0, 1}));
  }
}

TEST(UvSets, GivesFurtherSetsThePlaceThatIsLeft) {
  EXPECT_EQ(setsFor({5}), (UvSets{-1, 5}));
  EXPECT_EQ(setsFor({3, 0, 1}), (UvSets{0, 3}));
  EXPECT_EQ(setsFor({1, 4}), (UvSets{4, 1}));
  EXPECT_EQ(setsFor({4, 1}), (UvSets{4, 1}));
  EXPECT_EQ(setsFor({9, 2}), (UvSets{2, 9}));
}

TEST(UvSets, AreSharedWhereNoPlaceHoldsTwo) {
  EXPECT_EQ(sharedUvSets({0, -1}, {-1, 2}), (UvSets{0, 2}));
  EXPECT_EQ(sharedUvSets({0, 2}, {0, 2}), (UvSets{0, 2}));
  EXPECT_EQ(sharedUvSets({-1, -1}, {4, 1}), (UvSets{4, 1}));
  EXPECT_EQ(sharedUvSets({0, 1}, {-1, 2}), std::nullopt);
}

/// A plane whose TEXCOORD_n is (n + 1) / 10 everywhere, for n of 0 to 3, and materials whose textures use these sets.
testing::GlbBuilder planeWith(const std::vector<json>& materials) {
  testing::GlbBuilder builder = testing::plane();
  const Image pixel{1, 1, {"R", "G", "B"}, std::vector<std::uint8_t>{1, 2, 3}};
  builder.add("images", {{"bufferView", builder.addView(*encodePng(pixel, 1))}});
  builder.add("textures", {{"source", 0}});
  for (const json& material : materials) builder.add("materials", material);
  json& primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  for (int set = 0; set < 4; ++set) {
    primitive["attributes"]["TEXCOORD_" + std::to_string(set)] =
        builder.addAccessor(std::vector<float>(8, static_cast<float>(set + 1) / 10), "VEC2", 5126, 4);
  }
  return builder;
}

json materialOn(int baseColor, int normal, int emissive) {
  return {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", baseColor}}}}},
          {"normalTexture", {{"index", 0}, {"texCoord", normal}}},
          {"emissiveTexture", {{"index", 0}, {"texCoord", emissive}}}};
}

/// The set that a texture reads from the first vertex.
int setRead(const Scene& scene, const std::optional<TextureUse>& texture) {
  if (!texture) return -1;
  const VertexAttributes& vertex = (*scene.attributes).at(0);
  return static_cast<int>(std::lround((texture->texCoord == 1 ? vertex.uv1 : vertex.uv0).x * 10)) - 1;
}

TEST(UvSets, EveryTextureReadsTheCoordinatesThatItNames) {
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      const Scene scene = load(planeWith({materialOn(a, b, a)}));
      EXPECT_THAT(scene.summary.warnings, IsEmpty());
      EXPECT_EQ(setRead(scene, scene.materials[0].baseColor), a);
      EXPECT_EQ(setRead(scene, scene.materials[0].normal), b);
      EXPECT_EQ(setRead(scene, scene.materials[0].emissive), a);
    }
  }
}

TEST(UvSets, ATextureOnAThirdSetIsLeftOut) {
  json named = materialOn(2, 0, 3);
  named["name"] = "Wall";
  const Scene scene = load(planeWith({named}));
  EXPECT_EQ(setRead(scene, scene.materials[0].baseColor), 2);
  EXPECT_EQ(setRead(scene, scene.materials[0].normal), 0);
  EXPECT_FALSE(scene.materials[0].emissive);
  EXPECT_THAT(scene.summary.warnings,
              ElementsAre(HasSubstr("emissive texture of the material 0 \"Wall\" uses TEXCOORD_3")));
}

TEST(UvSets, TheTransformsOwnSetCounts) {
  json material = materialOn(0, 0, 0);
  material["normalTexture"]["extensions"]["KHR_texture_transform"] = {{"texCoord", 3}};
  const Scene scene = load(planeWith({material}));
  EXPECT_EQ(setRead(scene, scene.materials[0].normal), 3);
}

testing::GlbBuilder withVariant(testing::GlbBuilder builder) {
  builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "other"}}};
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {0}}}};
  return builder;
}

TEST(UvSets, VariantsShareTheVerticesOfAPrimitive) {
  const Scene scene = load(withVariant(planeWith({materialOn(0, 0, 0), materialOn(2, 0, 2)})));
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  EXPECT_EQ(setRead(scene, scene.materials[0].baseColor), 0);
  EXPECT_EQ(setRead(scene, scene.materials[1].baseColor), 2);
  EXPECT_EQ(setRead(scene, scene.materials[1].normal), 0);
}

TEST(UvSets, AVariantLosesWhatThePrimitiveHasNoPlaceFor) {
  const Scene scene = load(withVariant(planeWith({materialOn(0, 1, 0), materialOn(2, 0, 2)})));
  EXPECT_EQ(setRead(scene, scene.materials[0].normal), 1);
  EXPECT_FALSE(scene.materials[1].baseColor);
  EXPECT_EQ(setRead(scene, scene.materials[1].normal), 0);
  EXPECT_FALSE(scene.materials[1].emissive);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("base color texture of the material 1 uses TEXCOORD_2"),
                                                  HasSubstr("emissive texture of the material 1 uses TEXCOORD_2")));
}

TEST(UvSets, APrimitiveWithoutThoseCoordinatesReadsZeros) {
  testing::GlbBuilder builder = planeWith({materialOn(3, 3, 3)});
  builder.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_3");
  const Scene scene = load(builder);
  EXPECT_EQ(scene.materials[0].baseColor->texCoord, 1);
  EXPECT_EQ((*scene.attributes).at(0).uv1, glm::vec2(0));
}

/// A plane of material 0 that the variant "red" gives material 1 and "same" leaves alone.
testing::GlbBuilder withVariants() {
  testing::GlbBuilder builder = testing::plane();
  builder.add("materials", {{"name", "plain"}});
  builder.add("materials", {{"name", "red"}});
  builder.json["extensionsUsed"] = {"KHR_materials_variants"};
  builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", "same"}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {0}}}};
  return builder;
}

TEST(MaterialVariants, EachOneHasTheFilesScenesWithItsMaterials) {
  const Scene scene = load(withVariants());
  EXPECT_THAT(scene.variants, ElementsAre("red", "same"));
  EXPECT_THAT(scene.summary.materialVariants, ElementsAre("red", "same"));
  EXPECT_EQ(fileScenes(scene), 1);
  EXPECT_EQ(scene.summary.scenes, 1);
  ASSERT_EQ(scene.scenes.size(), 3u);
  EXPECT_EQ(materialOf(scene, scene.scenes[0].instances.at(0)), 0);
  EXPECT_EQ(materialOf(scene, scene.scenes[1].instances.at(0)), 1);
  EXPECT_EQ(materialOf(scene, scene.scenes[2].instances.at(0)), 0);
}

TEST(MaterialVariants, IndicesNameWhatThereIs) {
  const std::string mapping = "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/0";
  testing::GlbBuilder builder = withVariants();
  auto& first = builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0];
  first["variants"] = {2};
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, mapping + "/variants/0")));
  first["variants"] = {0};
  first["material"] = 7;
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, mapping + "/material")));
}

TEST(MaterialVariants, WithoutAListOfThemNothingChanges) {
  testing::GlbBuilder builder = withVariants();
  builder.json.erase("extensions");
  builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0]["variants"] =
      nlohmann::json::array();
  const Scene scene = load(builder);
  EXPECT_EQ(scene.scenes.size(), 1u);
}

TEST(MaterialVariants, AreHeldAgainstTheLimits) {
  expectBeyond(withVariants(), &Limits::maxInstances, 5, "/extensions/KHR_materials_variants/variants");
  expectBeyond(withVariants(), &Limits::maxInstances, 1, "/extensions/KHR_materials_variants/variants");
}

} // namespace
} // namespace gnomon
