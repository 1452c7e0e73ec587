#include "renderer/scene/checks/extension_gate.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

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
    const Problems problems = problemsOf(builder);
    EXPECT_THAT(problems, ElementsAre(ProblemAt(ProblemCode::unsupportedFeature, "/extensionsRequired/0")));
    EXPECT_THAT(problems[0].detail, HasSubstr(extension));
  }
}

TEST(ExtensionGate, WarnsOfUsedExtensions) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["extensionsUsed"] = {"KHR_materials_sheen", "ACME_nope"};
  EXPECT_THAT(load(builder).summary.warnings, ElementsAre(HasSubstr("surfaces have no sheen"), HasSubstr("ACME_nope")));
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
