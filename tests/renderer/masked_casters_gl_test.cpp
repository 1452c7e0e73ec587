// Materials whose holes are finer than the texels of a shadow map, or than pixels, seen in rendered frames.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "protocol/json/json_codec.h"
#include "renderer/image/picture_encode.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr int kTexels = 1024; ///< of the texture, a side

/// Texels that let all through or nothing, by chance; so many tenths of them nothing.
Bytes speckles(unsigned opaqueTenths) {
  Image image{kTexels, kTexels, {"R", "G", "B", "A"}, std::vector<std::uint8_t>(4 * kTexels * kTexels, 255)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  std::mt19937 random(1);
  for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = random() % 10 < opaqueTenths ? 255 : 0;
  return *encodePng(image, 1);
}

/// A ground of 20 m and a sheet of 10 m at y 2, whose texels are 1 cm; half of that where they are `moved` by a
/// transform.
testing::GlbBuilder speckledSheetOver(const std::string& alphaMode, bool moved, unsigned opaqueTenths) {
  const Bytes png = speckles(opaqueTenths);
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {10, 1, 10};
  builder.add("images", {{"bufferView", builder.addView(png)}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  Json texture = {{"index", 0}};
  if (moved) {
    texture["extensions"]["KHR_texture_transform"] = {{"scale", {2, 2}}, {"rotation", 0.5}};
    builder.json["extensionsUsed"] = {"KHR_texture_transform"};
  }
  builder.add("materials", {{"alphaMode", alphaMode}, {"pbrMetallicRoughness", {{"baseColorTexture", texture}}}});
  builder.add("meshes", builder.json["meshes"][0]);
  builder.json["meshes"][1]["primitives"][0]["material"] = 0;
  builder.addRoot({{"mesh", 1}, {"scale", {5, 1, 5}}, {"translation", {0, 2, 0}}});
  return builder;
}

ScenePtr specklesOver(const std::string& alphaMode, bool moved, unsigned opaqueTenths = 3) {
  return testing::sceneOf(speckledSheetOver(alphaMode, moved, opaqueTenths));
}

/// The mean share of the light on the ground below the sheet. A tile's texels are about 6 cm.
double meanBelow(const ScenePtr& scene, const Json& light, Json shadow) {
  shadow["size"] = "XSmall";
  shadow["filter"] = {{"type", "pcf"}, {"size", 7}};
  const Json spec = {
      {"width", 96},
      {"height", 96},
      {"camera",
       {{"eye", {0, 1.9, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 120}}}}},
      {"lights", {light}},
      {"shadow", shadow},
      {"antialiasing", "none"},
      {"views", {"shadow"}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  const Frame frame = renderJson(scene, spec.dump());
  const auto& visibility = floatsOf(frame);
  return std::accumulate(visibility.begin(), visibility.end(), 0.0) / static_cast<double>(visibility.size());
}

const std::vector<Json> kLights = Json::parse(R"([{"type":"directional","direction":[0.02,-1,0.01]},
    {"type":"spot","position":[0.3,9,0.2],"direction":[0,-1,0.01],"outerConeDegrees":40},
    {"type":"point","position":[0.3,9,0.2]}])");

TEST(MaskedCasters, G2_HolesFinerThanAMapsTexelsLetThroughAsMuchAsRaysFind) {
  for (const bool moved : {false, true}) {
    for (const char* mode : {"MASK", "BLEND"}) {
      const ScenePtr scene = specklesOver(mode, moved);
      for (const Json& light : kLights) {
        const Json cut = {{"blendedCasters", "threshold"}};
        Json traced = cut;
        traced["technique"] = "rayTraced";
        const double byRays = meanBelow(scene, light, traced);
        EXPECT_GT(byRays, 0.6);
        EXPECT_LT(byRays, 0.8);
        EXPECT_NEAR(meanBelow(scene, light, cut), byRays, 0.03) << mode << light << (moved ? ", moved" : "");
      }
    }
  }
}

TEST(MaskedCasters, X34_FineHolesThatAreDitheredLetThroughTheMeanOfWhatTheyLeave) {
  for (const bool moved : {false, true}) {
    const ScenePtr scene = specklesOver("BLEND", moved);
    for (const Json& light : kLights) {
      EXPECT_NEAR(meanBelow(scene, light, {{"blendedCasters", "dither"}}), 0.7, 0.03)
          << light << (moved ? ", moved" : "");
    }
  }
}

/// All from high above, where a pixel is as large as 6 texels or more.
const std::vector<Json> kCameras = Json::parse(R"([
    {"eye": [0, 12, 0], "target": [0, 0, 0], "up": [0, 0, -1]},
    {"eye": [3, 12, 3], "target": [0, 0, 0], "perspective": {"fovYDegrees": 30}},
    {"eye": [1, 12, 0], "target": [1, 0, 0], "up": [0, 0, -1],
     "intrinsics": {"fx": 116, "fy": 116, "cx": 60, "cy": 40}},
    {"eye": [2, 12, 3], "target": [0, 2, 0], "orthographic": {"height": 6, "near": 0.1, "far": 30}}])");

TEST(MaskedCasters, G2_WhatIsSeenOfASheetFromAfarIsNotShadedByIt) {
  for (const bool moved : {false, true}) {
    const ScenePtr scene = specklesOver("MASK", moved, 8);
    for (const Json& camera : kCameras) {
      const Json spec = {{"width", 96},
                         {"height", 96},
                         {"camera", camera},
                         {"lights", kLights},
                         {"shadow", {{"technique", "rayTraced"}}},
                         {"antialiasing", "none"},
                         {"views", {"shadow", "reference", "ids"}},
                         {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
      const Frame frame = renderJson(scene, spec.dump());
      const std::vector<float>& ids = floatsOf(frame, 2);
      const auto sheet = static_cast<double>(std::ranges::count(ids, 1.0f));
      const auto ground = static_cast<double>(std::ranges::count(ids, 0.0f));
      EXPECT_NEAR(sheet / (sheet + ground), 0.84, 0.03) << "of the filtered texture more than half are opaque";
      for (std::size_t view = 0; view < 2; ++view) {
        const std::vector<float>& lit = floatsOf(frame, view);
        int shaded = 0;
        for (std::size_t i = 0; i < lit.size(); ++i) shaded += ids[i] == 1 && lit[i] < 0.999f ? 1 : 0;
        EXPECT_LE(shaded, 0.003 * sheet) << camera << moved << view
                                         << ": but near the cutoff rounding decides what is seen";
      }
      ASSERT_TRUE(frame.report.error);
      EXPECT_EQ(frame.report.error->misclassified, 0) << camera;
    }
  }
}

/// From near by, where a pixel is half a texel: a picture reads a mask once for all samples of a pixel.
TEST(MaskedCasters, G2_NoSampleOfThePixelsThatShowTheSheetIsShadedByIt) {
  const ScenePtr scene = specklesOver("MASK", false, 5);
  for (const char* antialiasing : {"none", "msaa4x"}) {
    const Json spec = {
        {"width", 96},
        {"height", 96},
        {"camera", {{"eye", {0.1, 3, 0.2}}, {"target", {0, 2, 0}}, {"perspective", {{"fovYDegrees", 30}}}}},
        {"lights", {kLights[0]}},
        {"ambient", {{"intensity", 0}}},
        {"shadow", {{"technique", "rayTraced"}}},
        {"antialiasing", antialiasing},
        {"views", {"color", "ids"}},
        {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
    const Frame frame = renderJson(scene, spec.dump());
    const auto& ids = floatsOf(frame, 1);
    const auto& colors = floatsOf(frame, 0);
    const std::size_t channels = colors.size() / ids.size();
    std::vector<float> onSheet;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (ids[i] == 1) onSheet.push_back(colors[i * channels]);
    }
    ASSERT_GT(onSheet.size(), 2000u);
    const auto [least, most] = std::ranges::minmax(onSheet);
    EXPECT_GT(least, 0.9f * most) << ", " << antialiasing;
  }
}

/// Under a roof of 8 m at y 4 the sheet is dark. The ground, which shows through holes that are about a pixel large,
/// sees the sun past the roof through other holes: among dark pixels those whose first ray meets none are dark, too.
TEST(MaskedCasters, N1_RaysBesideHolesFindThePartOfALightThatTheFirstOneMisses) {
  testing::GlbBuilder builder = speckledSheetOver("MASK", false, 8);
  builder.addRoot({{"mesh", 0}, {"scale", {4, 1, 4}}, {"translation", {0, 4, 0}}, {"rotation", {1, 0, 0, 0}}});
  const ScenePtr scene = testing::sceneOf(builder);
  const double elevation = glm::radians(40.0);
  const Json spec = {
      {"width", 96},
      {"height", 96},
      {"camera",
       {{"eye", {0.4, 3.8, 0}}, {"target", {0.4, 0, 0}}, {"up", {0, 0, -1}}, {"perspective", {{"fovYDegrees", 30}}}}},
      {"lights",
       {{{"type", "directional"},
         {"direction", {-std::cos(elevation), -std::sin(elevation), 0}},
         {"angularDiameterDegrees", 5}}}},
      {"shadow", {{"technique", "rayTraced"}}},
      {"antialiasing", "none"},
      {"views", {"shadow", "reference"}},
      {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  const Frame frame = renderJson(scene, spec.dump());
  const auto& found = floatsOf(frame, 0);
  const auto& truth = floatsOf(frame, 1);
  int lit = 0, missed = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] < 0.1f) continue;
    ++lit;
    missed += found[i] == 0 ? 1 : 0;
  }
  EXPECT_GT(lit, 1000);
  EXPECT_LT(missed, 0.3 * lit) << ": by first rays alone it is 0.38 of them";
}

struct LeafPlane {
  Json material;
  double vertexAlpha = 1; ///< of COLOR_0
};

constexpr int kLeavesSide = 256; ///< texels

/// Leaves: discs of 2 to 5 texels all over 256 x 256, which cover about a third.
Bytes leaves() {
  Image image{
      kLeavesSide, kLeavesSide, {"R", "G", "B", "A"}, std::vector<std::uint8_t>(4 * kLeavesSide * kLeavesSide, 255)};
  auto& pixels = std::get<std::vector<std::uint8_t>>(image.pixels);
  std::mt19937 random(3);
  std::vector<float> alpha(kLeavesSide * kLeavesSide, 0.0f);
  for (int leaf = 0; leaf < 800; ++leaf) {
    const int x = static_cast<int>(random() % kLeavesSide), y = static_cast<int>(random() % kLeavesSide);
    const float radius = 1.0f + static_cast<float>(random() % 100) / 65.0f;
    for (int dy = -4; dy <= 4; ++dy) {
      for (int dx = -4; dx <= 4; ++dx) {
        float& at = alpha[static_cast<std::size_t>((y + dy + kLeavesSide) % kLeavesSide * kLeavesSide +
                                                   (x + dx + kLeavesSide) % kLeavesSide)];
        at = std::max(
            at, std::clamp(radius + 0.5f - std::hypot(static_cast<float>(dx), static_cast<float>(dy)), 0.0f, 1.0f));
      }
    }
  }
  for (std::size_t i = 0; i < alpha.size(); ++i) pixels[4 * i + 3] = static_cast<std::uint8_t>(255 * alpha[i] + 0.5f);
  return *encodePng(image, 1);
}

/// Planes of 2 m beside each other, node by node, that show one picture of leaves.
testing::GlbBuilder leafPlanes(const std::vector<LeafPlane>& planes) {
  testing::GlbBuilder builder = testing::plane();
  builder.add("images", {{"bufferView", builder.addView(leaves())}, {"mimeType", "image/png"}});
  builder.add("textures", {{"source", 0}});
  const nlohmann::json mesh = builder.json["meshes"][0];
  builder.json["nodes"][0]["scale"] = {0, 0, 0};
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Json material = planes[i].material;
    material["doubleSided"] = true;
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    nlohmann::json own = mesh;
    own["primitives"][0]["material"] = builder.add("materials", material);
    if (planes[i].vertexAlpha != 1) {
      std::vector<float> colors;
      for (int corner = 0; corner < 4; ++corner) {
        colors.insert(colors.end(), {1, 1, 1, static_cast<float>(planes[i].vertexAlpha)});
      }
      own["primitives"][0]["attributes"]["COLOR_0"] = builder.addAccessor(colors, "VEC4", 5126, 4);
    }
    builder.json["meshes"].push_back(own);
    builder.addRoot({{"mesh", static_cast<int>(i) + 1}, {"translation", {3.0 * static_cast<double>(i), 0, 0}}});
  }
  return builder;
}

constexpr int kPicture = 256; ///< pixels a side

/// Of the pixels where a plane lies, seen from straight above, `pixels` of them wide: the share that shows it.
double shownShare(const ScenePtr& scene, int plane, int pixels, const char* antialiasing) {
  const Json spec = {{"width", kPicture},
                     {"height", kPicture},
                     {"camera",
                      {{"eye", {3.0 * plane, 5, 0}},
                       {"target", {3.0 * plane, 0, 0}},
                       {"up", {0, 0, -1}},
                       {"orthographic", {{"height", 2.0 * kPicture / pixels}}}}},
                     {"lights", Json::array()},
                     {"antialiasing", antialiasing},
                     {"views", {"ids"}},
                     {"output", {{"format", "exr"}}}};
  const Frame frame = renderJson(scene, spec.dump());
  const auto& ids = floatsOf(frame);
  const int first = (kPicture - pixels) / 2;
  int shown = 0;
  for (int y = first; y < first + pixels; ++y) {
    for (int x = first; x < first + pixels; ++x) shown += ids[static_cast<std::size_t>(y * kPicture + x)] >= 0;
  }
  return static_cast<double>(shown) / (pixels * pixels);
}

/// Two materials with cutoffs of their own share one image; a third has part of its alpha in its vertices.
TEST(MaskedCasters, G2_FromAfarAsMuchShowsAsNearWhateverTheCutoff) {
  const auto masked = [](double cutoff) { return Json{{"alphaMode", "MASK"}, {"alphaCutoff", cutoff}}; };
  const std::vector<LeafPlane> planes{
      {masked(0.5)}, {masked(0.9)}, {masked(0.1)}, {masked(0.5), 0.6}, {{{"alphaMode", "BLEND"}}}};
  const ScenePtr scene = testing::sceneOf(leafPlanes(planes));
  for (int plane = 0; plane < static_cast<int>(planes.size()); ++plane) {
    const double near = shownShare(scene, plane, kLeavesSide, "none"); // a pixel a texel
    EXPECT_GT(near, 0.05) << plane;
    EXPECT_LT(near, 0.6) << plane;
    for (const int pixels : {96, 64, 48, 24}) {
      const double slack = 0.05 + 1.0 / pixels;
      EXPECT_NEAR(shownShare(scene, plane, pixels, "none"), near, slack) << "plane " << plane << " of " << pixels;
    }
    EXPECT_NEAR(shownShare(scene, plane, 64, "msaa4x"), near, 0.07) << "plane " << plane;
  }
}

} // namespace
} // namespace gnomon
