// A ground by the processor against that by OpenGL: one text decides both.
#include <cmath>
#include <stdexcept>

#include "tests/renderer/frame_fixture.h"
#include "tests/support/files.h"

namespace gnomon {
namespace {

Renderer madeWith(DeviceChoice device) {
  auto renderer = Renderer::create({.backend = {.device = device}});
  if (!renderer) throw std::runtime_error(renderer.problems()[0].detail);
  return std::move(*renderer);
}

std::vector<float> pixelsBy(Renderer& renderer, const ScenePtr& scene, const Json& json) {
  const auto spec = decodeFrameSpec(json.dump());
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  const auto frame = spec ? renderer.render(scene, *spec) : Result<Frame>(spec.problems());
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  return frame ? testing::floatsOf(*frame) : std::vector<float>{};
}

/// Percent of the pixels, multiplied by alpha, that differ by more than a fiftieth.
double percentApart(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t apart = 0;
  for (std::size_t i = 0; i + 3 < a.size(); i += 4) {
    bool differs = std::abs(a[i + 3] - b[i + 3]) > 0.02f;
    for (std::size_t c = 0; c < 3; ++c) {
      const float least = std::min(a[i + c] * a[i + 3], 1.0f) - std::min(b[i + c] * b[i + 3], 1.0f);
      differs = differs || std::abs(least) > 0.02f;
    }
    apart += differs ? 1 : 0;
  }
  return 400.0 * static_cast<double>(apart) / static_cast<double>(a.size());
}

std::size_t partlyCovered(const std::vector<float>& pixels) {
  std::size_t count = 0;
  for (std::size_t i = 3; i < pixels.size(); i += 4) count += pixels[i] > 0 && pixels[i] < 1 ? 1 : 0;
  return count;
}

TEST(GroundDevices, DrawTheSame) {
  Renderer cpu = madeWith(DeviceChoice::cpu);
  Renderer gl = madeWith(DeviceChoice::gl);
  const Json suns = {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 120}, {"elevationDegrees", 40}}}},
                     {{"type", "spot"},
                      {"position", {4, 9, 3}},
                      {"direction", {-4, -9, -3}},
                      {"intensity", 300},
                      {"shadow", {{"technique", "rayTraced"}, {"color", {0.6, 0.2, 0.1}}}}}};
  for (const char* const name : {"box_on_plane", "leaves", "lights"}) {
    const ScenePtr scene = testing::generatedScene(name);
    for (const char* const technique : {"rayTraced", "shadowMap"}) {
      for (const char* const mode : {"catcher", "surface"}) {
        for (const char* const antialiasing : {"none", "msaa4x"}) {
          SCOPED_TRACE(std::string(name) + ' ' + technique + ' ' + mode + ' ' + antialiasing);
          const Json spec = {{"width", 200},
                             {"height", 120},
                             {"camera", {{"orbit", {{"azimuthDegrees", 35}, {"elevationDegrees", 35}}}}},
                             {"lights", suns},
                             {"shadow", {{"technique", technique}}},
                             {"ground", {{"mode", mode}}},
                             {"background", {{"color", {0.9, 0.2, 0.1}}, {"alpha", 0.25}}},
                             {"antialiasing", antialiasing},
                             {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
          const std::vector<float> a = pixelsBy(cpu, scene, spec);
          const std::vector<float> b = pixelsBy(gl, scene, spec);
          ASSERT_EQ(a.size(), b.size());
          EXPECT_LE(percentApart(a, b), 1);
          if (std::string(mode) == "catcher") {
            EXPECT_GT(partlyCovered(a), 100u);
          }
        }
      }
    }
  }
}

} // namespace
} // namespace gnomon
