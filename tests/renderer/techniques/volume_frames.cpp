#include "tests/renderer/techniques/volume_frames.h"

namespace gnomon::testing {
namespace {

bool atEdge(const std::vector<float>& truth, int width, int height, int x, int y) {
  const auto at = [&](int column, int row) {
    return truth[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] >=
           0.5f;
  };
  for (int row = std::max(0, y - 1); row <= std::min(height - 1, y + 1); ++row) {
    for (int column = std::max(0, x - 1); column <= std::min(width - 1, x + 1); ++column) {
      if (at(column, row) != at(x, y)) return true;
    }
  }
  return false;
}

Difference differenceFrom(const LightReference& truth, const std::vector<float>& shown, int width, int height) {
  Difference difference;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      if (truth.receiver[i] == 0) continue;
      ++difference.receivers;
      const bool lit = truth.visibility[i] >= 0.5f;
      if (!lit) ++difference.shadowed;
      if (lit == (shown[i] >= 0.5f)) continue;
      ++(atEdge(truth.visibility, width, height, x, y) ? difference.atEdges : difference.elsewhere);
    }
  }
  return difference;
}

} // namespace

Json volumeSpec(const Json& light, const Json& camera) {
  return {{"width", 240},
          {"height", 160},
          {"camera", camera},
          {"lights", {light}},
          {"shadow", {{"technique", "shadowVolume"}, {"terminator", "flat"}}}, // as volumes are
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}}}};
}

Json cameraFrom(const Json& eye, const Json& target) {
  return {{"eye", eye}, {"target", target}, {"up", {0.05, 1, 0.02}}};
}

const TestLights& testLights() {
  static const TestLights lights{
      Json::parse(R"({"type":"directional","direction":[0.5,-1,-0.3]})"),
      Json::parse(R"({"type":"directional","direction":[0.9,-0.15,-0.5]})"),
      Json::parse(R"({"type":"directional","direction":[0,-1,0]})"),
      Json::parse(R"({"type":"point","position":[-1.7,4.3,2.1],"intensity":300})"),
      Json::parse(
          R"({"type":"spot","position":[-2.1,5.3,3.2],"direction":[0.4,-1,-0.5],"outerConeDegrees":60,"intensity":300})")};
  return lights;
}

Difference difference(const ScenePtr& scene, const Json& spec) {
  const std::vector<float> shown = floatsOf(renderJson(scene, spec.dump()));
  return differenceFrom(truthOf(scene, spec.dump()), shown, spec["width"].get<int>(), spec["height"].get<int>());
}

void expectTruth(const ScenePtr& scene, const Json& spec) {
  const Difference found = difference(scene, spec);
  EXPECT_GT(found.shadowed, 20u) << spec["lights"] << spec["camera"];
  EXPECT_GT(found.receivers - found.shadowed, 20u) << spec["lights"] << spec["camera"];
  EXPECT_EQ(found.elsewhere, 0u) << spec["lights"] << spec["camera"];
  // On edges a pixel's centre may lie as near to the edge as a sample's place is known: 1/256 of a pixel.
  EXPECT_LE(found.atEdges, 2 + found.receivers / 2000) << spec["lights"] << spec["camera"];
}

nlohmann::json placed(int mesh, const Json& translation, const Json& scale) {
  return nlohmann::json::parse(Json{{"mesh", mesh}, {"translation", translation}, {"scale", scale}}.dump());
}

GlbBuilder shapes() {
  GlbBuilder builder = cube();
  builder.json["nodes"] = nlohmann::json::array();
  builder.json["scenes"][0]["nodes"] = nlohmann::json::array();
  const int position = builder.addPoints({{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}});
  const int normal = builder.addPoints({{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}});
  builder.addMesh({{"attributes", {{"POSITION", position}, {"NORMAL", normal}}},
                   {"indices", builder.addShortIndices({0, 1, 2, 0, 2, 3})}});
  return builder;
}

GlbBuilder boxOverFloor() {
  GlbBuilder builder = shapes();
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  builder.addRoot(placed(0, {0, 1.5, 0}, {1, 1, 1}));
  return builder;
}

const Json& usualCamera() {
  static const Json camera = cameraFrom({6, 5, 8}, {0, 0.5, 0});
  return camera;
}

} // namespace gnomon::testing
