// The same model written plainly, quantized and compressed gives the same scene and the same picture.
#include <algorithm>

#include "renderer/scene/scene.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/compare_images.h"
#include "tests/support/compressed_models.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
const fs::path kModels = fs::path(GNOMON_TEST_ASSETS) / "models";

/// A model of the gathered assets with every file beside it.
SceneBundle bundleOf(const fs::path& model) {
  SceneBundle bundle{testing::readFile(kModels / model), {}};
  for (const auto& file : fs::directory_iterator((kModels / model).parent_path())) {
    bundle.files[file.path().filename().string()] = testing::readFile(file.path());
  }
  return bundle;
}

struct Tolerance {
  double bounds = 0; ///< in shares of the greatest side
  double mean = 0;   ///< in levels of 255
};

/// Seen by one camera, lit by a sun that throws hard shadows.
void expectAlike(const ScenePtr& plain, const ScenePtr& other, const Tolerance& tolerance) {
  ASSERT_TRUE(plain && other);
  EXPECT_EQ(plain->summary.triangles, other->summary.triangles);
  const auto& low = plain->summary.boundsMin;
  const auto& high = plain->summary.boundsMax;
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  Json eye = Json::array();
  Json target = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(other->summary.boundsMin[axis], low[axis], tolerance.bounds * size);
    EXPECT_NEAR(other->summary.boundsMax[axis], high[axis], tolerance.bounds * size);
    target.push_back((low[axis] + high[axis]) / 2);
    eye.push_back(target.back().get<double>() + size * (axis == 1 ? 0.9 : 1.1));
  }
  const Json spec = {{"width", 192},
                     {"height", 192},
                     {"camera", {{"eye", eye}, {"target", target}, {"perspective", {{"fovYDegrees", 45}}}}},
                     {"lights", {{{"type", "directional"}, {"direction", {-0.3, -1, -0.6}}}}}};
  const Frame first = testing::renderJson(plain, spec.dump());
  const Frame second = testing::renderJson(other, spec.dump());
  ASSERT_FALSE(first.images.empty() || second.images.empty());
  const testing::ImageDifference difference = testing::compareImages(first.images[0].image, second.images[0].image);
  ASSERT_TRUE(difference.sameSize);
  EXPECT_LE(difference.mean, tolerance.mean)
      << "worst " << difference.max << " at " << difference.worstX << ", " << difference.worstY;
}

TEST(CompressedModels, ShowWhatThePlainModelShows) {
  const testing::Shape shape = testing::torus(48);
  const ScenePtr plain = testing::sceneOf(testing::plainModel(shape));
  const std::pair<const char*, testing::GlbBuilder> variants[] = {
      {"quantized", testing::quantizedModel(shape)},
      {"Draco, edgebreaker", testing::dracoModel(shape)},
      {"Draco, sequential", testing::dracoModel(shape, false)},
      {"EXT_meshopt_compression", testing::meshoptModel(shape)},
      {"KHR_meshopt_compression", testing::meshoptModel(shape, "KHR_meshopt_compression")}};
  for (const auto& [name, builder] : variants) {
    SCOPED_TRACE(name);
    expectAlike(plain, testing::sceneOf(builder), {1e-3, 0.3});
  }
  // The measure tells other shapes apart.
  const ScenePtr coarse = testing::sceneOf(testing::plainModel(testing::torus(12)));
  const Json spec = {{"width", 192}, {"height", 192}};
  const Frame one = testing::renderJson(plain, spec.dump());
  const Frame two = testing::renderJson(coarse, spec.dump());
  EXPECT_GT(testing::compareImages(one.images[0].image, two.images[0].image).mean, 0.6);
}

TEST(CompressedModels, GatheredVariantsOfOneModelAreAlike) {
  if (!fs::exists(kModels)) GTEST_SKIP() << "no gathered models at " << kModels;
  struct Pair {
    const char* plain;
    const char* other;
    Tolerance tolerance;
  };
  const Pair pairs[] = {
      {"Box/glTF/Box.gltf", "Box/glTF-Draco/Box.gltf", {1e-3, 0.3}},
      {"Duck/glTF/Duck.gltf", "Duck/glTF-Draco/Duck.gltf", {2e-3, 0.6}},
      {"CesiumMan/glTF-Binary/CesiumMan.glb", "CesiumMan/glTF-Draco/CesiumMan.gltf", {2e-3, 0.6}},
      {"MeshoptFallback/glTF-fallback/meshopt-fallback.gltf",
       "MeshoptFallback/glTF-no-fallback/meshopt-no-fallback.gltf",
       {0, 0}},
      {"BoxMeshopt/glTF-Meshopt/BoxMeshopt.gltf", "BoxMeshopt/glTF-Binary-Meshopt/BoxMeshopt.glb", {1e-6, 0.3}},
      {"AnimatedMorphCube/glTF/AnimatedMorphCube.gltf",
       "AnimatedMorphCube/glTF-Quantized/AnimatedMorphCube.gltf",
       {1e-3, 0.3}}};
  for (const Pair& pair : pairs) {
    SCOPED_TRACE(pair.other);
    expectAlike(testing::sceneOf(bundleOf(pair.plain)), testing::sceneOf(bundleOf(pair.other)), pair.tolerance);
  }
}

} // namespace
} // namespace gnomon
