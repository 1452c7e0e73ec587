// Environments in frames of both devices: what they light, what is mirrored, and what is seen behind.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <nlohmann/json.hpp>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_environment.h"
#include "tests/renderer/made_grids.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::floatsOf;

Renderer madeFor(DeviceChoice device) {
  auto renderer = Renderer::create({.backend = {.device = device}});
  if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
  return std::move(*renderer);
}

constexpr DeviceChoice kDevices[] = {DeviceChoice::cpu, DeviceChoice::gl};

Renderer& rendererBy(DeviceChoice device) {
  static Renderer cpu = madeFor(DeviceChoice::cpu);
  static Renderer gl = madeFor(DeviceChoice::gl);
  return device == DeviceChoice::cpu ? cpu : gl;
}

Frame drawn(DeviceChoice device, const ScenePtr& scene, const Json& json) {
  const auto spec = decodeFrameSpec(json.dump());
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  if (!spec) return {};
  auto frame = rendererBy(device).render(scene, *spec);
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  return frame ? std::move(*frame) : Frame{};
}

/// A row of balls: a mirror, rough metal, matt and glossy plastic, what lets light through, and mixed metal and
/// plastic. Files: white.hdr, of radiance 1, and colors.hdr, of half of (1 + direction).
ScenePtr ballScene(const Json& color = {1, 1, 1}, double transmission = 1) {
  testing::GlbBuilder builder;
  int next = 0;
  const auto addBall = [&](double metallic, double roughness, double through) {
    Json material{{"pbrMetallicRoughness",
                   {{"baseColorFactor", {color[0], color[1], color[2], 1}},
                    {"metallicFactor", metallic},
                    {"roughnessFactor", roughness}}}};
    if (through > 0) {
      material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", through}};
    }
    const int mesh = testing::addSmoothBall(builder, 128, 64);
    builder.json["meshes"][std::size_t(mesh)]["primitives"][0]["material"] = builder.add("materials", material);
    builder.addRoot({{"mesh", mesh}, {"translation", {2.2 * (next % 3) - 2.2, 0, 2.2 * (next / 3)}}});
    ++next;
  };
  addBall(1, 0, 0);
  addBall(1, 0.4, 0);
  addBall(0, 1, 0);
  addBall(0, 0.1, 0);
  addBall(0, 0.3, transmission);
  addBall(0.5, 0.7, 0);
  SceneBundle bundle = builder.bundle();
  bundle.files["white.hdr"] = testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); });
  bundle.files["colors.hdr"] = testing::hdrFile(256, [](const glm::dvec3& d) { return 0.5 * (1.0 + d); });
  return testing::sceneOf(bundle);
}

Json specOf(const Json& more) {
  Json spec{{"width", 240},
            {"height", 160},
            {"camera", {{"eye", {2, 5, 9}}, {"target", {0, 0, 1}}}},
            {"lights", Json::array()},
            {"environment", {{"file", "colors.hdr"}, {"extractSun", "none"}}}};
  spec.merge_patch(more);
  return spec;
}

const Json kFloats{{"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};

std::vector<int> levelsBetween(const Frame& a, const Frame& b) {
  const auto& left = std::get<std::vector<std::uint8_t>>(a.images.at(0).image.pixels);
  const auto& right = std::get<std::vector<std::uint8_t>>(b.images.at(0).image.pixels);
  std::vector<int> levels(left.size());
  for (std::size_t i = 0; i < left.size(); ++i) levels[i] = std::abs(int(left[i]) - int(right[i]));
  return levels;
}

double percentOver(const std::vector<int>& levels, int over) {
  const auto count = std::count_if(levels.begin(), levels.end(), [over](int level) { return level > over; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(levels.size());
}

glm::vec3 colorAt(const Frame& frame, int x, int y) {
  const Image& image = frame.images.at(0).image;
  const float* pixel = &floatsOf(frame)[static_cast<std::size_t>(y * image.width + x) * image.channels.size()];
  return {pixel[0], pixel[1], pixel[2]};
}

TEST(EnvironmentFrames, BothDevicesShowTheSame) {
  const ScenePtr scene = ballScene({0.9, 0.6, 0.3});
  for (const char* antialiasing : {"none", "msaa4x"}) {
    for (const char* background : {"none", "environment", "blurred"}) {
      for (const Json& camera : {Json::object(), Json{{"orthographic", {{"height", 6}}}}}) {
        const Json sun{{"type", "directional"}, {"direction", {-1, -2, -1}}};
        Json spec = specOf({{"antialiasing", antialiasing}, {"lights", {sun}}, {"camera", camera}});
        spec["environment"].merge_patch({{"background", background}, {"rotationDegrees", 70}, {"intensity", 1.5}});
        const std::vector<int> levels =
            levelsBetween(drawn(DeviceChoice::cpu, scene, spec), drawn(DeviceChoice::gl, scene, spec));
        EXPECT_LE(percentOver(levels, 1), 0.5) << spec;
        EXPECT_LE(percentOver(levels, 4), 0.1) << spec;
      }
    }
  }
}

TEST(EnvironmentFrames, WhiteBallsVanishInAWhiteFurnace) {
  const ScenePtr scene = ballScene({1, 1, 1}, 0); // what lets light through reflects some besides
  for (const DeviceChoice device : kDevices) {
    Json spec = specOf(kFloats);
    spec["environment"] = {{"file", "white.hdr"}, {"background", "environment"}, {"extractSun", "none"}};
    const Frame frame = drawn(device, scene, spec);
    float least = 9, most = 0;
    for (const float value : floatsOf(frame)) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
    EXPECT_GT(least, 0.99f);
    EXPECT_LT(most, 1.01f);
    // A gray one stands out.
    const Frame gray = drawn(device, ballScene({0.5, 0.5, 0.5}, 0), spec);
    EXPECT_LT(*std::min_element(floatsOf(gray).begin(), floatsOf(gray).end()), 0.8f);
  }
}

/// Of the corner of a plain picture, seen by a camera at the origin that looks along -Z.
TEST(EnvironmentFrames, TheBackgroundIsWhatComesAlongTheLineOfSight) {
  const ScenePtr scene = ballScene();
  struct Seen {
    Json camera;
    std::function<glm::dvec3(glm::dvec2 place)> sight; ///< place: -1..1, y up
  };
  const double up = std::tan(glm::radians(20.0));
  const auto lens = [&](glm::dvec2 p) { return glm::normalize(glm::dvec3(p.x * up * 1.5, p.y * up, -1)); };
  const Json place{{"eye", {0, 30, 0}}, {"target", {0, 30, -1}}};
  Json perspective = place, flat = place;
  perspective["perspective"] = {{"fovYDegrees", 40}};
  flat["orthographic"] = {{"height", 4}};
  for (const Seen& seen : {Seen{perspective, lens}, Seen{flat, [](glm::dvec2) { return glm::dvec3(0, 0, -1); }}}) {
    for (const double turn : {0.0, 90.0}) {
      for (const DeviceChoice device : kDevices) {
        Json spec = specOf(kFloats);
        spec["camera"] = seen.camera;
        spec["environment"].merge_patch({{"background", "environment"}, {"rotationDegrees", turn}, {"intensity", 2}});
        spec["background"] = {{"alpha", 0}};
        const Frame frame = drawn(device, scene, spec);
        const Image& image = frame.images.at(0).image;
        ASSERT_EQ(image.channels.size(), 4u);
        for (const glm::ivec2 pixel : {glm::ivec2(0, 0), {239, 0}, {120, 80}, {10, 150}, {200, 60}}) {
          const glm::dvec2 ndc((pixel.x + 0.5) / 120 - 1, 1 - (pixel.y + 0.5) / 80);
          const glm::dvec3 d = seen.sight(ndc);
          // By 90 degrees clockwise from above: what was towards +X is towards +Z.
          const glm::dvec3 inMap = turn == 0 ? d : glm::dvec3(d.z, d.y, -d.x);
          const glm::dvec3 off = glm::dvec3(colorAt(frame, pixel.x, pixel.y)) - (1.0 + inMap);
          EXPECT_LT(glm::length(off), 0.02) << seen.camera << ' ' << turn << ' ' << pixel.x << ' ' << pixel.y;
          EXPECT_EQ(floatsOf(frame)[std::size_t(4 * (240 * pixel.y + pixel.x) + 3)], 1.0f);
        }
      }
    }
  }
}

TEST(EnvironmentFrames, DataAndLightContributionDoNotKnowIt) {
  const ScenePtr scene = ballScene();
  for (const DeviceChoice device : kDevices) {
    for (const char* view : {"depth", "normal", "albedo", "lightContribution"}) {
      Json with = specOf(kFloats);
      with["lights"] = {{{"type", "directional"}, {"direction", {0, -1, 0}}}};
      with["views"] = {view};
      with["environment"]["background"] = "environment";
      Json without = with;
      without.erase("environment");
      EXPECT_EQ(floatsOf(drawn(device, scene, with)), floatsOf(drawn(device, scene, without))) << view;
    }
  }
}

TEST(EnvironmentFrames, TheStudioIsSeenAndScaledToo) {
  const ScenePtr scene = ballScene();
  for (const DeviceChoice device : kDevices) {
    Json plain = specOf(kFloats);
    plain.erase("environment");
    Json same = plain, half = plain, seen = plain, even = plain;
    same["environment"] = Json::object();
    half["environment"] = {{"intensity", 0.5}};
    seen["environment"] = {{"background", "environment"}};
    even["environment"] = {{"background", "environment"}, {"studio", "even"}};
    even["ambient"] = {{"intensity", 0.3}};
    const Frame full = drawn(device, scene, plain);
    EXPECT_EQ(floatsOf(drawn(device, scene, same)), floatsOf(full));
    const Frame dark = drawn(device, scene, half);
    const Frame behind = drawn(device, scene, seen);
    EXPECT_NEAR(colorAt(dark, 120, 80).x, 0.5f * colorAt(full, 120, 80).x, 1e-3f);
    EXPECT_NEAR(colorAt(behind, 120, 80).x, colorAt(full, 120, 80).x, 1e-5f);
    EXPECT_NEAR(colorAt(drawn(device, scene, even), 2, 2).x, 0.3 * 0.35, 0.01) << "the floor of the even studio";
  }
}

TEST(EnvironmentFrames, LampsOfTheStudioAreMirroredAndTurned) {
  const ScenePtr scene = ballScene({0.9, 0.6, 0.3});
  Json spec =
      specOf({{"ambient", {{"intensity", 0.5}}}, {"lights", {{{"type", "directional"}, {"sun", Json::object()}}}}});
  spec["environment"] = {{"studio", "lamps"}, {"rotationDegrees", 70}, {"background", "environment"}};
  const std::vector<int> levels =
      levelsBetween(drawn(DeviceChoice::cpu, scene, spec), drawn(DeviceChoice::gl, scene, spec));
  EXPECT_LE(percentOver(levels, 1), 0.5);
  EXPECT_LE(percentOver(levels, 4), 0.1);
  spec.merge_patch(kFloats);
  spec["lights"] = Json::array();
  for (const DeviceChoice device : kDevices) {
    const auto brightest = [&](const Json& environment) {
      Json asked = spec;
      asked["environment"] = environment;
      const Frame frame = drawn(device, scene, asked);
      return *std::max_element(floatsOf(frame).begin(), floatsOf(frame).end());
    };
    EXPECT_GT(brightest({{"studio", "lamps"}}), 1.3f * brightest({{"studio", "even"}})) << "a lamp in a mirror";
    EXPECT_EQ(brightest(Json::object()), brightest({{"studio", "lamps"}}));
    Json turned = spec;
    turned["environment"]["rotationDegrees"] = 250;
    EXPECT_NE(floatsOf(drawn(device, scene, spec)), floatsOf(drawn(device, scene, turned)));
  }
}

TEST(EnvironmentFrames, CloudsTakeItsMeanLight) {
  testing::GlbBuilder builder = testing::plane();
  SceneBundle bundle = builder.bundle();
  bundle.files["solid.npy"] = testing::byteGrid(3, 3, 3, [](int, int, int) { return 255; });
  bundle.files["half.hdr"] =
      testing::hdrFile(64, [](const glm::dvec3& d) { return d.y > 0 ? glm::dvec3(1) : glm::dvec3(0.5); });
  const ScenePtr scene = testing::sceneOf(bundle);
  const Json cloud = Json::parse(R"({"file": "solid.npy", "box": {"min": [-9, 2, -9], "max": [9, 20, 9]},
      "transferFunction": [{"value": 0, "extinction": 5}, {"value": 255, "color": [1, 1, 1], "extinction": 5}]})");
  Json spec{{"width", 32},
            {"height", 32},
            {"camera", {{"eye", {0, 40, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}}},
            {"lights", Json::array()},
            {"volumes", {cloud}},
            {"output", kFloats["output"]}};
  for (const DeviceChoice device : kDevices) {
    const float studio = colorAt(drawn(device, scene, spec), 16, 16).x;
    Json with = spec;
    with["environment"] = {{"file", "half.hdr"}, {"extractSun", "none"}, {"background", "environment"}};
    const Frame frame = drawn(device, scene, with);
    EXPECT_NEAR(colorAt(frame, 16, 16).x / studio, 0.75 / (0.580 * 0.6), 0.05);
  }
}

} // namespace
} // namespace gnomon
