// Technique shadowVolume where several solids are one primitive: the camera may stand in one, the light in another.
#include <random>

#include "tests/renderer/techniques/volume_frames.h"

namespace gnomon {
namespace {

using testing::cameraFrom;
using testing::Difference;
using testing::difference;
using testing::placed;
using testing::shapes;
using testing::volumeSpec;

struct Box {
  glm::dvec3 center{0};
  glm::dvec3 half{1};
};

/// A floor of 40 m, node 0, and boxes that are one primitive, node 1.
ScenePtr houses(const std::vector<Box>& boxes, bool doubleSided = false) {
  std::vector<testing::Point> points;
  std::vector<std::uint32_t> indices;
  for (const Box& box : boxes) {
    const auto first = static_cast<std::uint32_t>(points.size());
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 point(box.center +
                            box.half * glm::dvec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
      points.push_back({point.x, point.y, point.z});
    }
    for (const std::uint32_t corner :
         {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6}) {
      indices.push_back(first + corner);
    }
  }
  testing::GlbBuilder builder = shapes();
  const int material = builder.add("materials", {{"doubleSided", doubleSided}});
  const int mesh = builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(points)}}},
                                    {"indices", builder.addIndices(indices)},
                                    {"material", material}});
  builder.addRoot(placed(1, {0, 0, 0}, {20, 1, 20}));
  builder.addMeshNode(mesh);
  return testing::sceneOf(builder);
}

Json toJson(const glm::dvec3& point) {
  return {point.x, point.y, point.z};
}

Json lampAt(const glm::dvec3& position) {
  return {{"type", "point"}, {"position", toJson(position)}, {"intensity", 60}};
}

const std::vector<Box>& street() {
  static const std::vector<Box> boxes{{{-4.5, 2, 0}, {2, 2, 2}}, {{4.5, 2, 0}, {2, 2, 2}}, {{0, 3, -9}, {1, 3, 1}}};
  return boxes;
}

/// No light reaches what is seen.
void expectDark(const ScenePtr& scene, const Json& spec) {
  const Difference found = difference(scene, spec);
  EXPECT_EQ(found.elsewhere + found.atEdges, 0u) << spec["lights"] << spec["camera"];
  EXPECT_GT(found.receivers, 5000u) << spec["camera"];
  EXPECT_EQ(found.shadowed, found.receivers) << spec["lights"] << spec["camera"];
}

/// Eyes in the street, at a wall as near as the near plane cuts into it, and above the roofs.
const glm::dvec3 kEyes[] = {{0, 1.7, 1}, {-2.45, 0.5, 2.1}, {0, 9, 12}};

TEST(ShadowVolumeSolids, N3_ALampShutInAHouseLightsNoStreet) {
  const ScenePtr scene = houses(street());
  for (const Box& lit : street()) {
    for (const glm::dvec3& eye : kEyes) {
      Json spec = volumeSpec(lampAt(lit.center + 0.3 * lit.half), cameraFrom(toJson(eye), {-2, 0.5, -3}));
      expectDark(scene, spec);
      // The floor in the house is lit, where the near plane or a node that is not shown lays it open.
      spec["nodes"] = {{{"node", 1}, {"visible", false}, {"castShadow", true}}};
      Json cut = spec;
      cut.erase("nodes");
      cut["camera"]["orthographic"] = {{"height", 8}, {"near", -3}, {"far", 60}};
      for (const Json& opened : {spec, cut}) {
        const Difference found = difference(scene, opened);
        EXPECT_EQ(found.elsewhere, 0u) << opened["lights"] << opened["camera"];
        EXPECT_LE(found.atEdges, 2 + found.receivers / 1000) << opened["lights"] << opened["camera"];
      }
    }
  }
}

TEST(ShadowVolumeSolids, N7_AnyHousesLampAndEyeAgreeWithRays) {
  std::mt19937 random(39);
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto placeIn = [&](const Box& box) {
    return box.center + box.half * glm::dvec3(within(-0.9, 0.9), within(-0.9, 0.9), within(-0.9, 0.9));
  };
  std::size_t elsewhere = 0;
  std::size_t receivers = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<Box> boxes;
    for (int box = 0; box < 6; ++box) {
      boxes.push_back(
          {{within(-4, 4), within(0.5, 3), within(-4, 4)}, {within(0.2, 1.8), within(0.2, 1.5), within(0.2, 1.8)}});
    }
    const ScenePtr scene = houses(boxes, i % 4 == 0);
    Json light = lampAt(i % 3 == 0 ? glm::dvec3(within(-5, 5), within(0.3, 6), within(-5, 5)) : placeIn(boxes[0]));
    if (i % 8 == 7) {
      light["type"] = "spot";
      light["direction"] = {within(-1, 1), within(-1, 0.2), within(-1, 1)};
      light["outerConeDegrees"] = 80;
    }
    const glm::dvec3 eyes[] = {{within(-6, 6), within(0.2, 6), within(-6, 6)}, placeIn(boxes[1]), placeIn(boxes[0])};
    Json spec = volumeSpec(light, cameraFrom(toJson(eyes[i % 5 % 3]), {within(-2, 2), within(0, 1), within(-2, 2)}));
    if (i % 7 == 3) {
      spec["camera"]["orthographic"] = {{"height", within(3, 12)}, {"near", within(-2, 1)}, {"far", 50}};
    } else {
      spec["camera"]["perspective"] = {{"fovYDegrees", within(30, 110)}, {"near", within(0.001, 1)}};
    }
    const Difference found = difference(scene, spec);
    elsewhere += found.elsewhere;
    receivers += found.receivers;
    EXPECT_EQ(found.elsewhere, 0u) << i << ' ' << spec;
    EXPECT_LE(found.atEdges, 3 + found.receivers / 1000) << i << ' ' << spec;
  }
  EXPECT_GT(receivers, 500000u);
}

} // namespace
} // namespace gnomon
