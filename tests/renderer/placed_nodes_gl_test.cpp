// Nodes that a frame places show as in a file that has them there: pictures, shadows, tiles, light maps and volumes.
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_grids.h"
#include "tests/renderer/scene/animation/animated.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::sceneOf;

/// A ground (node 0); "arm" (1), which carries a cube (2), a lamp and a camera.
testing::GlbBuilder workshop() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  const int mesh = testing::addCube(builder);
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 200}},
                                                                 {{"type", "directional"}, {"intensity", 2}}};
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 0.1}, {"zfar", 100}}}});
  const double sine = std::sqrt(0.5);
  builder.addRoot({{"name", "arm"}, {"translation", {-3, 1.5, 0}}, {"children", {2, 3, 4}}});
  builder.add("nodes", {{"name", "load"}, {"mesh", mesh}});
  builder.add("nodes", {{"name", "lamp"}, {"translation", {0, 4, 2}}});
  builder.json["nodes"][3]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  builder.add("nodes",
              {{"name", "camera"}, {"translation", {0, 7, 12}}, {"rotation", {-0.25, 0, 0, 0.97}}, {"camera", 0}});
  builder.addRoot({{"name", "sun"}, {"rotation", {-sine, 0, 0.2, sine}}});
  builder.json["nodes"][5]["extensions"]["KHR_lights_punctual"]["light"] = 1;
  return builder;
}

Json specOf(const Json& patch) {
  Json spec{{"width", 96},
            {"height", 64},
            {"camera", {{"node", "camera"}}},
            {"views", {"color", "shadow", "normal", "depth", "position", "ids"}},
            {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  if (!patch.is_null()) spec.merge_patch(patch);
  return spec;
}

void expectSame(const Frame& one, const Frame& other) {
  ASSERT_EQ(one.images.size(), other.images.size());
  for (std::size_t i = 0; i < one.images.size(); ++i) EXPECT_TRUE(floatsOf(one, i) == floatsOf(other, i)) << i;
  EXPECT_EQ(one.report.depthRange, other.report.depthRange);
}

const Json kPlaces = {{{"node", "arm"}, {"translation", {2, 2, -1}}, {"rotation", {0, 0.3, 0, 0.9}}},
                      {{"node", "load"}, {"matrix", {1, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -2, 0, 0.5, 0, 0, 1}}},
                      {{"node", "lamp"}, {"translation", {1, 5, 1}}}};

testing::GlbBuilder withPlaces(testing::GlbBuilder builder) {
  for (const Json& place : kPlaces) {
    for (nlohmann::json& node : builder.json["nodes"]) {
      if (node.value("name", "") != place["node"].get<std::string>()) continue;
      for (const char* part : {"translation", "rotation", "matrix"}) {
        if (place.contains(part)) node[part] = nlohmann::json::parse(place[part].dump());
      }
    }
  }
  return builder;
}

TEST(PlacedNodes, AFrameIsThatOfAFileWithItsNodesThere) {
  const ScenePtr scene = sceneOf(workshop());
  const Frame moved = renderJson(scene, specOf({{"nodes", kPlaces}}).dump());
  expectSame(moved, renderJson(sceneOf(withPlaces(workshop())), specOf({}).dump()));
  const Frame still = renderJson(scene, specOf({}).dump());
  EXPECT_NE(floatsOf(still), floatsOf(moved));
  expectSame(still, renderJson(scene, specOf({}).dump()));
}

TEST(PlacedNodes, RaysFindThemWhereTheyStand) {
  const Json exact{{"nodes", kPlaces}, {"shadow", {{"technique", "rayTraced"}}}, {"views", {"shadow", "reference"}}};
  Json plain = exact;
  plain.erase("nodes");
  expectSame(renderJson(sceneOf(workshop()), specOf(exact).dump()),
             renderJson(sceneOf(withPlaces(workshop())), specOf(plain).dump()));
}

TEST(PlacedNodes, KeptTilesAreNotThoseOfAnotherPlace) {
  const ScenePtr scene = sceneOf(workshop());
  const Json camera{{"eye", {0, 9, 14}}, {"target", {0, 0, 0}}, {"up", {0, 1, 0}}};
  const auto specAt = [&](double x) {
    Json spec = specOf({{"nodes", {{{"node", "load"}, {"translation", {x, 0, 0}}}}}, {"views", {"shadow"}}});
    spec["camera"] = camera;
    return spec.dump();
  };
  const std::vector<float> first = floatsOf(renderJson(scene, specAt(0)));
  EXPECT_NE(floatsOf(renderJson(scene, specAt(3))), first);
  EXPECT_NE(floatsOf(renderJson(scene, specAt(5))), first);
  EXPECT_EQ(floatsOf(renderJson(scene, specAt(0))), first);
}

TEST(PlacedNodes, AnAnimationMovesTheRest) {
  testing::GlbBuilder builder = workshop();
  animate(builder, 1, "translation", {0, 2}, {-3, 1.5f, 0, 5, 1.5f, 0}, "VEC3");
  testing::GlbBuilder authored = workshop();
  authored.json["nodes"][1]["translation"] = {1, 1.5, 0};
  authored.json["nodes"][2]["translation"] = {0, 0, -2};
  expectSame(renderJson(sceneOf(builder), specOf({{"animation", {{"index", 0}, {"timeSeconds", 1}}},
                                                  {"nodes", {{{"node", "load"}, {"translation", {0, 0, -2}}}}}})
                                              .dump()),
             renderJson(sceneOf(authored), specOf({}).dump()));
}

TEST(PlacedNodes, ALightMapIsBakedForTheirPlacesAndServesThemAgain) {
  const ScenePtr scene = sceneOf(workshop());
  const auto specAt = [&](double x) {
    return specOf({{"nodes", {{{"node", "load"}, {"translation", {x, 0, 0}}}}},
                   {"lights", {{{"type", "directional"}, {"direction", {0.5, -1, 0.2}}}}},
                   {"shadow", {{"technique", "lightMap"}, {"lightMap", {{"size", 256}}}}},
                   {"views", {"shadow"}}})
        .dump();
  };
  const Frame first = renderJson(scene, specAt(0));
  const Frame other = renderJson(scene, specAt(2));
  const Frame again = renderJson(scene, specAt(2));
  ASSERT_TRUE(other.report.lights.at(0).lightMap && again.report.lights.at(0).lightMap);
  EXPECT_FALSE(other.report.lights[0].lightMap->reused);
  EXPECT_TRUE(again.report.lights[0].lightMap->reused);
  EXPECT_NE(floatsOf(first), floatsOf(other));
  EXPECT_EQ(floatsOf(other), floatsOf(again));
}

ScenePtr withGrid(const testing::GlbBuilder& builder) {
  SceneBundle bundle = builder.bundle();
  bundle.files["hill.npy"] = testing::byteGrid(6, 5, 4, [](int x, int y, int z) { return 40 * x + 8 * y + 5 * z; });
  return sceneOf(bundle);
}

Json withCloud(const Json& place) {
  Json volume{{"file", "hill.npy"},
              {"box", {{"min", {-2, 1, -2}}, {"max", {2, 3, 2}}}},
              {"transferFunction", {{{"value", 0}, {"extinction", 0}}, {{"value", 255}, {"extinction", 0.6}}}}};
  volume.update(place);
  return {{"volumes", {volume}}, {"views", {"color", "shadow"}}};
}

/// The same as in a file with its nodes there, after a frame that has them elsewhere.
void expectFollows(const Json& spec) {
  Json placed = spec;
  placed["nodes"] = kPlaces;
  const ScenePtr scene = withGrid(workshop());
  const Frame still = renderJson(scene, specOf(spec).dump());
  const Frame moved = renderJson(scene, specOf(placed).dump());
  expectSame(moved, renderJson(withGrid(withPlaces(workshop())), specOf(spec).dump()));
  EXPECT_NE(floatsOf(still), floatsOf(moved));
}

TEST(PlacedNodes, VolumesFollowTheirNode) {
  expectFollows(withCloud({{"node", "load"}}));
}

TEST(PlacedNodes, ShadowsOnVolumesFollowWhatThrowsThem) {
  Json spec = withCloud(Json::object());
  spec["camera"] = {{"eye", {0, 9, 14}}, {"target", {0, 0, 0}}};
  spec["camera"]["node"] = nullptr;
  expectFollows(spec);
}

} // namespace
} // namespace gnomon
