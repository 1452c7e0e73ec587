// Exact techniques, held against rays.
#include <cmath>

#include "tests/renderer/techniques/traced_frame.h"
#include "tests/support/tested_device.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::generatedScene;
using testing::misclassified;
using testing::renderJson;
using testing::truthOf;

const char* const kSun = R"([{"type":"directional","sun":{"azimuthDegrees":120,"elevationDegrees":35}}])";
const char* const kLowSun = R"([{"type":"directional","sun":{"azimuthDegrees":200,"elevationDegrees":8}}])";
const char* const kPoint = R"([{"type":"point","position":[1.5,4.2,2.5],"intensity":300}])";
const char* const kSpot =
    R"([{"type":"spot","position":[2,5,3],"direction":[-0.4,-1,-0.5],"outerConeDegrees":40,"intensity":300}])";

std::string specOf(const std::string& lights, const Json& patch) {
  Json spec{{"width", 320},
            {"height", 180},
            {"camera", {{"node", "camera"}}},
            {"lights", Json::parse(lights)},
            {"antialiasing", "none"},
            {"views", {"shadow"}},
            {"output", {{"format", "exr"}}}};
  spec.merge_patch(patch);
  return spec.dump();
}

std::string shadowSpec(const std::string& lights, const char* technique) {
  return specOf(lights, {{"shadow", {{"technique", technique}}}});
}

struct Case {
  const char* scene;
  const char* lights;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene << ' ' << c.lights;
}

class ExactTechniques : public ::testing::TestWithParam<Case> {};

TEST_P(ExactTechniques, RayTracedShadowsAreTheTruth) {
  const ScenePtr scene = generatedScene(GetParam().scene);
  const std::string spec = shadowSpec(GetParam().lights, "rayTraced");
  const auto count = misclassified(floatsOf(renderJson(scene, spec)), truthOf(scene, spec));
  EXPECT_GT(count.receivers, 1000u);
  EXPECT_EQ(count.wrong, 0u);
}

TEST_P(ExactTechniques, AViewOfTheMapChangesNoShadow) {
  const ScenePtr scene = generatedScene(GetParam().scene);
  const Frame alone = renderJson(scene, shadowSpec(GetParam().lights, "rayTraced"));
  const Json shown{{"shadow", {{"technique", "rayTraced"}}}, {"views", {"shadow", "cascades"}}};
  const Frame mapped = renderJson(scene, specOf(GetParam().lights, shown));
  EXPECT_TRUE(alone.report.lights[0].tiles.empty());
  EXPECT_FALSE(mapped.report.lights[0].tiles.empty());
  EXPECT_EQ(floatsOf(alone), floatsOf(mapped));
}

INSTANTIATE_TEST_SUITE_P(Scenes, ExactTechniques,
                         ::testing::Values(Case{"box_on_plane", kSun}, Case{"box_on_plane", kLowSun},
                                           Case{"box_on_plane", kPoint}, Case{"box_on_plane", kSpot},
                                           Case{"tilted_planes", kSun}, Case{"tilted_planes", kPoint},
                                           Case{"long_row", kSun}, Case{"long_row", kLowSun}, Case{"thin_slats", kSun},
                                           Case{"thin_slats", kPoint}, Case{"mask_leaf", kSun},
                                           Case{"mirrored_node", kSun}, Case{"double_sided", kSun},
                                           Case{"caster_behind_camera", kLowSun}, Case{"city", kSun},
                                           Case{"city", kLowSun}, Case{"lights", kSpot}),
                         [](const auto& test) {
                           const std::string lights = test.param.lights;
                           const char* const kind = lights == kSun      ? "_sun"
                                                    : lights == kLowSun ? "_lowSun"
                                                    : lights == kPoint  ? "_point"
                                                                        : "_spot";
                           return std::string(test.param.scene) + kind;
                         });

TEST(ExactShadows, TheirEdgesAreAntialiased) {
  const ScenePtr scene = generatedScene("box_on_plane");
  const Json views{"lightContribution"};
  const Frame plain = renderJson(scene, specOf(kSun, {{"shadow", {{"technique", "rayTraced"}}}, {"views", views}}));
  const Frame smooth = renderJson(
      scene, specOf(kSun, {{"shadow", {{"technique", "rayTraced"}}}, {"views", views}, {"antialiasing", "msaa4x"}}));
  std::size_t between = 0;
  double difference = 0;
  const auto& a = floatsOf(plain);
  const auto& b = floatsOf(smooth);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference += std::abs(a[i] - b[i]);
    if (std::abs(a[i] - b[i]) > 0.05f) ++between;
  }
  EXPECT_GT(between, 300u);
  EXPECT_LT(difference / double(a.size()), 0.02);
}

TEST(ExactShadows, LightsOfSeveralTechniquesShareAFrame) {
  const ScenePtr scene = generatedScene("box_on_plane");
  const Json lights = Json::parse(R"([
      {"type":"directional","sun":{"azimuthDegrees":120,"elevationDegrees":35},"shadow":{"technique":"rayTraced"}},
      {"type":"directional","sun":{"azimuthDegrees":240,"elevationDegrees":40},"shadow":{"technique":"shadowMap"}},
      {"type":"point","position":[1.5,4.2,2.5],"intensity":60,"shadow":{"technique":"lightMap"}}])");
  const auto alone = [&](int light) {
    return floatsOf(
        renderJson(scene, specOf(Json::array({lights[static_cast<std::size_t>(light)]}).dump(), Json::object())));
  };
  for (int light = 0; light < 3; ++light) {
    const Frame frame = renderJson(scene, specOf(lights.dump(), {{"debug", {{"light", light}}}}));
    const auto& together = floatsOf(frame);
    const auto single = alone(light);
    std::size_t differing = 0;
    for (std::size_t i = 0; i < together.size(); ++i) differing += std::abs(together[i] - single[i]) > 0.01f ? 1 : 0;
    EXPECT_LT(differing, 20u) << light; // tiles share an atlas: the map's own edges may move
  }
}

} // namespace
} // namespace gnomon
