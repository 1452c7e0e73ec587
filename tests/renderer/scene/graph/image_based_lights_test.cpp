#include "tests/renderer/made_cube.h"
#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kLight = "/extensions/EXT_lights_image_based/lights/0";

glm::dvec3 even(const glm::dvec3&) {
  return glm::dvec3(0.5);
}

/// A cube in a light of this many texels a side.
testing::GlbBuilder lit(int side = 4) {
  testing::GlbBuilder builder = testing::cube();
  testing::lightScene(builder, testing::addImageBasedLight(builder, side, even, testing::coefficientsOf(0.5, {})));
  return builder;
}

json& lightOf(testing::GlbBuilder& builder) {
  return builder.json["extensions"]["EXT_lights_image_based"]["lights"][0];
}

int addImage(testing::GlbBuilder& builder, const Bytes& file) {
  return builder.add("images", {{"bufferView", builder.addView(file)}, {"mimeType", "image/png"}});
}

Bytes pictureOf(int width, int height) {
  return testing::pngOfTexels(width, height,
                              std::vector(std::size_t(width * height), std::array<std::uint8_t, 4>{9, 9, 9, 255}));
}

TEST(ImageBasedLights, TheSceneHasTheOneThatItNames) {
  testing::GlbBuilder builder = lit();
  testing::lightScene(builder, testing::addImageBasedLight(builder, 8, even, testing::coefficientsOf(0.5, {})));
  builder.json["scenes"].push_back({{"nodes", {0}}});
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  EXPECT_THAT(scene.summary.extensionsIgnored, IsEmpty());
  ASSERT_EQ(scene.imageBasedLights.size(), 2u);
  ASSERT_EQ(scene.scenes.size(), 2u);
  EXPECT_EQ(scene.scenes[0].imageBasedLight, 1);
  EXPECT_EQ(scene.scenes[1].imageBasedLight, -1);
  EXPECT_EQ(scene.summary.environmentLight, 1);
  EXPECT_EQ(scene.summary.memory.environments,
            scene.imageBasedLights[0]->memory() + scene.imageBasedLights[1]->memory());
  const auto read = scene.imageBasedLights[1]->read(SunExtraction::none);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->facts.width, 32);
  EXPECT_NEAR(read->facts.meanRadiance, 0.5, 0.005);
  EXPECT_FALSE(load(testing::cube()).summary.environmentLight);
}

TEST(ImageBasedLights, LightsMaySharePicturesAndFacesMayBeOne) {
  testing::GlbBuilder builder = lit();
  json other = lightOf(builder);
  other["specularImages"][0] = json::array({0, 0, 0, 0, 0, 0});
  builder.json["extensions"]["EXT_lights_image_based"]["lights"].push_back(other);
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, IsEmpty());
  EXPECT_TRUE(scene.imageBasedLights[1]);
}

TEST(ImageBasedLights, VariantsOfASceneHaveItsLight) {
  testing::GlbBuilder builder = lit();
  builder.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "red"}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.scenes.size(), 2u);
  EXPECT_EQ(scene.scenes[1].imageBasedLight, 0);
}

/// The light is left out with a warning that names the place; nothing else changes.
void expectLeftOut(const testing::GlbBuilder& builder, const std::string& pointer) {
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings,
              Contains(::testing::AllOf(HasSubstr(pointer), HasSubstr("the light is left out"))))
      << ::testing::PrintToString(scene.summary.warnings);
  ASSERT_FALSE(scene.imageBasedLights.empty());
  EXPECT_FALSE(scene.imageBasedLights[0]);
  EXPECT_EQ(scene.scenes[0].imageBasedLight, -1);
  EXPECT_FALSE(scene.summary.environmentLight);
  SceneBundle strict = builder.bundle();
  strict.strict = true;
  EXPECT_THAT(problemsOf(strict), Contains(::testing::Field(&Problem::pointer, pointer)));
}

TEST(ImageBasedLights, AFaultyOneIsLeftOut) {
  const auto expect = [](const std::string& member, const json& value, const std::string& pointer) {
    testing::GlbBuilder builder = lit();
    lightOf(builder)[member] = value;
    expectLeftOut(builder, kLight + pointer);
  };
  const json coefficients = testing::coefficientsOf(0.5, {});
  json few = coefficients, thin = coefficients, text = coefficients;
  few.erase(8);
  thin[3].erase(2);
  text[2][1] = "1";
  expect("irradianceCoefficients", few, "/irradianceCoefficients");
  expect("irradianceCoefficients", thin, "/irradianceCoefficients/3");
  expect("irradianceCoefficients", text, "/irradianceCoefficients/2/1");
  expect("irradianceCoefficients", 7, "/irradianceCoefficients");
  expect("specularImages", {{0, 1, 2, 3, 4}}, "/specularImages/0");
  expect("specularImages", {{0, 1, 2, 3, 4, 6}}, "/specularImages/0/5");
  expect("specularImages", {{0, 1, 2, 3, 4, -1}}, "/specularImages/0/5");
  expect("specularImages", {{0, 1, 2, 3, 4, 5}, {0, 1}}, "/specularImages/1");
  expect("specularImages", {0, 1, 2, 3, 4, 5}, "/specularImages/0");
  expect("specularImages", json::array(), "/specularImages");
  expect("specularImageSize", "large", "/specularImageSize");
  expect("intensity", -1, "/intensity");
  expect("rotation", {0, 0, 0, 0}, "/rotation");
  expect("rotation", {0, 0, 1}, "/rotation");
  expect("rotation", {0, 0, 7, 1}, "/rotation/2");
  for (const char* member : {"irradianceCoefficients", "specularImages", "specularImageSize"}) {
    testing::GlbBuilder builder = lit();
    lightOf(builder).erase(member);
    expectLeftOut(builder, kLight + "/" + member);
  }
}

TEST(ImageBasedLights, FacesThatAreNoSquaresOfOneSizeAreRefusedAtTheirPlace) {
  for (const glm::ivec2 size : {glm::ivec2(4, 8), {8, 4}, {8, 8}, {2, 2}}) {
    testing::GlbBuilder builder = lit();
    lightOf(builder)["specularImages"][0][2] = addImage(builder, pictureOf(size.x, size.y));
    expectLeftOut(builder, kLight + "/specularImages/0/2");
  }
  testing::GlbBuilder first = lit();
  lightOf(first)["specularImages"][0][0] = addImage(first, pictureOf(8, 4));
  expectLeftOut(first, kLight + "/specularImages/0/0");
}

TEST(ImageBasedLights, PicturesThatCannotBeReadAreNamed) {
  testing::GlbBuilder noPicture = lit();
  lightOf(noPicture)["specularImages"][0][1] = addImage(noPicture, Bytes(40, 7));
  expectLeftOut(noPicture, kLight + "/specularImages/0/1");
  testing::GlbBuilder cut = lit();
  Bytes file = testing::rgbdFace(0, 4, even);
  file.resize(file.size() - 20);
  lightOf(cut)["specularImages"][0][4] = addImage(cut, file);
  expectLeftOut(cut, "/images/6");
}

TEST(ImageBasedLights, OtherLevelsAreCheckedAndNotNeeded) {
  testing::GlbBuilder builder = lit(8);
  json& levels = lightOf(builder)["specularImages"];
  const int half = addImage(builder, pictureOf(4, 4)), quarter = addImage(builder, pictureOf(2, 2));
  levels.push_back({half, half, half, half, half, half});
  levels.push_back({quarter, quarter, quarter, quarter, quarter, quarter});
  EXPECT_THAT(load(builder).summary.warnings, IsEmpty());
  levels[2][3] = half;
  const Scene scene = load(builder);
  EXPECT_THAT(scene.summary.warnings, Contains(HasSubstr(kLight + "/specularImages/2/3")));
  EXPECT_TRUE(scene.imageBasedLights[0]);
}

TEST(ImageBasedLights, SizesThatAreNotAsStatedAreWarnings) {
  testing::GlbBuilder stated = lit();
  lightOf(stated)["specularImageSize"] = 256;
  EXPECT_THAT(load(stated).summary.warnings, Contains(HasSubstr(kLight + "/specularImageSize")));
  EXPECT_THAT(load(lit(6)).summary.warnings, Contains(HasSubstr("no power of two")));
}

TEST(ImageBasedLights, ASceneNamesOneThatIsThere) {
  testing::GlbBuilder builder = lit();
  testing::lightScene(builder, 1);
  EXPECT_THAT(problemsOf(builder),
              Contains(ProblemAt(ProblemCode::invalidScene, "/scenes/0/extensions/EXT_lights_image_based/light")));
}

TEST(ImageBasedLights, LimitsRefuse) {
  Limits limits = kLimits;
  limits.maxEnvironmentWidth = 12;
  EXPECT_THAT(problemsOf(lit(4), limits), Contains(ProblemAt(ProblemCode::tooLarge, kLight + "/specularImages/0")));
  limits.maxEnvironmentWidth = 16;
  EXPECT_THAT(problemsOf(lit(4), limits), IsEmpty());
  limits.maxImagePixels = 6 * 16 - 1;
  EXPECT_THAT(problemsOf(lit(4), limits), Contains(ProblemAt(ProblemCode::tooLarge, kLight + "/specularImages/0")));
  // All lights together, whatever pictures they share.
  testing::GlbBuilder two = lit(4);
  two.json["extensions"]["EXT_lights_image_based"]["lights"].push_back(lightOf(two));
  limits.maxImagePixels = 2 * 6 * 16;
  EXPECT_THAT(problemsOf(two, limits), IsEmpty());
  limits.maxImagePixels -= 1;
  EXPECT_THAT(
      problemsOf(two, limits),
      Contains(ProblemAt(ProblemCode::tooLarge, "/extensions/EXT_lights_image_based/lights/1/specularImages/0")));
}

} // namespace
} // namespace gnomon
