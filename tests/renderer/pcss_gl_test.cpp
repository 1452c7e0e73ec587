// Shadows as soft as their lights are large, drawn from maps.
#include <algorithm>
#include <cmath>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr double kDegree = 3.14159265358979 / 180;

/// A ground of 100 m, and over it, `height` metres up, the half of a ceiling that lies towards negative x.
ScenePtr halfPlaneOverPlane(double height) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 0}, {"translation", {-25, height, 0}}, {"scale", {25, 1, 50}}});
  return testing::sceneOf(builder);
}

/// Straight from above at the ground around 0, under the ceiling: `across` metres wide.
Json groundSpec(const Json& light, double across, double below) {
  return {{"width", 400},
          {"height", 40},
          {"camera",
           {{"eye", {0, 0.9 * below, 0}},
            {"target", {0, 0, 0}},
            {"up", {0, 0, -1}},
            {"orthographic", {{"height", across / 10}, {"near", 0}, {"far", 50}}}}},
          {"lights", {light}},
          {"shadow", {{"filter", {{"type", "pcss"}}}}},
          {"antialiasing", "none"},
          {"views", {"shadow"}},
          {"output", {{"format", "exr"}}}};
}

/// The mean of each column of a picture of 400 by 40.
std::vector<double> columnsOf(const Frame& frame) {
  std::vector<double> columns(400);
  for (std::size_t i = 0; i < floatsOf(frame).size(); ++i) columns[i % 400] += floatsOf(frame)[i] / 40.0;
  return columns;
}

/// The columns from one share of the light to another, up the ramp; between columns as on a line.
double columnsBetween(const std::vector<double>& columns, double low, double high) {
  const auto where = [&](double share) {
    for (std::size_t i = 1; i < columns.size(); ++i) {
      if (columns[i - 1] < share && columns[i] >= share)
        return static_cast<double>(i) - (columns[i] - share) / (columns[i] - columns[i - 1]);
    }
    return -1e9;
  };
  return where(high) - where(low);
}

/// The share of a disc of radius 1 on one side of a line at x: what a straight edge leaves of the light.
double discShare(double x) {
  return 0.5 + (std::asin(x) + x * std::sqrt(1 - x * x)) / 3.14159265358979;
}

/// Diameters of a disc between the lines that leave a fifth and four fifths of it.
double middleOfRamp() {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) (discShare(0.5 * (low + high)) < 0.8 ? low : high) = 0.5 * (low + high);
  return low;
}

/// The whole penumbra, metres, from the slope of the middle of its ramp.
double measuredWidth(const Json& light, double height, double expected) {
  const double across = 3 * expected;
  const Frame frame = renderJson(halfPlaneOverPlane(height), groundSpec(light, across, height).dump());
  return columnsBetween(columnsOf(frame), 0.2, 0.8) * across / 400 / middleOfRamp();
}

TEST(Pcss, N1_N6_ASunsPenumbraIsAsWideAsTheFormulaSays) {
  for (const double degrees : {0.53, 2.0, 5.0, 20.0}) {
    for (const double height : {0.5, 2.0, 10.0}) {
      const Json sun = {{"type", "directional"}, {"direction", {0, -1, 0}}, {"angularDiameterDegrees", degrees}};
      const double expected = height * 2 * std::tan(0.5 * degrees * kDegree);
      EXPECT_NEAR(measuredWidth(sun, height, expected) / expected, 1, 0.1) << degrees << " degrees, " << height << " m";
    }
  }
}

TEST(Pcss, N1_N6_ALampsPenumbraIsAsWideAsTheFormulaSays) {
  for (const char* type : {"spot", "point"}) {
    for (const double radius : {0.05, 0.2, 0.5}) {
      for (const double height : {1.0, 4.0}) {
        // Over the edge, 10 m over the ground.
        Json lamp = {{"type", type}, {"position", {0, 10, 0}}, {"radius", radius}};
        if (lamp["type"] == "spot") lamp.update({{"direction", {0, -1, 0}}, {"outerConeDegrees", 50}});
        const double expected = 2 * radius * height / (10 - height);
        EXPECT_NEAR(measuredWidth(lamp, height, expected) / expected, 1, 0.1) << lamp << ", " << height << " m";
      }
    }
  }
}

TEST(Pcss, N6_ShadowsHardenTowardsTheirCastersFoot) {
  // A wall of 4 m, its shadow along x: the penumbra of its side edge grows with the distance.
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  const double half = std::sqrt(0.5);
  builder.addRoot({{"mesh", 0}, {"translation", {0, 2, -10}}, {"rotation", {0, 0, half, half}}, {"scale", {4, 1, 10}}});
  const ScenePtr scene = testing::sceneOf(builder);
  Json spec = groundSpec({{"type", "directional"}, {"direction", {1, -1, 0}}, {"angularDiameterDegrees", 8}}, 1, 1);
  const auto widthAt = [&](double x) {
    spec["width"] = 40;
    spec["height"] = 400;
    spec["camera"] = {{"eye", {x, 5, 0}},
                      {"target", {x, 0, 0}},
                      {"up", {0, 0, -1}},
                      {"orthographic", {{"height", 2}, {"near", 0}, {"far", 20}}}};
    const Frame frame = renderJson(scene, spec.dump());
    std::vector<double> rows(400);
    for (std::size_t i = 0; i < floatsOf(frame).size(); ++i) rows[i / 40] += floatsOf(frame)[i] / 40.0;
    return columnsBetween(rows, 0.2, 0.8) * 2 / 400 / middleOfRamp();
  };
  // The way of the light from the wall's edge to the ground at x is sqrt 2 x.
  for (const double x : {0.3, 1.0, 3.0}) {
    EXPECT_NEAR(widthAt(x), std::sqrt(2.0) * x * 2 * std::tan(4 * kDegree), 0.2 * x * 0.2) << x << " m from the wall";
  }
}

TEST(Pcss, N6_WithoutASizeItIsTheSharpShadowAndTheReportSaysSo) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  Json spec = {{"width", 160},
               {"height", 90},
               {"lights", {{{"type", "directional"}, {"direction", {1, -1, 0.3}}}}},
               {"shadow", {{"filter", {{"type", "pcss"}}}}},
               {"views", {"shadow"}},
               {"output", {{"format", "exr"}}}};
  const Frame unsized = renderJson(scene, spec.dump());
  EXPECT_EQ(unsized.report.lights.at(0).note, "it has no size: filter pcss draws its shadow sharp");
  spec["shadow"]["filter"]["type"] = "hard";
  EXPECT_EQ(floatsOf(unsized), floatsOf(renderJson(scene, spec.dump())));
  spec["lights"][0]["angularDiameterDegrees"] = 2;
  EXPECT_EQ(renderJson(scene, spec.dump()).report.lights.at(0).note,
            "its size is ignored: of all filters only pcss knows it");
  spec["shadow"]["filter"]["type"] = "pcss";
  EXPECT_EQ(renderJson(scene, spec.dump()).report.lights.at(0).note, "");
}

/// The root mean square of the shadow less a reference by rays, over what receives light.
double rmsOf(const Frame& frame) {
  const auto& shadow = floatsOf(frame, 0);
  const auto& reference = floatsOf(frame, 1);
  double sum = 0;
  for (std::size_t i = 0; i < shadow.size(); ++i) {
    sum += (static_cast<double>(shadow[i]) - reference[i]) * (static_cast<double>(shadow[i]) - reference[i]);
  }
  return std::sqrt(sum / static_cast<double>(shadow.size()));
}

TEST(Pcss, N6_ItIsNearTheAreaSampledReference) {
  const Json lights = Json::parse(R"([
      {"type":"directional","direction":[1,-1,0.3],"angularDiameterDegrees":0.53},
      {"type":"directional","direction":[1,-1,0.3],"angularDiameterDegrees":5},
      {"type":"point","position":[-4,6,1],"radius":0.2}])");
  for (const char* name : {"box_on_plane", "room_corner"}) {
    const ScenePtr scene = testing::generatedScene(name);
    for (const Json& light : lights) {
      const Json spec = {{"width", 320},
                         {"height", 180},
                         {"camera", {{"node", "camera"}}},
                         {"lights", {light}},
                         {"shadow", {{"filter", {{"type", "pcss"}}}}},
                         {"antialiasing", "none"},
                         {"views", {"shadow", "reference"}},
                         {"output", {{"format", "exr"}}}};
      const double rms = rmsOf(renderJson(scene, spec.dump()));
      std::printf("%s, %s: rms %.4f\n", name, light.dump().c_str(), rms);
      EXPECT_LE(rms, 0.08) << name << ' ' << light;
    }
  }
}

// A sun that grazes the ground, and a slope that begins where the ground ends and hides all of the sun: of its disc the
// ground's own plane takes the one part and the slope the other, so that nothing is left.
TEST(Pcss, N6_NoLightLeaksThroughTheFoldOfASurface) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0].update({{"translation", {10, 0, 0}}, {"scale", {10, 1, 50}}});
  builder.json["materials"] = {{{"doubleSided", true}}};
  builder.json["meshes"][0]["primitives"][0]["material"] = 0;
  const double rise = 10 * kDegree, half = 0.5 * rise;
  builder.addRoot({{"mesh", 0},
                   {"translation", {-5 * std::cos(rise), 5 * std::sin(rise), 0}},
                   {"rotation", {0, 0, -std::sin(half), std::cos(half)}},
                   {"scale", {5, 1, 50}}});
  const double elevation = 1.5 * kDegree;
  Json spec = groundSpec({{"type", "directional"},
                          {"direction", {std::cos(elevation), -std::sin(elevation), 0}},
                          {"angularDiameterDegrees", 5}},
                         2, 2);
  spec["camera"].update({{"eye", {1.1, 2, 0}}, {"target", {1.1, 0, 0}}});
  spec["views"] = {"shadow", "reference"};
  const Frame frame = renderJson(testing::sceneOf(builder), spec.dump());
  EXPECT_EQ(std::ranges::max(floatsOf(frame, 1)), 0.0F);
  // The slope is drawn as far off as its mean height says, so a little is left. Taken each by itself they leave 0.15.
  EXPECT_LE(rmsOf(frame), 0.06);
}

// Along the edge of a ceiling, into the distance: two cascades of texels of other sizes find the same penumbra.
TEST(Pcss, N6_CascadesThatAreBlendedShowOnePenumbra) {
  Json spec = groundSpec({{"type", "directional"}, {"direction", {0, -1, 0}}, {"angularDiameterDegrees", 8}}, 1, 1);
  spec.update({{"width", 320},
               {"height", 240},
               {"camera", {{"eye", {0.3, 1.5, 40}}, {"target", {0.3, 0, 37}}}},
               {"views", {"shadow", "reference", "blendWeight"}}});
  spec["shadow"]["cascadeCount"] = 8;
  const Frame frame = renderJson(halfPlaneOverPlane(3), spec.dump());
  double error[2] = {0, 0}; // of pixels that one cascade serves, and of those that two do
  std::size_t count[2] = {0, 0};
  for (std::size_t i = 0; i < floatsOf(frame).size(); ++i) {
    const double truth = floatsOf(frame, 1)[i];
    if (truth < 0.02 || truth > 0.98) continue;
    const std::size_t blended = floatsOf(frame, 2)[i] > 0 ? 1 : 0;
    error[blended] += std::pow(floatsOf(frame, 0)[i] - truth, 2);
    ++count[blended];
  }
  ASSERT_GT(count[0], 500u);
  ASSERT_GT(count[1], 200u);
  const double alone = std::sqrt(error[0] / static_cast<double>(count[0]));
  const double blended = std::sqrt(error[1] / static_cast<double>(count[1]));
  std::printf("in the penumbra: rms %.4f by one cascade (%zu pixels), %.4f by two (%zu)\n", alone, count[0], blended,
              count[1]);
  EXPECT_LE(alone, 0.06);
  EXPECT_LE(blended, 0.06);
}

// The penumbra lies across an edge of the lamp's cube.
TEST(Pcss, N6_NoSeamShowsWhereFacesMeet) {
  for (const double height : {1.0, 2.0}) {
    const double expected = 2 * 0.3 * height / (4 - height);
    // The ceiling's edge lies 4 m beside the lamp that hangs 4 m up: on the cube's edge, 45 degrees off.
    const double edge = 4 - height;
    testing::GlbBuilder builder = testing::plane();
    builder.json["nodes"][0]["scale"] = {50, 1, 50};
    builder.json["materials"] = {{{"doubleSided", true}}};
    builder.json["meshes"][0]["primitives"][0]["material"] = 0;
    builder.addRoot({{"mesh", 0}, {"translation", {edge - 25, height, 0}}, {"scale", {25, 1, 50}}});
    Json spec = groundSpec({{"type", "point"}, {"position", {0, 4, 0}}, {"radius", 0.3}}, 4 * expected, height);
    spec["camera"]["eye"][0] = 4;
    spec["camera"]["target"][0] = 4;
    spec["views"] = {"shadow", "reference"};
    const Frame frame = renderJson(testing::sceneOf(builder), spec.dump());
    EXPECT_LE(rmsOf(frame), 0.06) << height;
    const auto columns = columnsOf(frame);
    for (std::size_t i = 1; i < columns.size(); ++i) {
      EXPECT_GE(columns[i], columns[i - 1] - 0.04) << height << " m, column " << i << ": light grows across the ramp";
    }
  }
}

} // namespace
} // namespace gnomon
