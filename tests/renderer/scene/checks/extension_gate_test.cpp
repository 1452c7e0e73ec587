#include "renderer/scene/checks/gltf_schema.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ExtensionGate, TakesWhatIsSupported) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_mesh_quantization"};
  builder.json["extensionsRequired"] = builder.json["extensionsUsed"];
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  EXPECT_THAT(scene.summary.extensionsUsed, ElementsAre("KHR_lights_punctual", "KHR_mesh_quantization"));
}

TEST(ExtensionGate, RefusesEveryOtherRequiredExtension) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsRequired"] = {"KHR_lights_punctual", "KHR_texture_basisu", "ACME_nope"};
  const Problems problems = problemsOf(builder);
  EXPECT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::unsupportedFeature, "/extensionsRequired/1"),
                                    ProblemAt(ProblemCode::unsupportedFeature, "/extensionsRequired/2")));
  EXPECT_THAT(problems[0].detail, HasSubstr("KHR_texture_basisu"));
  EXPECT_THAT(problems[1].detail, HasSubstr("ACME_nope"));
}

TEST(ExtensionGate, X30_NothingIsTranslucentSoThatNoThicknessIsEverAskedFor) {
  for (const char* extension : {"KHR_materials_clearcoat", "KHR_materials_volume", "KHR_materials_diffuse_transmission",
                                "KHR_materials_subsurface"}) {
    testing::GlbBuilder builder = testing::cube();
    builder.json["extensionsUsed"] = {extension};
    EXPECT_THAT(load(builder).summary.warnings, ElementsAre(HasSubstr(extension)));
    builder.json["extensionsRequired"] = {extension};
    EXPECT_THAT(load(builder).summary.warnings, ElementsAre(AllOf(HasSubstr("requires"), HasSubstr(extension))));
  }
}

TEST(ExtensionGate, WarnsOfUsedExtensions) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_materials_sheen", "ACME_nope"};
  EXPECT_THAT(load(builder).summary.warnings, ElementsAre(HasSubstr("surfaces have no sheen"), HasSubstr("ACME_nope")));
}

TEST(ExtensionGate, DrawsWithoutRequiredExtensionsThatAreNoObstacle) {
  for (const auto& [extension, consequence] : {std::pair{"KHR_materials_specular", "reflections of dielectrics"},
                                               {"KHR_xmp_json_ld", "changes no pixel"},
                                               {"EXT_structural_metadata", "changes no pixel"},
                                               {"KHR_materials_nope", "not drawn"}}) {
    testing::GlbBuilder builder = testing::cube();
    builder.json["extensionsUsed"] = {extension};
    builder.json["extensionsRequired"] = {extension};
    EXPECT_THAT(load(builder).summary.warnings, ElementsAre(AllOf(HasSubstr(extension), HasSubstr(consequence))));
    SceneBundle strict = builder.bundle();
    strict.strict = true;
    EXPECT_THAT(problemsOf(strict), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/extensionsRequired/0")));
  }
}

TEST(ExtensionGate, TellsOfExtensionsThatAreNotListedOrStandWhereTheyMeanNothing) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", true}}}, {"ACME_nope", 1}};
  builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_THAT(load(builder).summary.warnings,
              ElementsAre(AllOf(HasSubstr("ACME_nope"), HasSubstr("not listed")),
                          AllOf(HasSubstr("KHR_node_visibility"), HasSubstr("/nodes/0/extensions"))));
  builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_node_visibility"};
  builder.json["meshes"][0]["extensions"] = {{"KHR_node_visibility", {{"visible", false}}}};
  EXPECT_THAT(load(builder).summary.warnings, ElementsAre(HasSubstr("means nothing")));
  builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_mesh_quantization"};
  builder.json["extensionsRequired"] = {"KHR_node_visibility"};
  EXPECT_THAT(load(builder).summary.warnings, ElementsAre(HasSubstr("required and not listed")));
}

TEST(ExtensionGate, RefusesOtherVersions) {
  for (const char* version : {"1.0", "1.1", "3.0", "20", ""}) {
    testing::GlbBuilder builder;
    builder.json["asset"]["version"] = version;
    EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::unsupportedFeature, "/asset/version")));
  }
  testing::GlbBuilder builder;
  builder.json["asset"]["version"] = "2.1";
  EXPECT_THAT(problemsOf(builder), IsEmpty());
  builder.json["asset"]["minVersion"] = "2.1";
  EXPECT_THAT(problemsOf(builder), ElementsAre(ProblemAt(ProblemCode::unsupportedFeature, "/asset/minVersion")));
  builder.json["asset"] = nlohmann::json::object();
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, "/asset/version")));
  builder.json.erase("asset");
  EXPECT_THAT(problemsOf(builder), Contains(ProblemAt(ProblemCode::invalidScene, "/asset/version")));
}

} // namespace
} // namespace gnomon
