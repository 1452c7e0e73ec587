// View sunHours of whole frames, held against what the sun's places alone say.
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <set>

#include "protocol/spec/sun_steps.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;
using testing::sceneOf;

constexpr int kSide = 100;
constexpr double kWall = 2; ///< metres that it stands south of the middle
constexpr double kRadians = 0.017453292519943295;

/// Straight down on 10 m, 10 pixels a metre, north (-Z) upwards.
Json fromAbove(const Json& patch = Json::object()) {
  Json spec{
      {"width", kSide},
      {"height", kSide},
      {"camera", {{"eye", {0, 8, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 10}}}}},
      {"lights", Json::array()},
      {"views", {"sunHours"}},
      {"sunHours",
       {{"latitudeDegrees", 48.1},
        {"longitudeDegrees", 11.6},
        {"begin", "2026-03-20T00:00Z"},
        {"end", "2026-03-21T00:00Z"},
        {"stepMinutes", 5}}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  spec.merge_patch(patch);
  return spec;
}

SunHours asked(const Json& spec) {
  return *decodeFrameSpec(spec.dump())->sunHours;
}

testing::GlbBuilder field() {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {40, 1, 40};
  return builder;
}

/// A field, and on it a wall 1 m high and 20 km long, from east to west.
testing::GlbBuilder fieldWithWall() {
  testing::GlbBuilder builder = field();
  builder.addRoot({{"mesh", 0},
                   {"translation", {0, 0, kWall}},
                   {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},
                   {"scale", {10'000, 1, 1}}});
  return builder;
}

double daylightOf(const SunHours& hours) {
  double sum = 0;
  for (const SunStep& step : sunSteps(hours)) sum += step.hours;
  return sum;
}

/// Of a point so far north of the wall, metres: negative = south of it.
double hoursBehindWall(const SunHours& hours, double distance) {
  double sum = 0;
  for (const SunStep& step : sunSteps(hours)) {
    const double south = -std::cos(*step.sun.azimuthDegrees * kRadians);
    const double rise = std::tan(*step.sun.elevationDegrees * kRadians) * distance / south; // where the ray meets it
    if (!(rise >= 0 && rise < 1)) sum += step.hours;
  }
  return sum;
}

TEST(SunHours, BehindAWallTheyAreTheStepsInWhichTheSunIsHigherThanTheWall) {
  // In winter shadows are long, and of another length all day.
  const Json spec = fromAbove({{"sunHours", {{"begin", "2026-12-20T00:00Z"}, {"end", "2026-12-21T00:00Z"}}}});
  const Frame frame = renderJson(sceneOf(fieldWithWall()), spec.dump());
  ASSERT_EQ(floatsOf(frame).size(), std::size_t{kSide} * kSide);
  std::set<float> different;
  for (std::size_t row = 0; row < kSide; ++row) {
    const double distance = kWall - (-5 + (static_cast<double>(row) + 0.5) / 10);
    for (const std::size_t column : {0u, 37u, 99u}) {
      const float hours = floatsOf(frame)[row * kSide + column];
      EXPECT_NEAR(hours, hoursBehindWall(asked(spec), distance), 1e-4) << distance;
      different.insert(hours);
    }
  }
  EXPECT_GT(different.size(), 20u);
}

TEST(SunHours, AnOpenFieldHasAllOfTheDaylight) {
  const Json spec = fromAbove();
  const Frame frame = renderJson(sceneOf(field()), spec.dump());
  const double daylight = daylightOf(asked(spec));
  EXPECT_NEAR(daylight, 12 + 9 / 60.0, 5 / 60.0 + 1e-9) << "published: 05:18 to 17:27 UTC, by the sun's upper edge";
  for (const float hours : floatsOf(frame)) ASSERT_FLOAT_EQ(hours, static_cast<float>(daylight));
  const auto& report = frame.report.sunHours;
  ASSERT_TRUE(report);
  EXPECT_EQ(report->steps, static_cast<int>(sunSteps(asked(spec)).size()));
  for (const double each : {report->daylightHours, report->meanHours, report->minHours, report->maxHours}) {
    EXPECT_NEAR(each, daylight, 1e-9);
  }
}

TEST(SunHours, ANightHasNoneAndWhatIsNoSurfaceHasNoNumber) {
  const Json night = {{"begin", "2026-03-20T20:00Z"}, {"end", "2026-03-21T02:00Z"}};
  const Frame frame = renderJson(sceneOf(testing::plane()), fromAbove({{"sunHours", night}}).dump());
  std::size_t dark = 0;
  for (const float hours : floatsOf(frame)) {
    ASSERT_TRUE(hours == 0 || hours == -1);
    dark += hours == 0 ? 1 : 0;
  }
  EXPECT_EQ(dark, 20u * 20);
  EXPECT_EQ(frame.report.sunHours->daylightHours, 0);
}

TEST(SunHours, ABlendedCasterLetsThroughWhatItDoesNotStop) {
  testing::GlbBuilder builder = field();
  const int material = builder.add(
      "materials", {{"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}});
  Json primitive = builder.json["meshes"][0]["primitives"][0];
  primitive["material"] = material;
  builder.addRoot({{"mesh", builder.addMesh(primitive)}, {"translation", {0, 20, 0}}, {"scale", {10'000, 1, 10'000}}});
  const Json spec = fromAbove();
  const Frame frame = renderJson(sceneOf(builder), spec.dump());
  const double daylight = daylightOf(asked(spec));
  EXPECT_NEAR(floatsOf(frame)[kSide * kSide / 2], 0.75 * daylight, 0.01 * daylight);
}

TEST(SunHours, BothDevicesGiveTheSameNumbers) {
  const ScenePtr scene = sceneOf(fieldWithWall());
  auto renderer = Renderer::create({.backend = {.device = DeviceChoice::cpu}});
  ASSERT_TRUE(renderer);
  const auto byProcessor = renderer->render(scene, *decodeFrameSpec(fromAbove().dump()));
  ASSERT_TRUE(byProcessor);
  EXPECT_EQ(floatsOf(renderJson(scene, fromAbove().dump())), floatsOf(*byProcessor));
}

TEST(SunHours, APictureHasAScaleInItsCorner) {
  const Json spec = fromAbove({{"width", 320}, {"height", 240}, {"output", {{"format", "png"}}}});
  const Frame frame = renderJson(sceneOf(field()), spec.dump());
  const auto& bytes = std::get<std::vector<std::uint8_t>>(frame.images[0].image.pixels);
  const auto at = [&](std::size_t x, std::size_t y) {
    const std::size_t first = (y * 320 + x) * 3;
    return glm::ivec3(bytes[first], bytes[first + 1], bytes[first + 2]);
  };
  EXPECT_EQ(at(0, 239), glm::ivec3(0)) << "its ground";
  const auto apart = [&](std::size_t x) { return glm::length(glm::vec3(at(x, 218) - at(319, 0))); };
  EXPECT_LT(apart(171), 6) << "its last color is that of all hours";
  EXPECT_GT(apart(12), 60);
}

} // namespace
} // namespace gnomon
