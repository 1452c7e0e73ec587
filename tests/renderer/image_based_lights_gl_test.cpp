// A glTF's own light from all around in frames of both devices: what it lights, what is mirrored, what is seen behind,
// and what a request says against it.
#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_cube.h"
#include "tests/renderer/made_environment.h"
#include "tests/renderer/smooth_mesh.h"

namespace gnomon {
namespace {

using testing::floatsOf;

constexpr DeviceChoice kDevices[] = {DeviceChoice::cpu, DeviceChoice::gl};

Renderer& rendererOf(DeviceChoice device) {
  const auto made = [](DeviceChoice choice) {
    auto renderer = Renderer::create({.backend = {.device = choice}});
    if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
    return std::move(*renderer);
  };
  static Renderer cpu = made(DeviceChoice::cpu);
  static Renderer gl = made(DeviceChoice::gl);
  return device == DeviceChoice::cpu ? cpu : gl;
}

Result<Frame> asked(DeviceChoice device, const ScenePtr& scene, const Json& json) {
  const auto spec = decodeFrameSpec(json.dump());
  if (!spec) return spec.problems();
  return rendererOf(device).render(scene, *spec);
}

Frame drawn(DeviceChoice device, const ScenePtr& scene, const Json& json) {
  auto frame = asked(device, scene, json);
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  return frame ? std::move(*frame) : Frame{};
}

glm::dvec3 colorAt(const Frame& frame, int x, int y) {
  const Image& image = frame.images.at(0).image;
  const float* pixel = &floatsOf(frame)[static_cast<std::size_t>(y * image.width + x) * image.channels.size()];
  return {pixel[0], pixel[1], pixel[2]};
}

/// Another color on each face, up to 6, in the order of the file: those of +X, -X, +Y, -Y, +Z and -Z of its cube, whose
/// +Z is the glTF's -Z.
constexpr std::array<glm::dvec3, 6> kFaceColors{
    {{6, 0.25, 0.25}, {0.25, 4, 0.25}, {0.25, 0.25, 3}, {2, 2, 0.25}, {0.25, 1.5, 1.5}, {1, 0.25, 1}}};
constexpr std::array<glm::dvec3, 6> kFaceWays{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}}};

glm::dvec3 ofFaces(const glm::dvec3& towards) {
  std::size_t face = 0;
  for (std::size_t i = 1; i < 6; ++i) {
    if (glm::dot(kFaceWays[i], towards) > glm::dot(kFaceWays[face], towards)) face = i;
  }
  return kFaceColors[face];
}

/// Of a smooth light: mean and slope.
const glm::dvec3 kSlope(1, 2, -1.5);
glm::dvec3 sloping(const glm::dvec3& towards) {
  return glm::dvec3(4 + glm::dot(kSlope, towards));
}

/// A ball at the origin in light 0, of `radiance`; `change` the light.
testing::GlbBuilder ballIn(const testing::Radiance& radiance, double metallic, const Json& change = Json::object(),
                           const Json& coefficients = testing::coefficientsOf(4, kSlope)) {
  testing::GlbBuilder builder;
  const int mesh = testing::addSmoothBall(builder, 128, 64);
  const Json material{{"pbrMetallicRoughness", {{"metallicFactor", metallic}, {"roughnessFactor", 1 - metallic}}}};
  builder.json["meshes"][std::size_t(mesh)]["primitives"][0]["material"] = builder.add("materials", material);
  builder.addRoot({{"mesh", mesh}});
  const int light = testing::addImageBasedLight(builder, 64, radiance, coefficients);
  testing::lightScene(builder, light);
  builder.json["extensions"]["EXT_lights_image_based"]["lights"][std::size_t(light)].merge_patch(change);
  return builder;
}

/// Floats, of a camera at `eye`, that looks at the origin or along `ahead`.
Json specOf(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 ahead = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(ahead.y) > 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const auto triple = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
  return {{"width", 64},
          {"height", 64},
          {"camera", {{"eye", triple(eye)}, {"target", triple(target)}, {"up", triple(up)}}},
          {"environment", {{"background", "environment"}, {"extractSun", "none"}}},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

void expectColor(const glm::dvec3& color, const glm::dvec3& wanted, double share, const std::string& what) {
  EXPECT_LT(glm::length(color - wanted), share * glm::length(wanted))
      << what << ": " << color.x << ' ' << color.y << ' ' << color.z << " not " << wanted.x << ' ' << wanted.y << ' '
      << wanted.z;
}

TEST(ImageBasedLightFrames, EachFaceIsSeenBehindAndMirroredWhereItLies) {
  const ScenePtr scene = testing::sceneOf(ballIn(ofFaces, 1));
  for (const DeviceChoice device : kDevices) {
    for (std::size_t face = 0; face < 6; ++face) {
      const std::string what = std::to_string(face);
      const Frame away = drawn(device, scene, specOf(50.0 * kFaceWays[face], 60.0 * kFaceWays[face]));
      expectColor(colorAt(away, 32, 32), kFaceColors[face], 0.03, "behind " + what);
      // The middle of the ball mirrors what lies behind the eye.
      const Frame at = drawn(device, scene, specOf(6.0 * kFaceWays[face], {}));
      expectColor(colorAt(at, 32, 32), kFaceColors[face], 0.05, "mirrored " + what);
    }
  }
}

TEST(ImageBasedLightFrames, TheReportNamesItAndAskedForAgainTheFrameIsTheSame) {
  const ScenePtr scene = testing::sceneOf(ballIn(sloping, 0));
  for (const DeviceChoice device : kDevices) {
    const Frame frame = drawn(device, scene, specOf({0, 3, 6}, {}));
    const FrameSpec& spec = frame.report.spec;
    EXPECT_EQ(spec.environment.light, 0);
    EXPECT_FALSE(spec.environment.studio);
    EXPECT_TRUE(spec.lights->empty()) << "no sun besides";
    ASSERT_TRUE(frame.report.environment);
    EXPECT_EQ(frame.report.environment->width, 256);
    EXPECT_NEAR(frame.report.environment->meanRadiance, 4, 0.05);
    EXPECT_TRUE(frame.report.warnings.empty()) << frame.report.warnings[0];
    EXPECT_EQ(floatsOf(drawn(device, scene, toJson(spec))), floatsOf(frame));
  }
}

TEST(ImageBasedLightFrames, AMattBallGetsTheIrradianceOfThePictureTurnedAndMultiplied) {
  const glm::dquat q = glm::angleAxis(2.0, glm::normalize(glm::dvec3(1, 0.5, -2)));
  const glm::dmat3 turn = glm::mat3_cast(q);
  const ScenePtr scene =
      testing::sceneOf(ballIn(sloping, 0, {{"rotation", {q.x, q.y, q.z, q.w}}, {"intensity", 0.25}}));
  const auto ofRadiance = [&](const glm::dvec3& towards) { // over pi, of a surface that faces there
    return 0.25 * (4 + 2.0 / 3 * glm::dot(turn * kSlope, towards));
  };
  for (const DeviceChoice device : kDevices) {
    for (const glm::dvec3& way : kFaceWays) {
      Json spec = specOf(6.0 * way, {});
      const double once = colorAt(drawn(device, scene, spec), 32, 32).x;
      // White paper in this light, and what it reflects besides as a dielectric: between 0.96 and 1.04 of it.
      EXPECT_NEAR(once / ofRadiance(way), 1, 0.05) << way.x << ' ' << way.y << ' ' << way.z;
      // The request turns it clockwise from above besides, and multiplies it.
      spec["environment"].merge_patch({{"rotationDegrees", 90}, {"intensity", 3}});
      const glm::dvec3 before(way.z, way.y, -way.x);
      const double turned = colorAt(drawn(device, scene, spec), 32, 32).x;
      EXPECT_NEAR(turned / (3 * ofRadiance(before)), 1, 0.05) << way.x << ' ' << way.y << ' ' << way.z;
    }
  }
}

TEST(ImageBasedLightFrames, ATurnOfTheFileMovesWhatIsSeen) {
  // A quarter about +Y, as glTF turns nodes: what lay towards +X lies towards -Z.
  const double half = std::sqrt(0.5);
  const ScenePtr scene = testing::sceneOf(ballIn(ofFaces, 1, {{"rotation", {0, half, 0, half}}}));
  for (const DeviceChoice device : kDevices) {
    expectColor(colorAt(drawn(device, scene, specOf({0, 0, -50}, {0, 0, -60})), 32, 32), kFaceColors[0], 0.03, "+X");
    expectColor(colorAt(drawn(device, scene, specOf({50, 0, 0}, {60, 0, 0})), 32, 32), kFaceColors[5], 0.03, "-Z");
  }
}

TEST(ImageBasedLightFrames, WhatARequestNamesComesFirst) {
  testing::GlbBuilder builder = ballIn(sloping, 0);
  const auto dim = [](const glm::dvec3&) { return glm::dvec3(0.5); };
  testing::addImageBasedLight(builder, 8, dim, testing::coefficientsOf(0.5, {}));
  SceneBundle bundle = builder.bundle();
  bundle.files["white.hdr"] = testing::hdrFile(16, [](const glm::dvec3&) { return glm::dvec3(1); });
  const ScenePtr scene = testing::sceneOf(bundle);
  SceneBundle plain = bundle;
  testing::GlbBuilder without = builder;
  without.json["scenes"][0].erase("extensions");
  plain.model = without.glb();
  const ScenePtr unlit = testing::sceneOf(plain);
  for (const DeviceChoice device : kDevices) {
    Json spec = specOf({0, 3, 6}, {});
    spec["lights"] = Json::array();
    const auto with = [&](const Json& environment) {
      Json changed = spec;
      changed["environment"] = environment;
      return changed;
    };
    for (const Json& environment : {Json{{"studio", "even"}},
                                    {{"studio", "lamps"}},
                                    {{"file", "white.hdr"}},
                                    {{"sky", Json::object()}},
                                    {{"light", 1}}}) {
      const Frame frame = drawn(device, scene, with(environment));
      EXPECT_EQ(floatsOf(frame), floatsOf(drawn(device, unlit, with(environment)))) << environment;
      EXPECT_NE(frame.report.spec.environment.light, 0) << environment;
    }
    EXPECT_NE(floatsOf(drawn(device, scene, spec)), floatsOf(drawn(device, unlit, spec)));
    EXPECT_EQ(
        floatsOf(drawn(device, scene, spec)),
        floatsOf(drawn(device, scene, with({{"light", 0}, {"background", "environment"}, {"extractSun", "none"}}))));
    // A scene whose glTF gives it none is in the studio, and says so.
    EXPECT_EQ(drawn(device, unlit, spec).report.spec.environment.studio, Studio::lamps);
    // With the studio there is the usual sun, with a light none.
    Json open = with({{"studio", "even"}});
    open.erase("lights");
    EXPECT_EQ(drawn(device, scene, open).report.spec.lights->size(), 1u);
  }
}

TEST(ImageBasedLightFrames, ItsSunBecomesALight) {
  const glm::dvec3 towards = glm::normalize(glm::dvec3(1, 1.2, 0.4));
  const auto sunny = [&](const glm::dvec3& d) {
    return glm::dot(d, towards) > std::cos(glm::radians(1.6)) ? glm::dvec3(250) : glm::dvec3(0.02);
  };
  testing::GlbBuilder builder = testing::cube();
  testing::lightScene(builder, testing::addImageBasedLight(builder, 64, sunny, testing::coefficientsOf(0.02, {})));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const DeviceChoice device : kDevices) {
    Json spec = specOf({0, 3, 6}, {});
    spec["environment"] = Json::object();
    const Frame frame = drawn(device, scene, spec);
    ASSERT_EQ(frame.report.spec.lights->size(), 1u);
    const auto& way = *frame.report.spec.lights->front().direction;
    EXPECT_LT(glm::dot(glm::dvec3(way[0], way[1], way[2]), towards), -std::cos(glm::radians(1.0)));
    ASSERT_EQ(frame.report.warnings.size(), 1u) << "what it states leaves the sun out";
    EXPECT_NE(frame.report.warnings[0].find("irradianceCoefficients"), std::string::npos);
  }
}

TEST(ImageBasedLightFrames, RaysFindWhatTheSceneHidesOfIt) {
  testing::GlbBuilder builder = testing::plane();
  // A wall without end, to a floor's point at its foot: half of the sky is hidden.
  const int wall = builder.addMesh(
      {{"attributes",
        {{"POSITION", builder.addPoints({{-1, 0, -1000}, {-1, 0, 1000}, {-1, 2000, 1000}, {-1, 2000, -1000}})}}},
       {"indices", builder.addIndices({0, 1, 2, 0, 2, 3})}});
  builder.addRoot({{"mesh", wall}});
  const auto even = [](const glm::dvec3&) { return glm::dvec3(1); };
  testing::lightScene(builder, testing::addImageBasedLight(builder, 8, even, testing::coefficientsOf(1, {})));
  const ScenePtr scene = testing::sceneOf(builder);
  for (const DeviceChoice device : kDevices) {
    Json spec = specOf({0, 3, 0}, {0, 0, 0});
    spec["camera"]["up"] = {0, 0, -1};
    spec["camera"]["orthographic"] = {{"height", 1.9}};
    const Frame open = drawn(device, scene, spec);
    spec["environment"].merge_patch({{"shadows", "rays"}, {"samples", 64}});
    const Frame hidden = drawn(device, scene, spec);
    const double atFoot = colorAt(hidden, 1, 32).x / colorAt(open, 1, 32).x;
    EXPECT_GT(atFoot, 0.45);
    EXPECT_LT(atFoot, 0.62);
  }
}

TEST(ImageBasedLightFrames, BadOnesAreProblemsOfTheirPlace) {
  const ScenePtr scene = testing::sceneOf(ballIn(sloping, 0));
  const auto problemOf = [](const ScenePtr& of, const Json& environment) {
    Json spec = specOf({0, 3, 6}, {});
    spec["environment"] = environment;
    auto frame = asked(DeviceChoice::cpu, of, spec);
    return frame ? Problem{} : frame.problems().front();
  };
  EXPECT_EQ(problemOf(scene, {{"light", 1}}).pointer, "/environment/light");
  EXPECT_EQ(problemOf(scene, {{"light", 1}}).limit, "0..0");
  EXPECT_EQ(problemOf(testing::sceneOf(testing::cube()), {{"light", 0}}).limit, "none");
  EXPECT_EQ(problemOf(scene, {{"light", -1}}).pointer, "/environment/light");
  const Problem two = problemOf(scene, {{"light", 0}, {"sky", Json::object()}});
  EXPECT_EQ(two.pointer, "/environment");
  // What only decoding finds.
  testing::GlbBuilder clear = ballIn(sloping, 0);
  const Bytes picture = testing::pngOfTexels(64, 64, std::vector(4096, std::array<std::uint8_t, 4>{9, 9, 9, 0}));
  clear.json["images"][2]["bufferView"] = clear.addView(picture);
  const Problem found = problemOf(testing::sceneOf(clear), Json::object());
  EXPECT_EQ(found.pointer, "/environment/light");
  EXPECT_NE(found.detail.find("/images/2"), std::string::npos) << found.detail;
  EXPECT_EQ(problemOf(testing::sceneOf(clear), {{"studio", "even"}}).detail, "");
}

} // namespace
} // namespace gnomon
