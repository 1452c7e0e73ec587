#include "renderer/scene/materials/materials.h"

#include "renderer/image/picture_encode.h"
#include "tests/renderer/scene/load.h"
#include "tests/support/webp_builder.h"

namespace gnomon {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Bytes png(int width, int height, std::uint8_t red) {
  Image image{width, height, {"R", "G", "B"}, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 3))};
  for (std::uint8_t& value : std::get<0>(image.pixels)) value = red;
  auto encoded = encodePng(image, 1);
  EXPECT_TRUE(encoded);
  return *std::move(encoded);
}

/// A plane whose material has a base colour texture with this image.
testing::GlbBuilder textured(const Bytes& image) {
  testing::GlbBuilder builder = testing::plane();
  builder.add("images", {{"bufferView", builder.addView(image)}, {"mimeType", "image/png"}, {"name", "picture"}});
  builder.add("textures", {{"source", 0}});
  builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  return builder;
}

TEST(Materials, DefaultsAreThoseOfGltf) {
  const Scene scene = load(testing::plane());
  const Material& material = onlyMaterial(scene);
  EXPECT_EQ(material.baseColorFactor, glm::vec4(1));
  EXPECT_EQ(material.metallicFactor, 1);
  EXPECT_EQ(material.roughnessFactor, 1);
  EXPECT_EQ(material.emissiveFactor, glm::vec3(0));
  EXPECT_TRUE(stopsAllLight(material));
  EXPECT_FALSE(material.doubleSided);
  EXPECT_FALSE(material.baseColor);
}

TEST(Materials, ReadsEveryFactor) {
  testing::GlbBuilder builder = testing::plane();
  builder.add("materials", json::parse(R"({
    "name": "Brass", "emissiveFactor": [0.1, 0.2, 0.3], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.75},
    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 10}}})"));
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Scene scene = load(builder);
  const Material& material = onlyMaterial(scene);
  EXPECT_EQ(material.name, "Brass");
  EXPECT_EQ(material.baseColorFactor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(material.emissiveFactor, glm::vec3(1, 2, 3));
  EXPECT_EQ(material.metallicFactor, 0.5f);
  EXPECT_EQ(material.roughnessFactor, 0.75f);
  EXPECT_EQ(material.cutoff, 0.25f);
  EXPECT_FALSE(material.lightOpacity);
  EXPECT_TRUE(material.doubleSided);
}

TEST(Materials, G2_BlendIsKeptAndWarnedOf) {
  testing::GlbBuilder builder = testing::plane();
  builder.add("materials", {{"name", "Glass"}, {"alphaMode", "BLEND"}, {"alphaCutoff", 0.1}});
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Scene scene = load(builder);
  EXPECT_EQ(onlyMaterial(scene).lightOpacity, 1);
  EXPECT_EQ(onlyMaterial(scene).cutoff, 0.5f);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("\"Glass\"")));
}

TEST(Materials, ReadsTexturesWithTheirSampler) {
  testing::GlbBuilder builder = textured(png(3, 2, 200));
  builder.add("samplers", {{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}});
  builder.json["textures"][0]["sampler"] = 0;
  builder.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 1}, {"scale", 0.5}};
  builder.json["materials"][0]["occlusionTexture"] = {{"index", 0}, {"strength", 0.25}};
  const Scene scene = load(builder);
  const Material& material = onlyMaterial(scene);
  ASSERT_TRUE(material.baseColor && material.normal && material.occlusion);
  EXPECT_FALSE(material.emissive);
  EXPECT_EQ(material.baseColor->image, 0);
  EXPECT_EQ(material.baseColor->wrapS, Wrap::clampToEdge);
  EXPECT_EQ(material.baseColor->wrapT, Wrap::mirroredRepeat);
  EXPECT_TRUE(material.baseColor->nearest);
  EXPECT_EQ(material.normal->texCoord, 1);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_EQ(material.occlusionStrength, 0.25f);
  ASSERT_EQ(scene.images.size(), 1u);
  EXPECT_EQ(scene.images[0]->width(), 3);
  EXPECT_EQ(scene.images[0]->height(), 2);
  EXPECT_EQ(std::get<0>(scene.images[0]->pixels().pixels).size(), 24u) << "RGBA";
  EXPECT_EQ(std::get<0>(scene.images[0]->pixels().pixels)[0], 200);
}

TEST(Materials, DecodesOnlyTheImagesThatAreUsed) {
  testing::GlbBuilder builder = textured(png(2, 2, 10));
  builder.add("images", {{"bufferView", builder.addView(Bytes(16, 0))}}); // no image at all, but nobody looks
  builder.add("images", {{"bufferView", builder.addView(png(1, 1, 20))}});
  builder.add("textures", {{"source", 2}});
  builder.json["materials"][0]["emissiveTexture"] = {{"index", 1}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.images.size(), 2u);
  EXPECT_EQ(onlyMaterial(scene).baseColor->image, 0);
  EXPECT_EQ(onlyMaterial(scene).emissive->image, 1);
  EXPECT_EQ(std::get<0>(scene.images[1]->pixels().pixels)[0], 20);
}

TEST(Materials, LeavesOutTexturesInOtherFormats) {
  const std::string_view signature("\xABKTX 20\xBB\r\n\x1A\n", 12);
  const Scene scene = load(textured(Bytes(signature.begin(), signature.end())));
  EXPECT_FALSE(onlyMaterial(scene).baseColor);
  EXPECT_THAT(scene.images, IsEmpty());
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("\"picture\"")));
}

TEST(Materials, UsesTheFallbackOfATexture) {
  testing::GlbBuilder builder = textured(png(2, 2, 10));
  const std::string_view signature("\xABKTX 20\xBB\r\n\x1A\n", 12);
  builder.add("images", {{"bufferView", builder.addView(Bytes(signature.begin(), signature.end()))}});
  builder.json["extensionsUsed"] = {"KHR_texture_basisu"};
  builder.json["textures"][0]["extensions"] = {{"KHR_texture_basisu", {{"source", 1}}}};
  const Scene scene = load(builder);
  EXPECT_TRUE(onlyMaterial(scene).baseColor);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("fallback")));
}

TEST(Materials, LeavesOutTexturesWithoutAnImage) {
  testing::GlbBuilder builder = textured(png(2, 2, 10));
  builder.json["textures"][0].erase("source");
  const Scene scene = load(builder);
  EXPECT_FALSE(onlyMaterial(scene).baseColor);
  EXPECT_THAT(scene.summary.warnings, ElementsAre(HasSubstr("texture 0 of the material 0")));
}

/// The plane whose texture has a PNG as its fallback and this WebP.
testing::GlbBuilder texturedTwice(const Bytes& webp) {
  testing::GlbBuilder builder = textured(png(2, 2, 10));
  builder.add("images", {{"bufferView", builder.addView(webp)}, {"mimeType", "image/webp"}});
  builder.json["extensionsUsed"] = {"EXT_texture_webp"};
  builder.json["textures"][0]["extensions"] = {{"EXT_texture_webp", {{"source", 1}}}};
  return builder;
}

TEST(Materials, WebpWinsOverTheFallback) {
  const Bytes pixel{200, 100, 50, 25};
  testing::GlbBuilder builder = texturedTwice(testing::losslessWebp(1, 1, pixel));
  for (const bool required : {false, true}) {
    if (required) builder.json["extensionsRequired"] = {"EXT_texture_webp"};
    if (required) builder.json["textures"][0].erase("source");
    const Scene scene = load(builder);
    EXPECT_THAT(scene.summary.warnings, IsEmpty());
    ASSERT_EQ(scene.images.size(), 1u);
    EXPECT_EQ(std::get<0>(scene.images[0]->pixels().pixels), pixel) << "straight alpha";
  }
  builder.json["textures"][0] = {{"source", 0}, {"extensions", {{"EXT_texture_webp", json::object()}}}};
  EXPECT_EQ(std::get<0>(load(builder).images.at(0)->pixels().pixels)[0], 10) << "the extension names no image";
}

TEST(Materials, RefusesWebpThatIsBrokenAnimatedOrTooLarge) {
  const Bytes whole = testing::losslessWebp(1, 1, {1, 2, 3, 4});
  EXPECT_THAT(findingsOf(texturedTwice(Bytes(whole.begin(), whole.end() - 2))), ::testing::HasSubstr("/images/1"));
  EXPECT_THAT(
      findingsOf(texturedTwice(testing::webpFile(testing::webpChunk("VP8X", testing::webpCanvas(2, 1, 1))))),
      ::testing::HasSubstr("animated; only still ones are read; the textures that use it are left out (/images/1)"));
  EXPECT_THAT(problemsOf(texturedTwice(testing::losslessWebp(16384, 16384, {}))),
              ElementsAre(ProblemAt(ProblemCode::tooLarge, "/images/1")));
}

TEST(Materials, AnImageSampledInTwoWaysIsTwoTextures) {
  testing::GlbBuilder builder = textured(png(2, 2, 10));
  builder.add("samplers", {{"wrapS", 33071}});
  builder.add("textures", {{"source", 0}});
  builder.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 1}};
  EXPECT_EQ(load(builder).summary.textures, 1u);
  builder.json["textures"][1]["sampler"] = 0;
  const SceneSummary summary = load(builder).summary;
  EXPECT_EQ(summary.textures, 2u);
  EXPECT_EQ(summary.images, 1u);
}

TEST(Materials, RefusesBrokenImages) {
  EXPECT_THAT(findingsOf(textured(Bytes(20, 7))), ::testing::HasSubstr("/images/0"));
  for (const Bytes& image : {pngHeader(4, 4), pngHeader(0, 4), Bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'}}) {
    EXPECT_THAT(findingsOf(textured(image)), ::testing::HasSubstr("/images/0"));
  }
  testing::GlbBuilder builder = textured(png(2, 2, 0));
  builder.json["images"][0]["uri"] = "x.png";
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/images/0"));
  builder.json["images"][0] = json::object();
  EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr("/images/0"));
}

} // namespace
} // namespace gnomon
