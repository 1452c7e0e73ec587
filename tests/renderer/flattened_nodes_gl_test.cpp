// A node that one scale of 0 flattens is a surface: seen, lit on the sides that it has, and casting.
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::sceneOf;

constexpr int kSide = 128; ///< of the picture, which shows 8 m: 256 pixels a square metre

/// A ground, and above it a cube of 2 m whose node has this content.
testing::GlbBuilder boxOverGround(nlohmann::json node) {
  testing::GlbBuilder builder = testing::cube();
  node["mesh"] = 0;
  builder.json["nodes"][0] = std::move(node);
  const int position = builder.addPoints({{-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}});
  builder.addMeshNode(builder.addMesh(
      {{"attributes", {{"POSITION", position}}}, {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}}));
  return builder;
}

/// From above; the sun stands in the west, 45 degrees high.
Json specOf(const Json& shadow, const std::vector<std::string>& views = {"shadow", "ids", "normal"}) {
  return {
      {"width", kSide},
      {"height", kSide},
      {"antialiasing", "none"},
      {"camera", {{"eye", {0, 9, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 8}}}}},
      {"lights", {{{"sun", {{"azimuthDegrees", 270}, {"elevationDegrees", 45}}}}}},
      {"shadow", shadow},
      {"views", views},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

struct Seen {
  int surface = 0;    ///< pixels of the flattened node
  int shadowed = 0;   ///< pixels of the ground in shadow
  double leastUp = 1; ///< of the flattened surface's normals
};

Seen seenIn(const Frame& frame) {
  Seen seen;
  const std::vector<float>& shadow = floatsOf(frame, 0);
  const std::vector<float>& ids = floatsOf(frame, 1);
  const std::vector<float>& normal = floatsOf(frame, 2);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == 0) {
      ++seen.surface;
      seen.leastUp = std::min(seen.leastUp, double{normal[3 * i + 1]});
    } else if (shadow[i] < 0.5f) {
      ++seen.shadowed;
    }
  }
  return seen;
}

const std::vector<Json>& techniques() {
  static const std::vector<Json> all{{{"technique", "shadowMap"}, {"filter", {{"type", "hard"}}}},
                                     {{"technique", "shadowMap"}, {"filter", {{"type", "pcf"}, {"size", 3}}}},
                                     {{"technique", "rayTraced"}},
                                     {{"technique", "lightMap"}, {"lightMap", {{"size", 1024}}}}};
  return all;
}

/// Of 2 m x 2 m, 1 m above the ground: its shadow lies 1 m to the east, half of it in view.
void expectSquare(const testing::GlbBuilder& builder, const std::string& what) {
  const ScenePtr scene = sceneOf(builder);
  for (const Json& shadow : techniques()) {
    const Seen seen = seenIn(renderJson(scene, specOf(shadow).dump()));
    EXPECT_EQ(seen.surface, 1024) << what << shadow;
    EXPECT_NEAR(seen.shadowed, 512, shadow["technique"] == "shadowMap" ? 40 : 34) << what << shadow;
    EXPECT_GT(seen.leastUp, 0.999) << what << shadow;
  }
}

TEST(FlattenedNodes, AreSeenAndCast) {
  expectSquare(boxOverGround({{"scale", {1, 0, 1}}, {"translation", {0, 1, 0}}}), "scale ");
  expectSquare(boxOverGround({{"scale", {1, 1e-7, 1}}, {"translation", {0, 1, 0}}}), "nearly flat ");
  expectSquare(boxOverGround({{"matrix", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 1}}}), "matrix ");
  const double half = std::sqrt(0.5);
  expectSquare(boxOverGround({{"scale", {0, 1, 1}}, {"rotation", {0, 0, half, half}}, {"translation", {0, 1, 0}}}),
               "turned ");
  expectSquare(boxOverGround({{"scale", {-1, 0, 1}}, {"translation", {0, 1, 0}}}), "mirrored ");
}

TEST(FlattenedNodes, AreSeenAndCastBelowAFlattenedParentAndAsInstances) {
  testing::GlbBuilder nested = boxOverGround({{"scale", {2, 0, 1}}});
  nested.addRoot({{"children", {0}}, {"scale", {0.5, 0, 1}}, {"translation", {0, 1, 0}}});
  nested.json["scenes"][0]["nodes"] = {1, 2};
  expectSquare(nested, "nested ");

  testing::GlbBuilder instanced = boxOverGround({{"translation", {0, 1, 0}}});
  const int scales = instanced.addAccessor(std::vector<float>{1, 0, 1}, "VEC3", 5126, 1);
  instanced.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  instanced.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = scales;
  expectSquare(instanced, "instanced ");
}

TEST(FlattenedNodes, AreSeenAndCastWhileAnAnimationPassesZero) {
  testing::GlbBuilder builder = boxOverGround({{"translation", {0, 1, 0}}});
  animate(builder, 0, "scale", {0, 2}, {1, 0.5, 1, 1, -0.5, 1}, "VEC3");
  const ScenePtr scene = sceneOf(builder);
  Json spec = specOf({{"technique", "rayTraced"}});
  spec["animation"] = {{"index", 0}, {"timeSeconds", 1}};
  const Seen seen = seenIn(renderJson(scene, spec.dump()));
  EXPECT_EQ(seen.surface, 1024);
  EXPECT_NEAR(seen.shadowed, 512, 34);
}

TEST(FlattenedNodes, SmoothNormalsPointAlongTheAxisThatIsGone) {
  testing::GlbBuilder builder = boxOverGround({{"scale", {1, 0, 1}}, {"translation", {0, 1, 0}}});
  builder.json["nodes"][0]["mesh"] = testing::addCube(builder, true);
  const Seen seen = seenIn(renderJson(sceneOf(builder), specOf({{"technique", "rayTraced"}}).dump()));
  EXPECT_EQ(seen.surface, 1024);
  EXPECT_GT(seen.leastUp, 0.999);
}

} // namespace
} // namespace gnomon
