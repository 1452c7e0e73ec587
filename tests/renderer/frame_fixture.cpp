#include "tests/renderer/frame_fixture.h"

#include "protocol/json/json_codec.h"
#include "tests/support/files.h"
#include "tests/support/uncached_renderer.h"

namespace gnomon::testing {
namespace {

std::string told(const Problems& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.pointer + ": " + problem.detail + "\n";
  return text;
}

} // namespace

Renderer& sharedRenderer() {
  static Renderer renderer = [] {
    auto made = uncachedRenderer();
    if (!made) throw std::runtime_error(told(made.problems()));
    return std::move(*made);
  }();
  return renderer;
}

bool drawnByGpu() {
  return !sharedRenderer().info().software;
}

const Json& everyFilter() {
  static const Json filters = Json::parse(R"([
      {"type":"hard"},{"type":"pcf","size":3},{"type":"pcf","size":5},{"type":"pcf","size":7},{"type":"pcf","radius":0.1},
      {"type":"vsm","size":3},{"type":"vsm","radius":0.1},{"type":"evsm","size":5},{"type":"evsm","radius":0.1},
      {"type":"msm","size":7},{"type":"msm","radius":0.1},{"type":"pcss"}])");
  return filters;
}

ScenePtr sceneOf(const SceneBundle& bundle) {
  auto scene = loadScene(bundle);
  EXPECT_TRUE(scene) << told(scene.problems());
  return scene ? *scene : nullptr;
}

ScenePtr sceneOf(Bytes glb) {
  return sceneOf(SceneBundle{std::move(glb), {}});
}

ScenePtr sceneOf(const GlbBuilder& builder) {
  return sceneOf(builder.glb());
}

Bytes generatedGlb(const std::string& name) {
  return readFile(std::string(GNOMON_TEST_SCENES "/") + name + ".glb");
}

ScenePtr generatedScene(const std::string& name) {
  return sceneOf(generatedGlb(name));
}

Json withMaps(Json spec) {
  const auto name = [](Json& shadow) {
    if (!shadow.contains("technique")) shadow["technique"] = "shadowMap";
  };
  name(spec["shadow"]);
  if (!spec.contains("lights")) return spec;
  for (Json& light : spec["lights"]) {
    if (light.contains("shadow")) name(light["shadow"]);
  }
  return spec;
}

Frame renderJson(const ScenePtr& scene, const std::string& json) {
  const auto spec = decodeFrameSpec(withMaps(Json::parse(json)).dump());
  EXPECT_TRUE(spec) << told(spec.problems());
  if (!spec) return {};
  auto frame = sharedRenderer().render(scene, *spec);
  EXPECT_TRUE(frame) << told(frame.problems());
  return frame ? std::move(*frame) : Frame{};
}

Problems refusedJson(const ScenePtr& scene, const std::string& json) {
  const auto spec = decodeFrameSpec(json);
  EXPECT_TRUE(spec) << told(spec.problems());
  if (!spec) return {};
  const auto frame = sharedRenderer().render(scene, *spec);
  EXPECT_FALSE(frame) << "was rendered";
  return frame ? Problems{} : frame.problems();
}

const std::vector<float>& floatsOf(const Frame& frame, std::size_t view) {
  return std::get<std::vector<float>>(frame.images.at(view).image.pixels);
}

float valueAt(const Frame& frame, double x, double y, std::size_t view) {
  const Image& image = frame.images.at(view).image;
  const auto column = static_cast<std::size_t>(x * image.width);
  const auto row = static_cast<std::size_t>(y * image.height);
  return floatsOf(frame, view).at((row * static_cast<std::size_t>(image.width) + column) * image.channels.size());
}

} // namespace gnomon::testing
