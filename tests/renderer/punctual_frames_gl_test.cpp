// Planes that must not shadow themselves in any light, in rendered frames.
#include <cmath>

#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

/// The unit plane, scaled to 20 m and turned about X.
testing::GlbBuilder tiltedPlane(double degrees) {
  testing::GlbBuilder builder = testing::plane();
  const double half = degrees * 3.14159265358979 / 360;
  builder.json["nodes"][0]["rotation"] = {std::sin(half), 0, 0, std::cos(half)};
  builder.json["nodes"][0]["scale"] = {10, 10, 10};
  return builder;
}

std::ptrdiff_t darkPixels(const Frame& frame, float below) {
  const auto& visibility = floatsOf(frame);
  return std::count_if(visibility.begin(), visibility.end(), [below](float v) { return v < below; });
}

/// Four moments in 32 bits leave so few digits that rounding alone decides in single pixels; which, differs by device.
std::ptrdiff_t darkByRounding(const Json& filter) {
  const bool differs = testing::testedDevice() == DeviceChoice::cpu || testing::drawnByGpu();
  return filter.at("type") == "msm" && differs ? 2 : 0;
}

/// What a plane tilted by that much shows of one light's shadow, seen from its lit side.
Json planeSpec(double degrees, const Json& light, const Json& filter, const std::string& size, double lift = 4) {
  const double angle = degrees * 3.14159265358979 / 180;
  return {
      {"width", 160},
      {"height", 160},
      {"camera",
       {{"eye", {1.7, std::cos(angle) * 15 - std::sin(angle) * lift, std::sin(angle) * 15 + std::cos(angle) * lift}},
        {"target", {0, 0, 0}},
        {"up", {0.1, 0, -1}}}},
      {"lights", {light}},
      {"shadow", {{"filter", filter}, {"size", size}}},
      {"antialiasing", "none"},
      {"views", {"shadow"}},
      {"output", {{"format", "exr"}}}};
}

TEST(PunctualFrames, H4_NoAcneOnPlanesOfAnyTilt) {
  const Json lights = Json::parse(R"([
      {"type":"point","radius":0.2,"position":[1,8,2]},
      {"type":"spot","radius":0.2,"position":[1,8,2],"direction":[-0.1,-1,-0.2],"outerConeDegrees":40},
      {"type":"spot","radius":0.2,"position":[1,8,2],"direction":[-0.1,-1,-0.2],"outerConeDegrees":80}])");
  for (const double degrees : {0.0, 20.0, 45.0, 75.0, 85.0, 89.0}) {
    const ScenePtr scene = testing::sceneOf(tiltedPlane(degrees));
    for (const Json& light : lights) {
      for (const Json& filter : testing::everyFilter()) {
        const Frame frame = renderJson(scene, planeSpec(degrees, light, filter, "Small").dump());
        EXPECT_EQ(darkPixels(frame, 0.999f), 0) << degrees << " degrees, " << light << ' ' << filter;
      }
    }
  }
}

TEST(ShadowFrames, H4_NoAcneOnPlanesOfAnyTilt) {
  const Json sun = {{"type", "directional"}, {"direction", {0.03, -1, 0}}, {"angularDiameterDegrees", 1}};
  for (const double degrees : {0.0, 7.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.0}) {
    const ScenePtr scene = testing::sceneOf(tiltedPlane(degrees));
    for (const Json& filter : testing::everyFilter()) {
      for (const double lift : {2.0, 30.0}) {
        for (const int cascades : {1, 4}) {
          Json spec = planeSpec(degrees, sun, filter, "Small", lift);
          spec["shadow"]["cascadeCount"] = cascades;
          EXPECT_LE(darkPixels(renderJson(scene, spec.dump()), 0.999f), darkByRounding(filter))
              << degrees << " degrees, " << filter << ", lift " << lift << ", " << cascades;
        }
      }
    }
  }
}

TEST(PunctualFrames, X24_H4_NoAcneWhereFacesAreStabilized) {
  const Json lights = Json::parse(R"([
      {"type":"point","radius":0.1,"position":[1,3,2]},
      {"type":"spot","radius":0.1,"position":[1,3,2],"direction":[-0.1,-1,-0.2],"outerConeDegrees":40,"range":12},
      {"type":"spot","radius":0.1,"position":[1,3,2],"direction":[-0.1,-1,-0.2],"outerConeDegrees":85}])");
  for (const double degrees : {0.0, 30.0, 60.0}) {
    const ScenePtr scene = testing::sceneOf(tiltedPlane(degrees));
    for (const Json& light : lights) {
      for (const Json& filter : testing::everyFilter()) {
        Json spec = planeSpec(degrees, light, filter, "Large");
        spec["shadow"]["stabilization"] = "projectionSnapping";
        const Frame frame = renderJson(scene, spec.dump());
        EXPECT_LE(darkPixels(frame, 0.999f), darkByRounding(filter)) << degrees << ' ' << light << ' ' << filter;
        EXPECT_EQ(darkPixels(frame, 0.9f), 0) << degrees << ' ' << light << ' ' << filter;
      }
    }
  }
}

TEST(PunctualFrames, G5_H4_NoAcneUnderAnOrthographicCameraOfGreatDepth) {
  const ScenePtr scene = testing::sceneOf(tiltedPlane(0));
  for (
      const Json& light : Json::parse(
          R"([{"type":"point","radius":0.2,"position":[0,2,-2]},{"type":"directional","direction":[0,-1,0],"angularDiameterDegrees":3},
      {"type":"spot","radius":0.2,"position":[0,2,-2],"direction":[0,-1,0],"outerConeDegrees":50}])")) {
    for (const Json& filter : testing::everyFilter()) {
      Json spec = planeSpec(0, light, filter, "Small");
      spec["camera"] = {{"eye", {0, 8, 0}},
                        {"target", {0, 0, 0}},
                        {"up", {0, 0, -1}},
                        {"orthographic", {{"height", 20}, {"near", 0}, {"far", 5000}}}};
      EXPECT_EQ(darkPixels(renderJson(scene, spec.dump()), 0.999f), 0) << light << ' ' << filter;
    }
  }
}

TEST(PunctualFrames, X32_NoSeamShowsWhereFacesMeet) {
  // Close over a plane, every edge and corner of the light's cube falls on it somewhere.
  for (const double degrees : {0.0, 30.0, 50.0}) {
    const ScenePtr scene = testing::sceneOf(tiltedPlane(degrees));
    const double angle = degrees * 3.14159265358979 / 180;
    for (const double height : {0.7, 2.0, 5.0}) {
      const Json light = {
          {"type", "point"}, {"radius", 0.1}, {"position", {0.3, height * std::cos(angle), height * std::sin(angle)}}};
      for (const char* size : {"XSmall", "Small", "Large"}) {
        for (const Json& filter : testing::everyFilter()) {
          const Frame frame = renderJson(scene, planeSpec(degrees, light, filter, size).dump());
          EXPECT_LE(darkPixels(frame, 0.999f), darkByRounding(filter))
              << degrees << " degrees, " << height << " m, " << size << filter;
          EXPECT_EQ(darkPixels(frame, 0.9f), 0) << degrees << " degrees, " << height << " m, " << size << filter;
        }
      }
    }
  }
}

} // namespace
} // namespace gnomon
