// How a shadow map is read, seen in rendered frames.
#include <cmath>
#include <gmock/gmock.h>

#include "protocol/json/json_codec.h"
#include "renderer/shadow/tile_space.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr double kPi = 3.14159265358979;

/// A turned square card of 1 m, 2 m over a floor of 20 m.
testing::GlbBuilder cardOverFloor(double turnDegrees) {
  testing::GlbBuilder builder = testing::plane();
  nlohmann::json card = builder.json["nodes"][0];
  builder.json["nodes"][0]["scale"] = {10, 10, 10};
  const double half = turnDegrees * kPi / 360;
  card["scale"] = {0.5, 1, 0.5};
  card["translation"] = {0, 2, 0};
  card["rotation"] = {0, std::sin(half), 0, std::cos(half)};
  builder.addRoot(card);
  return builder;
}

/// Metres by which a point of the floor lies inside the card's shadow, straight under it; negative outside.
double insideCard(const glm::dvec3& point, double turnDegrees) {
  const double angle = turnDegrees * kPi / 180;
  const double x = std::cos(angle) * point.x - std::sin(angle) * point.z;
  const double z = std::sin(angle) * point.x + std::cos(angle) * point.z;
  return 0.5 - std::max(std::abs(x), std::abs(z));
}

/// The weights of a filter's comparisons, a texel apart along an axis. Each comparison is bilinear.
std::vector<double> kernelWeights(int size) {
  switch (size) {
    case 3:
      return {1, 2, 1}; // 4 * 4 = 16
    case 5:
      return {1, 3, 4, 3, 1}; // 12 * 12 = 144
    case 7:
      return {1, 5, 12, 16, 12, 5, 1}; // 52 * 52 = 2704
    default:
      return {1};
  }
}

struct Share {
  double lit = 0;
  bool sure = true; ///< no texel that counts lies so near the card's edge that rasterizers may differ
};

/// What a filter finds at a point given in texels: every comparison by itself, each of four texels.
template <class LitMargin>
Share bruteForce(const glm::dvec2& texel, int size, LitMargin litMargin) {
  const std::vector<double> weights = kernelWeights(size);
  const int reach = static_cast<int>(weights.size()) / 2;
  Share share;
  double total = 0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const glm::dvec2 at = texel + glm::dvec2(x, y) - 0.5;
      const glm::dvec2 base = glm::floor(at);
      const glm::dvec2 fraction = at - base;
      for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 step(corner % 2, corner / 2);
        const glm::dvec2 part = glm::mix(1.0 - fraction, fraction, step);
        const double margin = litMargin(base + step + 0.5); // texels outside the card
        const double weight = weights[static_cast<std::size_t>(x + reach)] *
                              weights[static_cast<std::size_t>(y + reach)] * part.x * part.y;
        share.lit += margin > 0 ? weight : 0;
        share.sure = share.sure && std::abs(margin) > 0.05;
        total += weight;
      }
    }
  }
  share.lit /= total;
  return share;
}

TEST(MapReading, X28_M8_AFilterIsTheMeanOfItsComparisonsOfSingleTexels) {
  constexpr double kTurn = 17;
  constexpr int kPixels = 300;
  const ScenePtr scene = testing::sceneOf(cardOverFloor(kTurn));
  const LightBasis basis = lightBasis({0, -1, 0});
  const glm::dvec3 forward = glm::normalize(glm::dvec3(1, -1, 0));
  const glm::dvec3 up = glm::normalize(glm::dvec3(1, 1, 0));
  for (const int size : {1, 3, 5, 7}) {
    const Json filter = size == 1 ? Json{{"type", "hard"}} : Json{{"type", "pcf"}, {"size", size}};
    const Json spec = {
        {"width", kPixels},
        {"height", kPixels},
        {"camera",
         {{"eye", {-10, 10, 0}}, {"target", {0, 0, 0}}, {"orthographic", {{"height", 3}, {"near", 0.1}, {"far", 30}}}}},
        {"lights", {{{"type", "directional"}, {"direction", {0, -1, 0}}}}},
        // Snapped, so that texels lie on a grid that is counted from the world's origin.
        {"shadow",
         {{"filter", filter},
          {"size", "XLarge"},
          {"cascadeCount", 1},
          {"stabilization", "projectionSnapping"},
          {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 25}}}}},
        {"antialiasing", "none"},
        {"views", {"shadow"}},
        {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
    const Frame frame = renderJson(scene, spec.dump());
    const double texelSize = frame.report.lights.at(0).tiles.at(0).texelSize[0];
    ASSERT_LT(texelSize, 0.05);
    const auto textureMargin = [&](const glm::dvec2& center) {
      const glm::dvec3 world = basis.right * (center.x * texelSize) + basis.up * (center.y * texelSize);
      return -insideCard(world, kTurn) / texelSize;
    };
    int compared = 0;
    int partly = 0;
    double worst = 0;
    for (int row = 0; row < kPixels; ++row) {
      for (int column = 0; column < kPixels; ++column) {
        const glm::dvec2 picture(3.0 * ((column + 0.5) / kPixels - 0.5), 3.0 * (0.5 - (row + 0.5) / kPixels));
        const glm::dvec3 start = glm::dvec3(-10, 10, 0) + up * picture.y + glm::dvec3(0, 0, picture.x);
        const glm::dvec3 floor = start - forward * (start.y / forward.y);
        if (std::abs(floor.x) > 1 || std::abs(floor.z) > 1) continue; // the card itself shows farther off
        const glm::dvec2 texel = glm::dvec2(glm::dot(basis.right, floor), glm::dot(basis.up, floor)) / texelSize;
        const Share expected = bruteForce(texel, size, textureMargin);
        if (!expected.sure) continue;
        const float seen = floatsOf(frame).at(static_cast<std::size_t>(row * kPixels + column));
        worst = std::max(worst, std::abs(seen - expected.lit));
        ++compared;
        partly += expected.lit > 0.01 && expected.lit < 0.99 ? 1 : 0;
      }
    }
    EXPECT_LT(worst, 0.005) << filter; // positions are floats: some thousandths of a texel
    EXPECT_GT(partly, 50) << filter;
    EXPECT_GT(compared, 10000) << filter;
  }
}

TEST(MapReading, M7_X21_BeforeAndBeyondTheMapsDepthsAllIsLit) {
  Json spec = Json::parse(R"({"width":160,"height":90,"camera":{"node":"camera"},"antialiasing":"none",
      "lights":[{"type":"directional","sun":{"azimuthDegrees":180,"elevationDegrees":25}}],
      "views":["shadow","depth"],"output":{"format":"exr"}})");
  const ScenePtr scene = testing::generatedScene("caster_behind_camera");
  const Frame whole = renderJson(scene, spec.dump());
  spec["shadow"] = {{"cascadeCount", 1}, {"depthRange", {{"mode", "manual"}, {"min", 5}, {"max", 12}}}};
  const Frame part = renderJson(scene, spec.dump());
  int outside = 0;
  int within = 0;
  int dark = 0;
  for (std::size_t i = 0; i < floatsOf(whole).size(); ++i) {
    if (floatsOf(whole)[i] != 0.0f) continue;
    const float depth = floatsOf(part, 1)[i];
    if (depth < 4.9f || depth > 12.2f) {
      EXPECT_EQ(floatsOf(part)[i], 1.0f) << "at a depth of " << depth;
      ++outside;
    }
    if (depth > 5.3f && depth < 9.0f) {
      dark += floatsOf(part)[i] < 0.1f ? 1 : 0; // the rest: the edge, which coarser texels draw wider
      ++within;
    }
  }
  EXPECT_GT(outside, 100);
  EXPECT_GT(within, 100);
  EXPECT_GT(dark, 0.95 * within);
}

TEST(MapReading, X12_NoFrameReadsWhatAnEarlierOneDrewIntoTheAtlas) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  const std::string small = R"({"width":160,"height":90,"camera":{"node":"camera"},"shadow":{"size":"Small"},
      "lights":[{"type":"directional","direction":[1,-1,0.3]}],"views":["atlas","shadow"],"output":{"format":"exr"}})";
  const Frame before = renderJson(scene, small);
  renderJson(scene, R"({"width":160,"height":90,"camera":{"node":"camera"},
      "lights":[{"type":"directional","direction":[-1,-1,0]},{"type":"point","position":[0,4,0]}]})");
  renderJson(testing::generatedScene("long_row"), R"({"width":160,"height":90,"camera":{"node":"camera"}})");
  const Frame after = renderJson(scene, small);
  for (const std::size_t view : {0u, 1u}) EXPECT_EQ(floatsOf(before, view), floatsOf(after, view));
}

TEST(MapReading, X1_DirectionalSpotAndPointLightsCastAndThereIsNoOtherType) {
  const ScenePtr scene = testing::sceneOf(cardOverFloor(0));
  const Json lights = Json::parse(R"([{"type":"directional","direction":[0,-1,0]}, {"type":"point","position":[0,5,0]},
      {"type":"spot","position":[0,5,0],"direction":[0,-1,0]}])");
  for (const Json& light : lights) {
    Json spec = {{"width", 160},
                 {"height", 160},
                 {"camera", {{"eye", {-4, 4, 0}}, {"target", {0, 0.5, 0}}}},
                 {"shadow", {{"size", "Large"}}},
                 {"lights", {light}},
                 {"views", {"shadow"}},
                 {"output", {{"format", "exr"}}}};
    const Frame frame = renderJson(scene, spec.dump());
    EXPECT_TRUE(frame.report.lights.at(0).shadowed) << light;
    EXPECT_LT(*std::min_element(floatsOf(frame).begin(), floatsOf(frame).end()), 0.001f) << light;
    spec["shadow"]["enabled"] = false;
    EXPECT_THAT(floatsOf(renderJson(scene, spec.dump())), ::testing::Each(1.0f)) << light;
  }
  const auto area = decodeFrameSpec(R"({"lights":[{"type":"area"}]})");
  ASSERT_FALSE(area);
  EXPECT_EQ(area.problems()[0].pointer, "/lights/0/type");
  EXPECT_EQ(area.problems()[0].limit, "directional, spot or point");
}

TEST(MapReading, M6_N2_EmptyTexelsAreAtTheFarEndAndEqualDepthsAreLit) {
  // Beside the floor the map is empty, at a depth of 1, and what a kernel reads of the floor's plane there is bounded
  // to that depth: the two are equal.
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {8, 1, 8};
  const ScenePtr scene = testing::sceneOf(builder);
  for (const Json& filter : {Json{{"type", "hard"}}, Json{{"type", "pcf"}, {"size", 5}}}) {
    const Json spec{
        {"width", 160},
        {"height", 160},
        {"camera", {{"eye", {0, 8, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", {{"height", 15}}}}},
        {"lights", {{{"type", "point"}, {"position", {0, 2, -2}}}}},
        {"shadow", {{"filter", filter}, {"size", "Small"}}},
        {"antialiasing", "none"},
        {"views", {"shadow", "atlas"}},
        {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
    const Frame frame = renderJson(scene, spec.dump());
    EXPECT_THAT(floatsOf(frame, 0), ::testing::Each(::testing::FloatNear(1, 1e-6f))) << filter;
    EXPECT_THAT(floatsOf(frame, 1),
                ::testing::AllOf(::testing::Contains(1.0f), ::testing::Contains(::testing::Lt(1.0f))))
        << filter;
  }
}

TEST(MapReading, G3_DegenerateTrianglesGiveNoNumberThatIsNone) {
  const auto withMesh = [](const std::vector<testing::Point>& points) {
    testing::GlbBuilder builder = cardOverFloor(30);
    builder.addMeshNode(builder.addMesh({{"attributes", {{"POSITION", builder.addPoints(points)}}}}));
    return testing::sceneOf(builder);
  };
  // A point, a line, a line back, and a needle that floats can't tell from a line.
  const ScenePtr degenerate = withMesh({{0.5f, 1, 0.5f},
                                        {0.5f, 1, 0.5f},
                                        {0.5f, 1, 0.5f},
                                        {0, 1, 0},
                                        {1, 1, 0},
                                        {2, 1, 0},
                                        {0, 1, 1},
                                        {1, 1, 1},
                                        {0, 1, 1},
                                        {0, 0.5f, 2},
                                        {1, 0.5f, 2},
                                        {0.5f, 0.5f, 2 + 1e-30f}});
  for (const char* filter : {"hard", "pcf", "vsm", "evsm", "msm"}) {
    const Json spec = {{"width", 96},
                       {"height", 96},
                       {"camera", {{"eye", {-6, 6, 1}}, {"target", {0, 0.5, 0}}}},
                       {"lights", Json::parse(R"([{"type":"directional","direction":[0.2,-1,0.1]},
                                                  {"type":"point","position":[0,5,0]}])")},
                       {"shadow", {{"filter", {{"type", filter}}}}},
                       {"views", {"color", "normal", "shadow", "atlas"}},
                       {"output", {{"format", "exr"}}}};
    const Frame frame = renderJson(degenerate, spec.dump());
    for (std::size_t view = 0; view < 4; ++view) {
      EXPECT_THAT(floatsOf(frame, view), ::testing::Each(::testing::Truly([](float v) { return std::isfinite(v); })))
          << filter << ", view " << view;
    }
    EXPECT_THAT(floatsOf(frame, 2), ::testing::Contains(1.0f)) << filter;
  }
}

} // namespace
} // namespace gnomon
