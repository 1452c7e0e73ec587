// Without tangents, normal maps are turned by the derivatives of position and uv at each pixel (common_material.glsl).
// These tests hold that against models that bring their tangents: the same model without them must look the same.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/image/picture_encode.h"
#include "renderer/scene/scene.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/compare_images.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
const fs::path kModels = fs::path(GNOMON_TEST_ASSETS) / "models";

/// Round bumps as high as wide, in tangent space.
Bytes bumps() {
  const int side = 64;
  Image image{side, side, {"R", "G", "B"}, std::vector<std::uint8_t>(std::size_t{3} * side * side)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double a = 2 * std::numbers::pi * (x + 0.5) / 16;
      const double b = 2 * std::numbers::pi * (y + 0.5) / 16;
      const glm::dvec3 n = glm::normalize(glm::dvec3(std::sin(a), std::sin(b), 1.5));
      for (int k = 0; k < 3; ++k) {
        pixels[static_cast<std::size_t>(3 * (y * side + x) + k)] =
            static_cast<std::uint8_t>(std::lround(255 * (n[k] + 1) / 2));
      }
    }
  }
  return *encodePng(image, 1);
}

enum class Tangents { none, alongU, againstU };

/// A ball without its poles, u along its longitude, v along its latitude, covered with bumps.
testing::GlbBuilder bumpyBall(Tangents kind) {
  const int rows = 24;
  const int columns = 48;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uvs;
  std::vector<std::uint32_t> indices;
  const float along = kind == Tangents::againstU ? -1.0f : 1.0f;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double theta = std::numbers::pi * (0.1 + 0.8 * i / rows);
      const double phi = 2 * std::numbers::pi * j / columns;
      normals.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      tangents.emplace_back(along * std::cos(phi), 0, -along * std::sin(phi), along);
      uvs.emplace_back(2.0 * j / columns, 1.0 * i / rows);
    }
  }
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const std::uint32_t at = i * (columns + 1) + j;
      const std::uint32_t below = at + columns + 1;
      indices.insert(indices.end(), {at, below, at + 1, at + 1, below, below + 1});
    }
  }
  testing::GlbBuilder builder;
  const std::size_t count = normals.size();
  const int normal = builder.addAccessor(normals, "VEC3", 5126, count);
  nlohmann::json attributes = {
      {"POSITION", normal}, {"NORMAL", normal}, {"TEXCOORD_0", builder.addAccessor(uvs, "VEC2", 5126, count)}};
  if (kind != Tangents::none) attributes["TANGENT"] = builder.addAccessor(tangents, "VEC4", 5126, count);
  builder.json["accessors"][0]["min"] = {-1, -1, -1};
  builder.json["accessors"][0]["max"] = {1, 1, 1};
  builder.add("images", {{"bufferView", builder.addView(bumps())}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  builder.add("materials", {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 0.5}}},
                            {"normalTexture", {{"index", 0}}}});
  const nlohmann::json primitive = {
      {"attributes", attributes}, {"indices", builder.addIndices(indices)}, {"material", 0}};
  builder.addMeshNode(builder.addMesh(primitive));
  return builder;
}

/// Levels of 255, over the whole picture.
double meanDifference(const ScenePtr& a, const ScenePtr& b, const Json& camera = Json::object()) {
  const Json light = {{"sun", {{"azimuthDegrees", 250}, {"elevationDegrees", 40}}}};
  const std::string spec = Json{{"width", 320}, {"height", 240}, {"camera", camera}, {"lights", {light}}}.dump();
  const Frame first = testing::renderJson(a, spec);
  const Frame second = testing::renderJson(b, spec);
  return testing::compareImages(first.images.at(0).image, second.images.at(0).image).mean;
}

TEST(Tangents, ABumpyBallLooksTheSameWithAndWithoutThem) {
  const ScenePtr own = testing::sceneOf(bumpyBall(Tangents::alongU));
  const ScenePtr none = testing::sceneOf(bumpyBall(Tangents::none));
  EXPECT_TRUE(own->primitives[0].hasTangents);
  EXPECT_FALSE(none->primitives[0].hasTangents);
  const Json camera = {{"orbit", {{"distance", 4.508}}}}; // the ball takes a sixth of the picture
  const double difference = meanDifference(own, none, camera);
  RecordProperty("mean", std::to_string(difference));
  EXPECT_LT(difference, 0.1);
  // The measure sees tangents that are wrong.
  EXPECT_GT(meanDifference(own, testing::sceneOf(bumpyBall(Tangents::againstU)), camera), 2);
}

/// A model of the gathered assets, and the same without its tangents.
std::pair<ScenePtr, ScenePtr> withAndWithout(const fs::path& model) {
  SceneBundle bundle{testing::readFile(kModels / model), {}};
  const fs::path folder = (kModels / model).parent_path();
  for (const auto& file : fs::recursive_directory_iterator(folder)) {
    if (!file.is_regular_file()) continue;
    bundle.files[file.path().lexically_relative(folder).generic_string()] = testing::readFile(file.path());
  }
  auto own = loadScene(bundle);
  std::string text(bundle.model.begin(), bundle.model.end());
  // An attribute of another name, as long: a GLB's lengths hold.
  for (std::size_t at = text.find("\"TANGENT\""); at != std::string::npos; at = text.find("\"TANGENT\"", at)) {
    text.replace(at, 9, "\"_TANGEN\"");
  }
  bundle.model.assign(text.begin(), text.end());
  auto none = loadScene(bundle);
  EXPECT_TRUE(own && none) << model;
  return own && none ? std::pair{*own, *none} : std::pair<ScenePtr, ScenePtr>{};
}

TEST(Tangents, GatheredModelsLookTheSameWithAndWithoutThem) {
  if (!fs::exists(kModels)) GTEST_SKIP() << "no gathered models at " << kModels;
  for (const char* model : {"AlphaBlendModeTest/glTF-Binary/AlphaBlendModeTest.glb", "BananaTree/glTF/scene.gltf",
                            "LightsPunctualLamp/glTF/LightsPunctualLamp.gltf"}) {
    SCOPED_TRACE(model);
    const auto [own, none] = withAndWithout(model);
    ASSERT_TRUE(own && none);
    const auto has = [](const Primitive& primitive) { return primitive.hasTangents; };
    EXPECT_TRUE(std::any_of(own->primitives.begin(), own->primitives.end(), has));
    EXPECT_TRUE(std::none_of(none->primitives.begin(), none->primitives.end(), has));
    EXPECT_LT(meanDifference(own, none), 0.25);
  }
}

} // namespace
} // namespace gnomon
