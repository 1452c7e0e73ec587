// The world may lie anywhere: a scene, its camera and its lights moved alike give the same picture.
#include <algorithm>
#include <cmath>

#include "tests/renderer/frame_fixture.h"
#include "tests/support/moved_scene.h"

namespace gnomon {
namespace {

using testing::renderJson;

using Place = std::array<double, 3>;

Place moved(const Place& by, double x, double y, double z) {
  return {by[0] + x, by[1] + y, by[2] + z};
}

/// A ground and two dozen turned slabs above it.
Bytes slabs() {
  testing::GlbBuilder builder = testing::cube();
  builder.json["nodes"][0] = {{"mesh", 0}, {"scale", {14, 0.5, 14}}, {"translation", {0, -0.5, 0}}};
  for (int i = 0; i < 24; ++i) {
    const double angle = 2.4 * i;
    const double away = 0.9 + 0.38 * i;
    const double half = 0.31 * i;
    builder.addRoot({{"mesh", 0},
                     {"translation", {away * std::cos(angle), 0.45 + 0.11 * i, away * std::sin(angle)}},
                     {"rotation", {0.6 * std::sin(half), 0.8 * std::sin(half), 0, std::cos(half)}},
                     {"scale", {0.5, 0.06, 0.3 + 0.03 * i}}});
  }
  return builder.glb();
}

Json lightAt(const Place& root, const std::string& type) {
  if (type == "directional") return {{"type", type}, {"direction", {0.7, -1, -0.4}}};
  Json light = {{"type", type}, {"position", moved(root, 1.3, 7.1, 2.2)}, {"intensity", 150}};
  if (type == "spot") light.update({{"direction", {-0.2, -1, -0.3}}, {"outerConeDegrees", 60}});
  return light;
}

Json cameraAt(const Place& root, bool perspective) {
  Json camera = {{"eye", moved(root, 7.3, 5.9, 11.7)}, {"target", moved(root, 0.2, 0.4, -0.3)}};
  if (perspective) {
    camera["perspective"] = {{"fovYDegrees", 50}, {"near", 0.5}};
  } else {
    camera["orthographic"] = {{"height", 12}, {"near", 0.5}, {"far", 60}};
  }
  return camera;
}

/// Everything that should make no difference.
struct Setting {
  std::string light;
  bool perspective = true;
  std::string filter;
  std::string stabilization;
  std::string antialiasing;

  std::string text() const {
    return light + (perspective ? ", perspective, " : ", orthographic, ") + filter + ", " + stabilization + ", " +
           antialiasing;
  }
};

std::vector<std::uint8_t> pixelsAt(const ScenePtr& scene, const Place& root, const Setting& setting) {
  const Json spec = {{"width", 256},
                     {"height", 144},
                     {"camera", cameraAt(root, setting.perspective)},
                     {"lights", {lightAt(root, setting.light)}},
                     {"shadow",
                      {{"filter", {{"type", setting.filter}}},
                       {"stabilization", setting.stabilization},
                       {"depthRange", {{"mode", "manual"}, {"min", 0}, {"max", 40}}}}},
                     {"antialiasing", setting.antialiasing}};
  const Frame frame = renderJson(scene, spec.dump());
  return frame.images.empty() ? std::vector<std::uint8_t>{}
                              : std::get<std::vector<std::uint8_t>>(frame.images[0].image.pixels);
}

/// Pixels of which some channel differs by more than one level.
long pixelsOff(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, std::size_t channels) {
  long off = 0;
  for (std::size_t i = 0; i < a.size(); i += channels) {
    bool differs = false;
    for (std::size_t c = i; c < i + channels; ++c) differs = differs || std::abs(a[c] - b[c]) > 1;
    off += differs ? 1 : 0;
  }
  return off;
}

std::vector<Setting> settingsOf(const std::string& light, bool perspective) {
  std::vector<Setting> settings;
  for (const char* filter : {"hard", "pcf"}) {
    for (const char* stabilization : {"none", "projectionSnapping", "viewSnapping"}) {
      for (const char* antialiasing : {"none", "msaa4x"}) {
        settings.push_back({light, perspective, filter, stabilization, antialiasing});
      }
    }
  }
  return settings;
}

void holdThePictureStill(const std::string& light) {
  constexpr std::size_t kPixels = 256 * 144;
  const ScenePtr here = testing::sceneOf(slabs());
  for (const double away : {1e6, 1e7}) {
    const Place root{away, 0.1 * away, -away};
    const ScenePtr there = testing::sceneOf(testing::movedBy(slabs(), root));
    for (const bool perspective : {true, false}) {
      for (const Setting& setting : settingsOf(light, perspective)) {
        const auto expected = pixelsAt(here, {0, 0, 0}, setting);
        const auto actual = pixelsAt(there, root, setting);
        ASSERT_EQ(expected.size(), actual.size());
        ASSERT_GE(expected.size(), 3 * kPixels);
        const auto [least, most] = std::minmax_element(expected.begin(), expected.end());
        EXPECT_GT(*most - *least, 100) << "shows next to nothing: " << setting.text();
        EXPECT_LE(pixelsOff(expected, actual, expected.size() / kPixels), static_cast<long>(kPixels / 10'000))
            << away << " m away: " << setting.text();
      }
    }
  }
}

TEST(BigWorlds, H12_ADirectionalLightsPictureIsTheSameAnywhere) {
  holdThePictureStill("directional");
}

TEST(BigWorlds, H12_ASpotsPictureIsTheSameAnywhere) {
  holdThePictureStill("spot");
}

TEST(BigWorlds, H12_APointLightsPictureIsTheSameAnywhere) {
  holdThePictureStill("point");
}

} // namespace
} // namespace gnomon
