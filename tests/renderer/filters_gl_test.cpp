// What the filters, the atlas' samples and the bias promise, seen in rendered frames.
#include <cmath>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

/// A ground of 100 m, and above it a board: `size` metres along x and z, `height` metres up, its middle at x, z.
ScenePtr boardOverGround(double x, double z, double sizeX, double sizeZ, double height) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 0}, {"translation", {x, height, z}}, {"scale", {sizeX / 2, 1, sizeZ / 2}}});
  return testing::sceneOf(builder);
}

Json shadowSpec(const Json& light, const Json& filter) {
  return {{"width", 320},
          {"height", 200},
          {"lights", {light}},
          {"shadow", {{"filter", filter}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}}}};
}

const Json kSunAbove = {{"type", "directional"}, {"direction", {0, -1, 0}}};

/// Metres, along a row of the picture, between 10 % and 90 % of the light at the left edge of a shadow. The camera is
/// level, `up` metres above the ground; `below` is the row's share of the half picture below the horizon.
double penumbraAt(const Frame& frame, double up, double below) {
  const FrameSpec& spec = frame.report.spec;
  const double tanHalf = std::tan(spec.camera.perspective->fovYDegrees * 3.14159265358979 / 360);
  const int row = static_cast<int>(spec.height / 2 * (1 + below));
  const double depth = up / (tanHalf * (2 * (row + 0.5) / spec.height - 1));
  const auto& visibility = floatsOf(frame);
  int between = 0;
  for (int x = 0; x < spec.width / 2; ++x) {
    const float v = visibility[static_cast<std::size_t>(row * spec.width + x)];
    if (v > 0.1f && v < 0.9f) ++between;
  }
  return between * 2 * depth * tanHalf / spec.height;
}

TEST(Filters, X28_ARadiusIsTheSameSoftnessInEveryCascade) {
  const ScenePtr scene = boardOverGround(0, 0, 8, 90, 4);
  for (const char* type : {"pcf", "vsm", "evsm", "msm"}) {
    Json spec = shadowSpec(kSunAbove, {{"type", type}, {"radius", 1.0}});
    spec["width"] = 1600;
    spec["height"] = 400;
    spec["camera"] = {{"eye", {0, 2, 44}}, {"target", {0, 2, 0}}};
    const Frame soft = renderJson(scene, spec.dump());
    ASSERT_EQ(soft.report.lights.at(0).tiles.size(), 4u);
    const double near = penumbraAt(soft, 2, 0.85);
    const double far = penumbraAt(soft, 2, 0.14);
    EXPECT_GT(near, 0.8) << type << ": of a kernel 2 m across";
    EXPECT_LT(near, 2.0) << type;
    EXPECT_NEAR(far, near, 0.25 * near) << type;
  }
}

TEST(Filters, X28_ASizeInTexelsIsASoftnessOfItsCascadesTexels) {
  const ScenePtr scene = boardOverGround(0, 0, 8, 90, 4);
  Json spec = shadowSpec(kSunAbove, {{"type", "pcf"}, {"size", 7}});
  spec["width"] = 1600;
  spec["height"] = 400;
  spec["shadow"]["size"] = "XSmall";
  spec["camera"] = {{"eye", {0, 2, 44}}, {"target", {0, 2, 0}}};
  const Frame frame = renderJson(scene, spec.dump());
  EXPECT_GT(penumbraAt(frame, 2, 0.14), 1.5 * penumbraAt(frame, 2, 0.85));
}

TEST(Filters, M18_X28_ARadiusIsRoundWhereTexelsAreNot) {
  // A square board seen from above under tiles whose texels differ along the axes.
  const ScenePtr scene = boardOverGround(0, 0, 4, 4, 3);
  for (const char* type : {"pcf", "evsm", "msm"}) {
    Json spec = shadowSpec(kSunAbove, {{"type", type}, {"radius", 0.5}});
    spec["width"] = 640;
    spec["height"] = 160; // 32 x 8 m
    spec["camera"] = {{"eye", {0, 2.5, 0}},
                      {"target", {0, 0, 0}},
                      {"up", {0, 0, -1}},
                      {"orthographic", {{"height", 8}, {"near", 0}, {"far", 10}}}};
    const Frame frame = renderJson(scene, spec.dump());
    const auto& texel = frame.report.lights.at(0).tiles.at(0).texelSize;
    ASSERT_GT(std::abs(texel[0] - texel[1]), 0.1 * texel[0]) << "the picture is wider than high";
    const auto& visibility = floatsOf(frame);
    int across = 0;
    int along = 0;
    for (int i = 0; i < 80; ++i) {
      const float x = visibility[static_cast<std::size_t>(80 * 640 + 320 + i)];
      const float y = visibility[static_cast<std::size_t>((80 + i) * 640 + 320)];
      across += x > 0.1f && x < 0.9f ? 1 : 0;
      along += y > 0.1f && y < 0.9f ? 1 : 0;
    }
    EXPECT_GT(across, 8) << type;
    EXPECT_NEAR(across, along, 3) << type;
  }
}

const Json kLampsAbove = Json::parse(R"([
    {"type":"directional","direction":[0,-1,0]},
    {"type":"spot","position":[0,8,0],"direction":[0,-1,0],"outerConeDegrees":40},
    {"type":"point","position":[0,8,0]}])");

/// The least light on the ground under a board 0.5 m up, by the middle of the picture.
float underBoard(const Json& light, const Json& filter, const Json& bias) {
  Json spec = shadowSpec(light, filter);
  spec["camera"] = {{"eye", {0, 0.3, 3}}, {"target", {0, 0, 0}}};
  spec["shadow"]["bias"] = bias;
  return testing::valueAt(renderJson(boardOverGround(0, 0, 2, 2, 0.5), spec.dump()), 0.5, 0.5);
}

TEST(Filters, X27_X26_AManualDepthIsMetresTowardsTheLightForEveryType) {
  for (const Json& light : kLampsAbove) {
    for (const char* filter : {"hard", "pcf", "vsm", "evsm", "msm"}) {
      const auto seen = [&](double depth) {
        return underBoard(light, {{"type", filter}}, {{"mode", "manual"}, {"depth", depth}});
      };
      EXPECT_LT(seen(0.3), 0.05f) << light << ' ' << filter;
      EXPECT_GT(seen(0.7), 0.95f) << light << ' ' << filter << ": lifted above the board";
    }
  }
}

TEST(Filters, X27_TheNormalOffsetIsAMultipleOfTheDepth) {
  for (const Json& light : kLampsAbove) {
    const auto seen = [&](double scale) {
      return underBoard(light, {{"type", "hard"}}, {{"mode", "manual"}, {"depth", 0.1}, {"normalOffsetScale", scale}});
    };
    EXPECT_EQ(seen(3), 0.0f) << light << ": 0.1 + 0.3 m up";
    EXPECT_EQ(seen(5), 1.0f) << light << ": 0.1 + 0.5 m up";
  }
}

TEST(Filters, X27_ManualBiasOfNothingShowsAcneAndASlopeCuresIt) {
  const ScenePtr scene = boardOverGround(0, -20, 1, 1, 1);
  for (const char* light : {R"({"type":"directional","direction":[1,-0.5,0.3]})",
                            R"({"type":"spot","position":[-8,4,0],"direction":[2,-1,0],"outerConeDegrees":50})",
                            R"({"type":"point","position":[-8,4,0]})"}) {
    Json spec = shadowSpec(Json::parse(light), {{"type", "hard"}});
    spec["shadow"]["size"] = "XSmall";
    spec["camera"] = {{"eye", {0, 6, 6}}, {"target", {0, 0, 0}}};
    const auto dark = [&](const Json& bias) {
      spec["shadow"]["bias"] = bias;
      const Frame frame = renderJson(scene, spec.dump());
      return std::count_if(floatsOf(frame).begin(), floatsOf(frame).end(), [](float v) { return v < 0.9f; });
    };
    EXPECT_GT(dark({{"mode", "manual"}}), 1000) << light;
    EXPECT_EQ(dark({{"mode", "manual"}, {"slope", 0.8}}), 0) << light;
    EXPECT_EQ(dark({{"mode", "automatic"}}), 0) << light;
  }
}

TEST(Filters, H4_AShadowBeginsAtItsCastersFoot) {
  const ScenePtr scene = testing::generatedScene("box_on_plane"); // 2 m wide, its middle at 0
  const Json lights = Json::parse(R"([
      {"type":"directional","direction":[1,-1,0],"angularDiameterDegrees":3},
      {"type":"spot","position":[-6,6,0],"direction":[1,-1,0],"outerConeDegrees":40,"radius":0.2},
      {"type":"point","position":[-6,6,0],"radius":0.2}])");
  for (const Json& light : lights) {
    for (const Json& filter : testing::everyFilter()) {
      Json spec = shadowSpec(light, filter);
      spec["shadow"]["size"] = "Small";
      spec["camera"] = {{"eye", {1.5, 3, 0}},
                        {"target", {1.5, 0, 0}},
                        {"up", {0, 0, -1}},
                        {"orthographic", {{"height", 1}, {"near", 0}, {"far", 4}}}};
      const Frame frame = renderJson(scene, spec.dump()); // x from 0.7 to 2.3, 5 mm a pixel
      double texel = 0;
      for (const TileReport& tile : frame.report.lights.at(0).tiles) {
        if (tile.tile[2] > 0) texel = std::max({texel, tile.texelSize[0], tile.texelSize[1]});
      }
      const auto& visibility = floatsOf(frame);
      int lit = 0;
      for (int x = 61; x < 320 && visibility[static_cast<std::size_t>(100 * 320 + x)] > 0.5f; ++x) ++lit;
      EXPECT_LE(lit * 0.005, 1.5 * texel) << light << ' ' << filter;
    }
  }
}

TEST(Filters, H4_ASheetShadowsAGroundThatTheSunGrazes) {
  const ScenePtr scene = boardOverGround(0, 0, 2, 2, 0.05); // its shadow: x from 0 to 2
  for (const int size : {1, 3, 5, 7}) {
    const Json filter = size == 1 ? Json{{"type", "hard"}} : Json{{"type", "pcf"}, {"size", size}};
    Json spec = shadowSpec({{"type", "directional"}, {"direction", {1, -0.05, 0}}}, filter);
    spec["shadow"]["size"] = "XSmall";
    spec["shadow"]["cascadeCount"] = 1;
    spec["camera"] = {{"eye", {1.5, 3, 0.1}}, {"target", {1.5, 0, 0}}};
    const Frame frame = renderJson(scene, spec.dump());
    EXPECT_LT(testing::valueAt(frame, 0.5, 0.5), 0.1f) << size;
    EXPECT_GT(testing::valueAt(frame, 0.98, 0.5), 0.9f) << size << ": beside it";
  }
}

TEST(Filters, H4_NoKernelReachesThroughARoof) {
  const ScenePtr scene = boardOverGround(0, 0, 20, 20, 0.5);
  for (const Json& filter : testing::everyFilter()) {
    // Blurred depths of a roof and of the ground under it can't be told apart.
    if (filter["type"] != "pcf" && filter["type"] != "hard" && filter["type"] != "pcss") continue;
    Json spec = shadowSpec({{"type", "directional"}, {"direction", {1, -1, 0}}, {"angularDiameterDegrees", 3}}, filter);
    spec["shadow"]["size"] = "XSmall";
    spec["shadow"]["cascadeCount"] = 1;
    spec["camera"] = {{"eye", {0, 0.3, 3}}, {"target", {0, 0, 0}}};
    const Frame frame = renderJson(scene, spec.dump());
    EXPECT_LT(testing::valueAt(frame, 0.5, 0.5), 0.5f) << filter;
  }
}

TEST(Filters, D4_FourSamplesATexelAreComparedOneByOne) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  Json spec = shadowSpec({{"type", "directional"}, {"sun", {{"azimuthDegrees", 130}, {"elevationDegrees", 35}}}},
                         {{"type", "hard"}});
  spec["shadow"]["size"] = "XSmall";
  spec["camera"] = {{"orbit", {{"target", {0, 1, 0}}, {"distance", 26.72}}}};
  const Frame one = renderJson(scene, spec.dump());
  spec["atlas"] = {{"samples", 4}};
  const Frame four = renderJson(scene, spec.dump());
  double sumOne = 0;
  double sumFour = 0;
  int between = 0;
  for (std::size_t i = 0; i < floatsOf(one).size(); ++i) {
    const float v = floatsOf(four)[i];
    EXPECT_EQ(v * 4, std::round(v * 4)) << "a share of four samples";
    between += v > 0 && v < 1 ? 1 : 0;
    sumOne += 1 - floatsOf(one)[i];
    sumFour += 1 - v;
  }
  EXPECT_GT(between, 40) << "edges are finer than a texel";
  EXPECT_NEAR(sumFour, sumOne, 0.02 * sumOne);
}

TEST(Filters, D4_H4_FourSamplesShowNoAcne) {
  const ScenePtr scene = boardOverGround(0, -20, 1, 1, 1);
  for (const char* light : {R"({"type":"directional","direction":[1,-0.2,0.3],"angularDiameterDegrees":3})",
                            R"({"type":"point","position":[-8,2,0],"radius":0.2})"}) {
    for (const Json& filter : testing::everyFilter()) {
      Json spec = shadowSpec(Json::parse(light), filter);
      spec["shadow"]["size"] = "XSmall";
      spec["atlas"] = {{"samples", 4}};
      spec["camera"] = {{"eye", {0, 6, 6}}, {"target", {0, 0, 0}}};
      const Frame frame = renderJson(scene, spec.dump());
      // Blurred depths of a slope in a point light's map are no slope: they take a little light from it.
      const bool blurred = filter["type"] != "hard" && filter["type"] != "pcf" && filter["type"] != "pcss";
      const float lit = blurred ? 0.8f : 0.999f;
      EXPECT_LE(std::count_if(floatsOf(frame).begin(), floatsOf(frame).end(), [&](float v) { return v < lit; }),
                blurred ? 5 : 0)
          << light << ' ' << filter;
    }
  }
}

} // namespace
} // namespace gnomon
