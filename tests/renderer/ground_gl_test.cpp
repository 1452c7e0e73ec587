// A ground under a cube of two metres that stands on y 0, its sun at 45 degrees: in closed form.
#include <cmath>
#include <glm/glm.hpp>

#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

constexpr int kSide = 96;      ///< pixels
constexpr double kMetres = 12; ///< that they show

testing::GlbBuilder cube() {
  testing::GlbBuilder builder;
  const int position = builder.addPoints(
      {{-1, 0, -1}, {1, 0, -1}, {-1, 2, -1}, {1, 2, -1}, {-1, 0, 1}, {1, 0, 1}, {-1, 2, 1}, {1, 2, 1}});
  const int indices = builder.addShortIndices(
      {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 4, 2, 4, 6, 2, 1, 3, 5, 5, 3, 7, 2, 6, 3, 3, 6, 7, 0, 1, 4, 1, 5, 4});
  builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", position}}}, {"indices", indices}}));
  return builder;
}

Json sun(const Json& more = {}) {
  Json light = {{"type", "directional"}, {"direction", {1, -1, 0}}};
  if (!more.is_null()) light.merge_patch(more);
  return light;
}

/// From above: x to the right, z down.
Json specOf(const Json& more = {}) {
  Json spec = {{"width", kSide},
               {"height", kSide},
               {"camera",
                {{"eye", {0, 20, 0}},
                 {"target", {0, 0, 0}},
                 {"up", {0, 0, -1}},
                 {"orthographic", {{"height", kMetres}, {"near", 0}, {"far", 100}}}}},
               {"lights", {sun()}},
               {"ambient", {{"intensity", 0}}},
               {"ground", Json::object()},
               {"background", {{"color", {0.2, 0.4, 0.8}}, {"alpha", 0}}},
               {"antialiasing", "none"},
               {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  if (!more.is_null()) spec.merge_patch(more);
  return spec;
}

glm::vec4 pixelAt(const Frame& frame, double x, double z) {
  const auto column = static_cast<std::size_t>((x / kMetres + 0.5) * kSide);
  const auto row = static_cast<std::size_t>((z / kMetres + 0.5) * kSide);
  const std::size_t channels = frame.images.at(0).image.channels.size(); // no alpha where the background is opaque
  const float* at = testing::floatsOf(frame).data() + (row * kSide + column) * channels;
  return {at[0], at[1], at[2], channels == 4 ? at[3] : 1.0f};
}

Frame drawn(const Json& more = {}) {
  return testing::renderJson(testing::sceneOf(cube()), specOf(more).dump());
}

struct Way {
  const char* technique;
  double tolerance; ///< metres from an edge that are not asked about
};

std::vector<Way> ways() {
  std::vector<Way> all{{"shadowMap", 0.3}, {"rayTraced", 0.13}};
  if (testing::sharedRenderer().info().device == DeviceChoice::gl) all.push_back({"shadowVolume", 0.13});
  return all;
}

/// Calls each(column, row, x, z, shadowed) for the pixels beside the cube and off the shadow's edges.
template <class Each>
void forEachGroundPixel(double tolerance, const Each& each) {
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double x = ((column + 0.5) / kSide - 0.5) * kMetres;
      const double z = ((row + 0.5) / kSide - 0.5) * kMetres;
      const auto within = [&](double by) { return x > 1 - by && x < 3 + by && std::abs(z) < 1 + by; };
      if (std::abs(x) < 1 + tolerance && std::abs(z) < 1 + tolerance) continue;
      if (within(tolerance) != within(-tolerance)) continue;
      each(x, z, within(0));
    }
  }
}

TEST(Ground, AlphaIsTheStrengthOfTheShadowUnderOneSun) {
  for (const Way& way : ways()) {
    const Frame frame = drawn({{"shadow", {{"technique", way.technique}, {"strength", 0.75}}}});
    int shadowed = 0;
    forEachGroundPixel(way.tolerance, [&](double x, double z, bool inShadow) {
      const glm::vec4 pixel = pixelAt(frame, x, z);
      shadowed += inShadow ? 1 : 0;
      ASSERT_NEAR(pixel.w, inShadow ? 0.75f : 0.0f, 1e-4f) << way.technique << ' ' << x << ' ' << z;
      ASSERT_NEAR(glm::length(glm::vec3(pixel) * pixel.w), 0, 1e-6) << way.technique << ' ' << x << ' ' << z;
    });
    EXPECT_GT(shadowed, 100);
  }
}

TEST(Ground, OverABackgroundItIsThatBackgroundTimesTheLightThatArrives) {
  for (const double alpha : {1.0, 0.4}) {
    const Frame frame =
        drawn({{"background", {{"alpha", alpha}}}, {"shadow", {{"technique", "rayTraced"}, {"strength", 0.6}}}});
    const glm::vec3 background(0.2, 0.4, 0.8);
    forEachGroundPixel(0.13, [&](double x, double z, bool inShadow) {
      const float share = inShadow ? 0.4f : 1.0f;
      const float cover = static_cast<float>(alpha);
      const glm::vec4 pixel = pixelAt(frame, x, z);
      // What an EXR holds is multiplied by alpha.
      for (int c = 0; c < 3; ++c)
        ASSERT_NEAR(pixel[c] * pixel.w, cover * background[c] * share, 1e-5f) << x << ' ' << z;
      ASSERT_NEAR(pixel.w, 1 - (1 - cover) * share, 1e-5f) << x << ' ' << z;
    });
  }
}

TEST(Ground, SurroundingsAndOtherLightsFillTheShadow) {
  // A second sun from straight above throws no shadow beside the cube.
  const Json lights = {sun({{"intensity", 3}}), sun({{"direction", {0, -1, 0}}, {"intensity", 2}})};
  const Frame two = drawn({{"lights", lights}, {"shadow", {{"technique", "rayTraced"}}}});
  const double slanted = 3 * std::sqrt(0.5);
  EXPECT_NEAR(pixelAt(two, 2, 0).w, slanted / (slanted + 2), 1e-4);
  const Frame around = drawn({{"lights", {sun({{"intensity", 3}})}},
                              {"ambient", {{"color", {1, 1, 1}}, {"intensity", 0.5}}},
                              {"environment", {{"studio", "even"}}},
                              {"shadow", {{"technique", "rayTraced"}}}});
  const double open = 0.5 * (0.547 + 0.3034 + 0.1534); // of irradianceOfEvenStudio, over pi, on what faces up
  const double sunlit = slanted / std::acos(-1.0);
  EXPECT_NEAR(pixelAt(around, 2, 0).w, sunlit / (sunlit + open), 1e-4);
  EXPECT_EQ(pixelAt(around, -3, 0).w, 0);
}

TEST(Ground, ColoredShadowsCountByLuminance) {
  const Json shadow = {{"technique", "rayTraced"}, {"color", {1, 0.5, 0}}};
  const Frame frame = drawn({{"shadow", shadow}});
  EXPECT_NEAR(pixelAt(frame, 2, 0).w, 1 - (0.2126 + 0.5 * 0.7152), 1e-4);
}

TEST(Ground, SamplesCountAsMuchAsTheyCover) {
  const Json white = {{"background", {{"color", {1, 1, 1}}}},
                      {"camera", {{"eye", {0.04, 20, 0.03}}, {"target", {0.04, 0, 0.03}}}},
                      {"shadow", {{"technique", "rayTraced"}}}};
  Json smooth = white;
  smooth["antialiasing"] = "msaa4x";
  const Frame plain = drawn(white);
  const Frame frame = drawn(smooth);
  const float brightest = [&] {
    float most = 0;
    for (double x = -0.9; x < 0.9; x += 0.1) most = std::max(most, pixelAt(plain, x, 0).x);
    return most;
  }();
  const auto& pixels = testing::floatsOf(frame);
  int mixed = 0;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    if (!(pixels[i + 3] > 0.01f && pixels[i + 3] < 0.99f)) continue;
    ++mixed;
    EXPECT_LE(pixels[i], brightest * 1.01f) << "the invisible background's white shows";
  }
  EXPECT_GT(mixed, 10);
}

TEST(Ground, IsSeenFromAboveAlone) {
  const Json below = {{"camera", {{"eye", {0, -20, 0}}}}, {"views", {"color", "ids"}}};
  const Frame frame = drawn(below);
  for (const double x : {-4.0, 2.0, 4.0}) EXPECT_EQ(pixelAt(frame, x, 0).w, 0);
  const auto& ids = testing::floatsOf(frame, 1);
  EXPECT_EQ(*std::max_element(ids.begin(), ids.end()), 0) << "the cube";
}

TEST(Ground, ASurfaceHasItsColorAndReceives) {
  const Json ground = {{"mode", "surface"}, {"color", {0.3, 0.5, 0.1}}};
  const Frame frame = drawn({{"ground", ground}, {"shadow", {{"technique", "rayTraced"}}}});
  const glm::vec4 lit = pixelAt(frame, -3, 0);
  EXPECT_EQ(lit.w, 1);
  EXPECT_NEAR(lit.x / lit.y, 0.6, 0.03);
  EXPECT_LT(pixelAt(frame, 2, 0).y, 0.01f * lit.y);
}

TEST(Ground, DataViewsShowIt) {
  const Json views = {"ids", "instances", "materials", "depth", "normal", "albedo"};
  const Frame frame = drawn({{"views", views}, {"ground", {{"color", {0.25, 0.5, 0.75}}, {"size", 20}}}});
  EXPECT_EQ(testing::valueAt(frame, 0.2, 0.5, 0), 1) << "the number after the file's only node";
  EXPECT_EQ(testing::valueAt(frame, 0.5, 0.5, 0), 0);
  EXPECT_EQ(testing::valueAt(frame, 0.2, 0.5, 1), 0);
  EXPECT_EQ(testing::valueAt(frame, 0.2, 0.5, 2), 0) << "the file has no material";
  EXPECT_EQ(testing::valueAt(frame, 0.5, 0.5, 2), -1);
  EXPECT_NEAR(testing::valueAt(frame, 0.2, 0.5, 3), 20, 1e-3);
  const std::size_t at = (kSide / 2 * kSide + kSide / 5) * 3;
  EXPECT_NEAR(testing::floatsOf(frame, 4).at(at + 1), 1, 1e-3);
  EXPECT_NEAR(testing::floatsOf(frame, 5).at(at + 2), 0.75, 2e-3);
}

TEST(Ground, FramingAndNearPlaneAreThoseWithout) {
  const ScenePtr scene = testing::sceneOf(cube());
  const Json automatic = {{"camera", {{"orbit", {{"azimuthDegrees", 30}, {"elevationDegrees", 20}}}}},
                          {"ground", {{"mode", "surface"}}}};
  Json with = automatic;
  with.update({{"width", 64}, {"height", 48}});
  Json without = with;
  without.erase("ground");
  EXPECT_EQ(testing::renderJson(scene, with.dump()).report.spec.camera,
            testing::renderJson(scene, without.dump()).report.spec.camera);
}

TEST(Ground, ReportsItsHeightAndSize) {
  const Ground catcher = *drawn().report.spec.ground;
  EXPECT_NEAR(*catcher.height, 0, 1e-3);
  EXPECT_LT(*catcher.height, 0) << "a hair below the cube's own bottom";
  EXPECT_GT(*catcher.size, 6) << "the shadow ends 3 m from the middle";
  EXPECT_LT(*catcher.size, 8);
  const Ground surface = *drawn({{"ground", {{"mode", "surface"}, {"height", -1.5}}}}).report.spec.ground;
  EXPECT_EQ(*surface.height, -1.5);
  EXPECT_EQ(*surface.size, 20);
}

TEST(Ground, StandsUnderWhatIsSeenAsPosed) {
  const Json raised = {{"nodes", {{{"node", 0}, {"translation", {0, 5, 0}}}}}};
  EXPECT_NEAR(*drawn(raised).report.spec.ground->height, 5, 1e-3);
  testing::GlbBuilder two = cube();
  two.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, -7, 0}}});
  two.json["scenes"][0]["nodes"].push_back(1);
  const ScenePtr scene = testing::sceneOf(two);
  EXPECT_NEAR(*testing::renderJson(scene, specOf().dump()).report.spec.ground->height, -7, 2e-3);
  const Json hidden = {{"nodes", {{{"node", 1}, {"visible", false}}}}};
  EXPECT_NEAR(*testing::renderJson(scene, specOf(hidden).dump()).report.spec.ground->height, 0, 2e-3);
}

TEST(Ground, NodesCannotNameIt) {
  const ScenePtr scene = testing::sceneOf(cube());
  for (const Json& node : {Json(1), Json("ground")}) {
    const Problems problems =
        testing::refusedJson(scene, specOf({{"nodes", {{{"node", node}, {"castShadow", true}}}}}).dump());
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].pointer, "/nodes/0/node");
  }
}

TEST(Ground, IsRefusedWithLightMapsAndBeyondReach) {
  const ScenePtr scene = testing::sceneOf(cube());
  const Problems baked = testing::refusedJson(scene, specOf({{"shadow", {{"technique", "lightMap"}}}}).dump());
  ASSERT_EQ(baked.size(), 1u);
  EXPECT_EQ(baked[0].pointer, "/ground");
  EXPECT_EQ(baked[0].code, ProblemCode::unsupportedFeature);
  for (const Json& ground : {Json{{"size", 0}}, Json{{"size", -1}}}) {
    EXPECT_FALSE(decodeFrameSpec(specOf({{"ground", ground}}).dump())) << ground;
  }
}

TEST(Ground, StandsStillInViewMotion) {
  const Json moved = {{"views", {"motion"}},
                      {"ground", {{"height", 0}, {"size", 12}}},
                      {"motionFrom", {{"nodes", {{{"node", 0}, {"translation", {1, 0, 0}}}}}}}};
  const Frame frame = drawn(moved);
  EXPECT_EQ(testing::valueAt(frame, 0.1, 0.5), 0);
  EXPECT_NEAR(testing::valueAt(frame, 0.5, 0.5), -kSide / kMetres, 1e-2);
}

} // namespace
} // namespace gnomon
