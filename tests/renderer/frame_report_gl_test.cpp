// What a frame's report says, held against the frame.
#include <cmath>
#include <glm/glm.hpp>
#include <map>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

using testing::renderJson;

const char* const kThreeLights = R"({"width":96,"height":64,"views":["color","shadow"],"lights":[
    {"sun":{"azimuthDegrees":120,"elevationDegrees":35}},
    {"type":"spot","position":[3,4,2],"direction":[-3,-4,-2],"range":20,"shadow":{"size":"Small"}},
    {"type":"point","position":[-2,3,1],"range":15}]})";

glm::dmat4 matrixOf(const TileReport& tile) {
  glm::dmat4 matrix(0.0);
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*tile.matrix)[static_cast<std::size_t>(i)];
  return matrix;
}

glm::dvec3 clipOf(const TileReport& tile, const glm::dvec3& world) {
  const glm::dvec4 clip = matrixOf(tile) * glm::dvec4(world, 1.0);
  return glm::dvec3(clip) / clip.w;
}

bool holds(const TileReport& tile, const glm::dvec3& world) {
  if (!tile.matrix) return false;
  if ((matrixOf(tile) * glm::dvec4(world, 1.0)).w <= 0) return false;
  const glm::dvec3 clip = clipOf(tile, world);
  return std::abs(clip.x) <= 1 && std::abs(clip.y) <= 1 && clip.z >= 0 && clip.z <= 1;
}

TEST(FrameReports, H7_TheMatrixLeadsFromTheWorldIntoTheTile) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"), kThreeLights);
  const glm::dvec3 onTheGround(1.5, 0, 1.5); // in view, in the reach of every light
  for (const LightReport& light : frame.report.lights) {
    const auto holding = std::count_if(light.tiles.begin(), light.tiles.end(),
                                       [&](const TileReport& tile) { return holds(tile, onTheGround); });
    EXPECT_GE(holding, 1) << light.light;
  }
  const TileReport& tile = frame.report.lights[0].tiles[0];
  const double azimuth = glm::radians(120.0);
  const double elevation = glm::radians(35.0);
  const glm::dvec3 travels(-std::sin(azimuth) * std::cos(elevation), -std::sin(elevation),
                           std::cos(azimuth) * std::cos(elevation));
  const glm::dvec3 step = clipOf(tile, onTheGround + travels * 0.1) - clipOf(tile, onTheGround);
  EXPECT_NEAR(step.x, 0, 1e-9) << "along the light, a point stays at its texel";
  EXPECT_NEAR(step.y, 0, 1e-9);
  EXPECT_GT(step.z, 0);
  // A texel is as large as it says: along the tile's x, 1 in clip space is half its texels.
  const glm::dmat4 matrix = matrixOf(tile);
  const glm::dvec3 across(matrix[0][0], matrix[1][0], matrix[2][0]);
  EXPECT_NEAR(2.0 / glm::length(across) / tile.tile[2], tile.texelSize[0], 1e-9);
}

TEST(FrameReports, H4_H7_BiasAndBorderAreToldInMetresAndTexels) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"), kThreeLights);
  for (const LightReport& light : frame.report.lights) {
    for (const TileReport& tile : light.tiles) {
      if (!tile.matrix) continue;
      const double texel = std::hypot(tile.texelSize[0], tile.texelSize[1]);
      EXPECT_GT(tile.border, 0);
      EXPECT_GT(tile.normalOffset, 0.06 * texel);
      EXPECT_LT(tile.normalOffset, 0.1 * texel);
      EXPECT_GT(tile.depthBias, 0);
      EXPECT_GT(tile.depthBiasMetres, 0);
      EXPECT_LT(tile.depthBiasMetres, light.light == 0 ? 1e-3 : 0.02) << "a face's depths are coarse at its far end";
    }
  }
}

TEST(FrameReports, PassesTilesAndLightsAddUp) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"), kThreeLights);
  const FrameReport& report = frame.report;
  std::vector<std::string> names;
  std::uint64_t drawCalls = 0;
  const bool gl = testing::testedDevice() == DeviceChoice::gl;
  std::map<std::string, const PassReport*> passes;
  for (const PassReport& pass : report.passes) {
    names.push_back(pass.pass);
    passes[pass.pass] = &pass;
    drawCalls += pass.drawCalls;
    EXPECT_GE(pass.cpuMilliseconds, 0);
    ASSERT_EQ(pass.gpuMilliseconds.has_value(), gl) << "OpenGL alone has a timer of its own";
    if (gl) {
      EXPECT_GT(*pass.gpuMilliseconds, 0) << pass.pass;
      EXPECT_LT(*pass.gpuMilliseconds, 60'000) << pass.pass;
    }
    EXPECT_EQ(pass.view.has_value(), pass.pass == "view");
  }
  // The processor shows the surfaces that its survey found, and looks anew only at another number of samples: before it
  // casts, because it casts what these read.
  const std::vector<std::string> byGl = {"survey", "shadow", "surfaces", "surfaces", "view", "view"};
  const std::vector<std::string> byCpu = {"survey", "surfaces", "shadow", "view", "view"};
  EXPECT_EQ(names, gl ? byGl : byCpu);
  EXPECT_EQ(report.counts.drawCalls, drawCalls);
  EXPECT_EQ(passes["shadow"]->triangles, report.counts.casterTriangles);
  EXPECT_EQ(passes["survey"]->triangles, report.counts.surveyedTriangles);

  std::uint64_t triangles = 0;
  for (const LightReport& light : report.lights) {
    LightReport sums;
    double cpu = 0;
    double gpu = 0;
    for (const TileReport& tile : light.tiles) {
      sums.casterTriangles += tile.casterTriangles;
      sums.drawCalls += tile.drawCalls;
      cpu += tile.cpuMilliseconds.value_or(0);
      gpu += tile.gpuMilliseconds.value_or(0);
      EXPECT_EQ(tile.cpuMilliseconds.has_value(), tile.tile[2] > 0);
      EXPECT_EQ(tile.gpuMilliseconds.has_value(), gl && tile.tile[2] > 0);
    }
    EXPECT_EQ(light.casterTriangles, sums.casterTriangles);
    EXPECT_EQ(light.drawCalls, sums.drawCalls);
    EXPECT_NEAR(light.cpuMilliseconds.value(), cpu, 1e-9);
    EXPECT_NEAR(light.gpuMilliseconds.value_or(0), gpu, 1e-9);
    triangles += light.casterTriangles;
  }
  EXPECT_EQ(triangles, report.counts.casterTriangles);
}

TEST(FrameReports, MemoryIsCountedInBytes) {
  const Frame frame =
      renderJson(testing::generatedScene("box_on_plane"), R"({"width":96,"height":64,"lights":[{"sun":{}}]})");
  const MemoryReport& memory = frame.report.memory;
  EXPECT_EQ(memory.atlas, 4u * static_cast<unsigned>(frame.report.atlasSize[0] * frame.report.atlasSize[1]));
  if (testing::testedDevice() == DeviceChoice::cpu) {
    // 4 samples of depth and triangle, and one picture of 3 or 4 bytes; vertices are read where the scene has them.
    EXPECT_GE(memory.targets, 96u * 64u * (4 * (4 + 4) + 3));
    EXPECT_LE(memory.targets, 96u * 64u * (4 * (4 + 4) + 4));
    EXPECT_EQ(memory.scene, 0u) << "without textures";
    return;
  }
  // 4 samples of depth (4 bytes), surface (16 bytes) and place on what shading shows (8), and one picture of 4 bytes.
  EXPECT_EQ(memory.targets, 96u * 64u * (4 * (4 + 16 + 8) + 4));
  EXPECT_GT(memory.scene, 24u * 12u) << "the box's vertices alone";
}

/// The memory of a small frame of the box; `rest`: members of its spec.
MemoryReport memoryWith(const std::string& rest, std::uint64_t* atlasTexels = nullptr) {
  const Frame frame = renderJson(testing::generatedScene("box_on_plane"), R"({"width":96,"height":64,)" + rest + "}");
  if (atlasTexels != nullptr) {
    *atlasTexels =
        static_cast<std::uint64_t>(frame.report.atlasSize[0]) * static_cast<std::uint64_t>(frame.report.atlasSize[1]);
  }
  return frame.report.memory;
}

TEST(FrameReports, MemoryHoldsWhatShadowsAreTracedWith) {
  const std::uint64_t pixels = 96 * 64;
  const std::string sun = R"("lights":[{"sun":{}}],"shadow":)";
  const std::uint64_t unshadowed = memoryWith(sun + R"({"enabled":false})").targets;
  const std::uint64_t traced = memoryWith(sun + R"({"technique":"rayTraced"})").targets;
  EXPECT_GE(traced, unshadowed + 2 * pixels) << "a layer of 16 bits a pixel or more";
  if (testing::testedDevice() == DeviceChoice::cpu) return;
  // 4 samples of a triangle's number (4 bytes) and of a light's share (2 bytes).
  EXPECT_EQ(traced, unshadowed + pixels * 4 * (4 + 2));
}

TEST(FrameReports, MemoryHoldsWhatViewsOfTilesAreMadeFrom) {
  if (testing::testedDevice() == DeviceChoice::cpu) GTEST_SKIP() << "shows them from the tiles that it has";
  std::uint64_t texels = 0;
  const std::uint64_t shares = memoryWith(R"("lights":[{"sun":{}}],"views":["shadow"])").targets;
  const std::uint64_t casters = memoryWith(R"("lights":[{"sun":{}}],"views":["casterIds"])", &texels).targets;
  ASSERT_GT(texels, 0u);
  EXPECT_EQ(casters, shares + texels * (4 + 4)) << "a node and its depth a texel";
  const std::string atlas = R"("lights":[{"sun":{}}],"views":["atlas"],"atlas":{"samples":)";
  const std::uint64_t plain = memoryWith(atlas + "1}").targets;
  EXPECT_EQ(memoryWith(atlas + "4}", &texels).targets, plain + texels * 4) << "one depth of several";
}

TEST(FrameReports, X20_X24_ASequenceKeepsItsRangeAndItsTexels) {
  const ScenePtr scene = testing::generatedScene("long_row");
  Json spec = Json::parse(R"({"width":96,"height":64,"camera":{"eye":[0,3,6],"target":[0,1,-30]},
      "lights":[{"sun":{}}],"shadow":{"stabilization":"projectionSnapping"}})");
  const auto first = renderJson(scene, spec.dump()).report.lights[0];
  EXPECT_NE(first.note.find("ignored"), std::string::npos) << "nothing was before it";
  ASSERT_TRUE(first.depthRange);
  spec["shadow"]["depthRange"]["previous"] = {{"near", first.depthRange->near}, {"far", first.depthRange->far}};
  std::vector<LightReport> later;
  for (const double step : {0.0, 0.13, 0.4, 0.77}) {
    spec["camera"]["eye"] = {step, 3, 6 - step};
    spec["camera"]["target"] = {step, 1, -30 - step};
    later.push_back(renderJson(scene, spec.dump()).report.lights[0]);
    EXPECT_EQ(later.back().depthRange, first.depthRange) << step;
    EXPECT_EQ(later.back().note.find("anew"), std::string::npos) << later.back().note;
    for (std::size_t i = 0; i < later.back().tiles.size(); ++i) {
      if (later.back().tiles[i].tile[2] == 0 || later.front().tiles[i].tile[2] == 0) continue;
      EXPECT_EQ(later.back().tiles[i].texelSize, later.front().tiles[i].texelSize) << step << ' ' << i;
    }
  }
}

} // namespace
} // namespace gnomon
