// Which faces cast, for every type of light: mirrored nodes, open and double-sided surfaces.
#include <algorithm>
#include <cmath>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

const std::vector<Json> kLights = Json::parse(R"([{"type":"directional","direction":[0.1,-1,0.05]},
    {"type":"spot","position":[0.3,9,0.2],"direction":[0,-1,0.01],"outerConeDegrees":40},
    {"type":"point","position":[0.3,9,0.2]}])");

/// Looks straight down from `height`.
Json spec(const Json& light, double height) {
  return {{"width", 128},
          {"height", 128},
          {"camera", {{"eye", {0, height, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
          {"lights", {light}},
          // A fit that rounding in what is seen does not move.
          {"shadow",
           {{"filter", {{"type", "hard"}}},
            {"stabilization", "projectionSnapping"},
            {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 9}}}}},
          {"antialiasing", "none"},
          {"views", {"shadow", "atlas"}},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

/// A ground of 20 m.
testing::GlbBuilder ground() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  return builder;
}

/// A tetrahedron like no mirror image of itself, over the ground: mirrored by its node, by its points, or not at all.
enum class Mirrored { no, byNode, byPoints };
ScenePtr tetrahedron(Mirrored mirrored) {
  testing::GlbBuilder builder = ground();
  const float side = mirrored == Mirrored::byPoints ? -1.0f : 1.0f;
  const int points =
      builder.addPoints({{-0.2f * side, 0, -0.2f}, {0.4f * side, 0, -0.1f}, {0, 0, 0.3f}, {0.3f * side, 0.6f, 0}});
  const auto indices = mirrored == Mirrored::byPoints ? builder.addShortIndices({0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
                                                      : builder.addShortIndices({0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0});
  const int mesh = builder.addMesh({{"attributes", {{"POSITION", points}}}, {"indices", indices}});
  builder.addRoot(
      {{"mesh", mesh}, {"translation", {0, 2, 0}}, {"scale", {mirrored == Mirrored::byNode ? -1 : 1, 1, 1}}});
  return testing::sceneOf(builder);
}

/// Pixels and texels that differ by more than rounding.
std::ptrdiff_t differences(const Frame& a, const Frame& b) {
  std::ptrdiff_t count = 0;
  for (std::size_t view = 0; view < 2; ++view) {
    const auto& left = floatsOf(a, view);
    const auto& right = floatsOf(b, view);
    EXPECT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) count += std::abs(left[i] - right[i]) > 1e-3f;
  }
  return count;
}

TEST(CasterFaces, G4_AMirroredNodeCastsAsAMirroredMeshDoes) {
  const ScenePtr byNode = tetrahedron(Mirrored::byNode);
  const ScenePtr byPoints = tetrahedron(Mirrored::byPoints);
  const ScenePtr plain = tetrahedron(Mirrored::no);
  for (const Json& light : kLights) {
    const std::string above = spec(light, 5).dump(); // the tiles' depths hold the tetrahedron, too
    const Frame frame = renderJson(byNode, above);
    EXPECT_LT(differences(frame, renderJson(byPoints, above)), 20) << light;
    EXPECT_GT(differences(frame, renderJson(plain, above)), 100) << "a test that cannot tell tells nothing" << light;
  }
}

TEST(CasterFaces, X34_ACardCastsWhicheverWayItFaces) {
  const auto over = [](const Json& node, bool doubleSided) {
    testing::GlbBuilder builder = ground();
    builder.add("meshes", builder.json["meshes"][0]);
    builder.add("materials", {{"doubleSided", doubleSided}});
    builder.json["meshes"][1]["primitives"][0]["material"] = 0;
    Json card = {{"mesh", 1}, {"scale", {0.3, 1, 0.3}}, {"translation", {0, 2, 0}}};
    card.update(node);
    builder.addRoot(card);
    return testing::sceneOf(builder);
  };
  const Json up = Json::object();
  const Json down = {{"rotation", {1, 0, 0, 0}}};
  const Json mirrored = {{"scale", {-0.3, 1, 0.3}}};
  const Json turnedOver = {{"scale", {0.3, -1, 0.3}}};
  const ScenePtr plain = over(up, false);
  for (const Json& light : kLights) {
    const std::string below = spec(light, 1.9).dump();
    const Frame expected = renderJson(plain, below);
    const auto& visibility = floatsOf(expected);
    const auto dark = std::count_if(visibility.begin(), visibility.end(), [](float v) { return v < 0.5f; });
    // A square of at least 0.6 m, at most 0.6 * 9 / 7 m, in a picture of 1.57 m.
    EXPECT_GT(dark, 128 * 128 * 0.6 * 0.6 / (1.58 * 1.58) * 0.95) << light;
    EXPECT_LT(dark, 128 * 128 * 0.78 * 0.78 / (1.57 * 1.57) * 1.05) << light;
    for (const Json& node : {up, down, mirrored, turnedOver}) {
      for (const bool doubleSided : {false, true}) {
        EXPECT_LT(differences(renderJson(over(node, doubleSided), below), expected), 8) << light << node << doubleSided;
      }
    }
  }
}

} // namespace
} // namespace gnomon
