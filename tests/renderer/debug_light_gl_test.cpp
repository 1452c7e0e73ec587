// Which light and which tile the debug views show.
#include "protocol/json/json_codec.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::generatedScene;
using testing::renderJson;

const Json kEast = {{"type", "directional"}, {"sun", {{"azimuthDegrees", 90}, {"elevationDegrees", 40}}}};
const Json kWest = {{"type", "directional"}, {"sun", {{"azimuthDegrees", 270}, {"elevationDegrees", 40}}}};

Json exrOf(const std::vector<std::string>& views) {
  return {{"width", 96},
          {"height", 54},
          {"camera", {{"node", "camera"}}},
          {"views", views},
          {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
}

TEST(DebugLight, ShadowIsThatOfTheChosenLight) {
  const ScenePtr scene = generatedScene("box_on_plane");
  Json both = exrOf({"shadow"});
  both["lights"] = {kEast, kWest};
  Json alone = exrOf({"shadow"});
  alone["lights"] = {kWest};
  EXPECT_NE(floatsOf(renderJson(scene, both.dump())), floatsOf(renderJson(scene, alone.dump())));
  both["debug"]["light"] = 1;
  const std::vector<float> chosen = floatsOf(renderJson(scene, both.dump()));
  const std::vector<float> expected = floatsOf(renderJson(scene, alone.dump()));
  // Its tiles lie elsewhere in the atlas, where coordinates round otherwise.
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(chosen[i], expected[i], 1e-2f) << i;
}

TEST(DebugLight, X29_TheTintIsByTheChosenLightsCascades) {
  Json spec = exrOf({"cascades"});
  spec["lights"] = {kEast, kWest};
  spec["lights"][0]["shadow"]["cascadeCount"] = 4;
  spec["lights"][1]["shadow"]["cascadeCount"] = 1;
  spec["antialiasing"] = "none";
  // Pixels tinted with the first and the second color.
  const auto tinted = [&](int light) {
    spec["debug"]["light"] = light;
    const std::vector<float> pixels = floatsOf(renderJson(generatedScene("long_row"), spec.dump()));
    std::array<int, 2> counts{};
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
      const auto is = [&](float r, float g, float b) {
        const float grey = pixels[i + 1] / g;
        return std::abs(pixels[i] - r * grey) < 1e-3f && std::abs(pixels[i + 2] - b * grey) < 1e-3f;
      };
      counts[0] += is(0.35f, 1.0f, 0.35f);
      counts[1] += is(0.35f, 0.5f, 1.0f);
    }
    return counts;
  };
  const auto four = tinted(0);
  const auto one = tinted(1);
  EXPECT_GT(four[0], 500);
  EXPECT_GT(four[1], 50);
  EXPECT_EQ(one[1], 0) << "it has one cascade";
  EXPECT_GE(one[0], four[0] + four[1]);
}

TEST(DebugLight, ContributionsAndAmbientAddUpToTheColor) {
  const ScenePtr scene = generatedScene("lights");
  const std::vector<float> color = floatsOf(renderJson(scene, exrOf({"color"}).dump()));
  Json unlit = exrOf({"color"});
  unlit["lights"] = Json::array();
  std::vector<float> sum = floatsOf(renderJson(scene, unlit.dump()));
  for (const int light : {0, 1, 2}) {
    Json spec = exrOf({"lightContribution"});
    spec["debug"]["light"] = light;
    const auto part = floatsOf(renderJson(scene, spec.dump()));
    ASSERT_EQ(part.size(), sum.size());
    EXPECT_GT(*std::max_element(part.begin(), part.end()), 0.1f) << light;
    std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
  }
  for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(sum[i], color[i], 1e-5f * (1 + color[i])) << i;
}

TEST(DebugLight, AContributionIsToneMappedAsTheColorIs) {
  const Json view = {{"width", 96},
                     {"height", 54},
                     {"camera", {{"node", "camera"}}},
                     {"ambient", {{"intensity", 0}}},
                     {"lights", {kEast}},
                     {"background", {{"color", {0, 0, 0}}}},
                     {"views", {"color", "lightContribution"}}};
  const Frame frame = renderJson(generatedScene("box_on_plane"), view.dump());
  EXPECT_EQ(frame.images[0].image.pixels, frame.images[1].image.pixels);
}

TEST(DebugLight, WithoutAShadowTheViewsShowNothing) {
  Json spec = exrOf({"shadow", "texelDensity", "blendWeight", "bias", "casterIds", "cascades", "texelGrid"});
  spec["lights"] = {kEast, kWest};
  spec["lights"][1]["shadow"]["enabled"] = false;
  spec["debug"]["light"] = 1;
  spec["background"]["color"] = {0.5, 0.5, 0.5};
  const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
  const std::array<float, 5> nothing{1, 0, 0, 0, -1};
  for (std::size_t view = 0; view < nothing.size(); ++view) {
    for (const float value : floatsOf(frame, view)) ASSERT_EQ(value, nothing[view]) << view;
  }
  for (const std::size_t view : {5u, 6u}) {
    const auto& rgb = floatsOf(frame, view);
    for (std::size_t i = 0; i < rgb.size(); i += 3) ASSERT_TRUE(rgb[i] == rgb[i + 1] && rgb[i] == rgb[i + 2]) << view;
  }
}

TEST(DebugLight, WithoutAnyLightTheViewsShowNothing) {
  Json spec = exrOf({"shadow", "texelDensity", "casterIds", "lightContribution"});
  spec["lights"] = Json::array();
  const Frame frame = renderJson(generatedScene("box_on_plane"), spec.dump());
  const std::array<float, 4> nothing{1, 0, -1, 0};
  for (std::size_t view = 0; view < nothing.size(); ++view) {
    for (const float value : floatsOf(frame, view)) ASSERT_EQ(value, nothing[view]) << view;
  }
}

TEST(DebugLight, M15_ATileIsItsRectangleOfTheAtlas) {
  Json spec = exrOf({"atlas", "tile"});
  spec["shadow"]["size"] = "XSmall";
  spec["debug"]["tile"] = 2;
  const Frame frame = renderJson(generatedScene("long_row"), spec.dump());
  const Image& atlas = frame.images[0].image;
  const Image& tile = frame.images[1].image;
  const auto& [x, y, width, height] = frame.report.lights[0].tiles.at(2).tile;
  ASSERT_EQ(tile.width, width);
  ASSERT_EQ(tile.height, height);
  EXPECT_EQ(tile.channels, std::vector<std::string>{"Z"});
  EXPECT_TRUE(x > 0 || y > 0) << "not the atlas's corner";
  for (int row = 0; row < height; ++row) {
    const auto from = floatsOf(frame, 0).begin() + (atlas.height - y - height + row) * atlas.width + x;
    ASSERT_TRUE(std::equal(from, from + width, floatsOf(frame, 1).begin() + row * width)) << row;
  }
  const auto& depths = floatsOf(frame, 1);
  EXPECT_LT(*std::min_element(depths.begin(), depths.end()), 1.0f) << "something casts";
}

TEST(DebugLight, D4_FourDepthsATexelAreReadAsTheNearest) {
  Json spec = exrOf({"atlas", "tile"});
  spec["shadow"]["size"] = "Small";
  const std::vector<float> one = floatsOf(renderJson(generatedScene("long_row"), spec.dump()), 1);
  spec["atlas"]["samples"] = 4;
  const std::vector<float> four = floatsOf(renderJson(generatedScene("long_row"), spec.dump()), 1);
  ASSERT_EQ(four.size(), one.size());
  std::size_t differ = 0;
  std::size_t nearer = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    differ += std::abs(four[i] - one[i]) > 0.02f;
    nearer += four[i] < one[i];
  }
  EXPECT_LT(differ, one.size() / 20) << "but for outlines they are the same";
  EXPECT_GT(nearer, one.size() / 2) << "on a slope some sample is nearer than the middle";
}

TEST(DebugLight, TheOrderOfTheViewsChangesNone) {
  const std::vector<std::string> views{"casterIds", "color", "bias",     "tile",   "texelDensity",
                                       "atlas",     "depth", "cascades", "normal", "shadow"};
  const std::vector<std::string> turned(views.rbegin(), views.rend());
  const Frame one = renderJson(generatedScene("box_on_plane"), exrOf(views).dump());
  const Frame other = renderJson(generatedScene("box_on_plane"), exrOf(turned).dump());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(one.images[i].image.pixels, other.images[views.size() - 1 - i].image.pixels) << views[i];
  }
}

} // namespace
} // namespace gnomon
