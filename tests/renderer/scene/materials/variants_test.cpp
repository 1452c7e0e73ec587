#include "renderer/scene/materials/materials.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

/// A plane of material 0 that the variant "red" gives material 1 and "same" leaves alone.
testing::GlbBuilder withVariants() {
  testing::GlbBuilder builder = testing::plane();
  builder.add("materials", {{"name", "plain"}});
  builder.add("materials", {{"name", "red"}});
  auto& json = builder.json;
  json["extensionsUsed"] = {"KHR_materials_variants"};
  json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}, {{"name", "same"}}};
  json["meshes"][0]["primitives"][0]["material"] = 0;
  json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
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
  auto& json = builder.json["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][0];
  json["variants"] = {2};
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::invalidScene, mapping + "/variants/0")));
  json["variants"] = {0};
  json["material"] = 7;
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
  Limits limits;
  limits.maxInstances = 5;
  EXPECT_THAT(problemsOf(withVariants(), limits),
              ElementsAre(ProblemAt(ProblemCode::tooLarge, "/extensions/KHR_materials_variants/variants")));
  limits.maxInstances = 1;
  EXPECT_THAT(problemsOf(withVariants(), limits),
              ElementsAre(ProblemAt(ProblemCode::tooLarge, "/extensions/KHR_materials_variants/variants")));
}

} // namespace
} // namespace gnomon
