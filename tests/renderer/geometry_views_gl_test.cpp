// What the views of seen triangles show, held against what can be worked out without them.
#include <array>
#include <cmath>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::valueAt;

constexpr int kSide = 100;

/// Straight down on 10 m, 10 pixels a metre, -Z upwards.
Json fromAbove(const std::vector<std::string>& views) {
  return {
      {"width", kSide},
      {"height", kSide},
      {"camera", {{"eye", {0, 8, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 10}}}}},
      {"lights", Json::array({{{"type", "directional"}, {"direction", {0, -1, 0.2}}}})},
      {"views", views},
      {"output", {{"format", "exr"}}}};
}

/// Plates of 2 m at x = -3 and 3, of nodes 0 and 2,052; the second has the file's only material. Nothing else.
testing::GlbBuilder plates() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["translation"] = {-3, 0, 0};
  for (int i = 0; i < 2051; ++i) builder.addRoot({{"name", "nothing"}});
  builder.json["materials"] =
      Json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {0.25, 0.5, 0.75, 1}}, {"metallicFactor", 0}}}}});
  nlohmann::json painted = builder.json["meshes"][0];
  painted["primitives"][0]["material"] = 0;
  builder.json["meshes"].push_back(painted);
  builder.addRoot({{"mesh", 1}, {"translation", {3, 0, 0}}});
  return builder;
}

/// A point 3 m left of, or right of, the middle, and one between the plates.
constexpr double kLeft = 0.2, kRight = 0.8, kBetween = 0.5;

TEST(GeometryViews, IdsMaterialsAndAlbedoAreThoseOfTheFileWhateverTheLight) {
  Json spec = fromAbove({"ids", "materials", "albedo"});
  spec["lights"] = Json::array();
  const Frame frame = renderJson(testing::sceneOf(plates()), spec.dump());
  EXPECT_EQ(valueAt(frame, kLeft, 0.5), 0.0f);
  EXPECT_EQ(valueAt(frame, kRight, 0.5), 2052.0f);
  EXPECT_EQ(valueAt(frame, kBetween, 0.5), -1.0f);
  EXPECT_EQ(frame.images[0].image.channels, std::vector<std::string>{"id"});
  EXPECT_EQ(valueAt(frame, kLeft, 0.5, 1), -1.0f) << "the mesh names none";
  EXPECT_EQ(valueAt(frame, kRight, 0.5, 1), 0.0f);
  EXPECT_EQ(valueAt(frame, kBetween, 0.5, 1), -1.0f);
  const float* albedo = floatsOf(frame, 2).data() + (std::size_t{kSide} * 50 + 80) * 3;
  for (const int channel : {0, 1, 2}) EXPECT_NEAR(albedo[channel], 0.25 * (channel + 1), 2e-3);
  EXPECT_EQ(valueAt(frame, kBetween, 0.5, 2), 0.0f) << "nothing is black";
}

TEST(GeometryViews, PositionsAreTheWorldsPoints) {
  testing::GlbBuilder tilted = testing::plane();
  const double sine = std::sin(0.25), cosine = std::cos(0.25); // half a turn of 0.5 about z: y = tan(0.5) x
  tilted.json["nodes"][0]["rotation"] = {0, 0, sine, cosine};
  tilted.json["nodes"][0]["scale"] = {3, 3, 3};
  Json spec = fromAbove({"position", "depth"});
  const Frame frame = renderJson(testing::sceneOf(tilted), spec.dump());
  const auto& points = floatsOf(frame, 0);
  const auto& depths = floatsOf(frame, 1);
  std::size_t seen = 0;
  for (std::size_t pixel = 0; pixel < depths.size(); ++pixel) {
    const float* point = points.data() + pixel * 3;
    if (std::isinf(depths[pixel])) {
      EXPECT_TRUE(std::isinf(point[0]) && std::isinf(point[1]) && std::isinf(point[2]));
      continue;
    }
    ++seen;
    const double x = (static_cast<double>(pixel % kSide) + 0.5) / 10 - 5;
    const double z = (static_cast<double>(pixel / kSide) + 0.5) / 10 - 5;
    ASSERT_NEAR(point[0], x, 1e-5);
    ASSERT_NEAR(point[1], std::tan(0.5) * x, 1e-5);
    ASSERT_NEAR(point[2], z, 1e-5);
    ASSERT_NEAR(point[1], 8 - depths[pixel], 1e-4);
  }
  EXPECT_GT(seen, 1000u);
}

/// A ground of 40 m whose far edge lies across the picture, seen from low above it: every pixel that shows the ground
/// holds the depth at which the line of sight through its middle meets it, and some are farther than any of the samples
/// that antialiasing looks at.
TEST(GeometryViews, DepthsAtAFarEdgeAreTheSurfacesOwn) {
  testing::GlbBuilder ground = testing::plane();
  ground.json["nodes"][0]["scale"] = {20, 1, 20};
  const ScenePtr scene = testing::sceneOf(ground);
  constexpr int kWidth = 160, kHeight = 90;
  const double tangent = std::tan(22.5 * 3.14159265358979 / 180);
  std::size_t beyond = 0;
  for (int step = 0; step < 16; ++step) {
    const double high = 0.27 + 0.0115 * step; // the edge moves by a sixteenth of a pixel
    Json spec = fromAbove({"depth"});
    spec["width"] = kWidth;
    spec["height"] = kHeight;
    spec["antialiasing"] = "msaa4x";
    spec["output"]["exrPixelType"] = "float";
    spec["camera"] = {{"eye", {0, high, 0}}, {"target", {0, high, -1}}, {"perspective", {{"fovYDegrees", 45}}}};
    const Frame frame = renderJson(scene, spec.dump());
    const auto& depths = floatsOf(frame);
    std::size_t seen = 0;
    for (std::size_t pixel = 0; pixel < depths.size(); ++pixel) {
      if (std::isinf(depths[pixel])) continue;
      ++seen;
      const double down = (static_cast<double>(pixel / kWidth) + 0.5) * 2 / kHeight - 1;
      ASSERT_NEAR(depths[pixel], high / (down * tangent), 1e-4 * depths[pixel])
          << "eye " << high << ", pixel " << pixel;
      beyond += depths[pixel] > frame.report.depthRange[1];
    }
    EXPECT_GT(seen, 1000u);
  }
  EXPECT_GT(beyond, 0u) << "otherwise the edge tells nothing";
}

TEST(GeometryViews, PositionsAreAsExactFarFromTheOrigin) {
  testing::GlbBuilder far = testing::plane();
  far.json["nodes"][0]["translation"] = {4e6, 0, 0};
  Json spec = fromAbove({"position"});
  spec["camera"] = {
      {"eye", {4e6, 8, 0}}, {"target", {4e6, 0, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 10}}}};
  const Frame frame = renderJson(testing::sceneOf(far), spec.dump());
  const float* middle = floatsOf(frame).data() + (std::size_t{kSide} * 50 + 50) * 3;
  const double pixel = 2 * 8 * std::tan(5 * 3.14159265358979 / 180) / kSide;
  EXPECT_NEAR(middle[0], 4e6 + pixel / 2, 0.25) << "a float's step there is half a metre";
  EXPECT_NEAR(middle[1], 0, 1e-6);
  EXPECT_NEAR(middle[2], pixel / 2, 1e-6);
}

TEST(GeometryViews, CopiesOfAMeshAreToldApart) {
  testing::GlbBuilder builder = testing::plane();
  const int places = builder.addPoints({{-3, 0, 0}, {3, 0, 0}});
  builder.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  builder.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = places;
  const Frame frame = renderJson(testing::sceneOf(builder), fromAbove({"instances", "ids"}).dump());
  EXPECT_EQ(valueAt(frame, kLeft, 0.5), 0.0f);
  EXPECT_EQ(valueAt(frame, kRight, 0.5), 1.0f);
  EXPECT_EQ(valueAt(frame, kBetween, 0.5), -1.0f);
  EXPECT_EQ(floatsOf(frame, 1)[std::size_t{kSide} * 50 + 80], 0.0f) << "one node";
}

TEST(GeometryViews, PicturesOfIdsTellNodesApart) {
  Json spec = fromAbove({"ids", "position", "albedo"});
  spec["output"] = {{"format", "png"}};
  const Frame frame = renderJson(testing::sceneOf(plates()), spec.dump());
  const auto& pixels = std::get<std::vector<std::uint8_t>>(frame.images[0].image.pixels);
  const auto colorAt = [&](std::size_t column) {
    const std::size_t at = (std::size_t{kSide} * 50 + column) * 3;
    return std::array{pixels[at], pixels[at + 1], pixels[at + 2]};
  };
  EXPECT_NE(colorAt(20), colorAt(80));
  EXPECT_EQ(colorAt(50), (std::array<std::uint8_t, 3>{0, 0, 0}));
  const auto& albedo = std::get<std::vector<std::uint8_t>>(frame.images[2].image.pixels);
  EXPECT_NEAR(albedo[(std::size_t{kSide} * 50 + 80) * 3 + 1], 188, 1) << "a half, as sRGB";
}

} // namespace
} // namespace gnomon
