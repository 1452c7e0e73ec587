#include "tests/bench/gathered_scenes.h"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

#include "tests/support/files.h"
#include "tests/support/gathered_model.h"

namespace gnomon::bench {

namespace fs = std::filesystem;

std::vector<NamedScene> gatheredScenes(const fs::path& assets) {
  std::vector<NamedScene> scenes;
  const auto add = [&](const std::string& name, const SceneBundle& bundle) {
    if (auto scene = loadScene(bundle)) scenes.push_back({name, std::move(*scene)});
  };
  if (fs::exists(assets / "manifest.json")) {
    const auto manifest = nlohmann::json::parse(std::ifstream(assets / "manifest.json"));
    for (const auto& model : manifest.at("models")) add(model.at("id"), testing::gatheredBundle(assets, model));
    return scenes;
  }
  for (const auto& entry : fs::directory_iterator(GNOMON_TEST_SCENES)) {
    if (entry.path().extension() == ".glb") add(entry.path().stem(), {testing::readFile(entry.path()), {}});
  }
  return scenes;
}

std::string modelOf(const NamedScene& scene) {
  return scene.name.substr(0, scene.name.find('/'));
}

nlohmann::json sunLight() {
  return {{"type", "directional"}, {"sun", {{"azimuthDegrees", 135}, {"elevationDegrees", 40}}}};
}

nlohmann::json spotOver(const Aabb& bounds) {
  const double size = glm::length(bounds.max - bounds.min);
  const glm::dvec3 middle = bounds.center();
  const glm::dvec3 lamp = glm::dvec3(middle.x, bounds.max.y, middle.z) + glm::dvec3(0.15, 0.35, 0.2) * size;
  const glm::dvec3 down = middle - lamp;
  return {{"type", "spot"},
          {"position", {lamp.x, lamp.y, lamp.z}},
          {"direction", {down.x, down.y, down.z}},
          {"outerConeDegrees", 50},
          {"intensity", 4 * size * size}};
}

void addDevice(CLI::App& app, DeviceChoice& device) {
  static const std::map<std::string, DeviceChoice> devices{
      {"auto", DeviceChoice::auto_}, {"cpu", DeviceChoice::cpu}, {"gl", DeviceChoice::gl}};
  app.add_option("--device", device, "What draws: cpu, gl, or auto as gnomon chooses")
      ->transform(CLI::CheckedTransformer(devices));
}

Renderer rendererOf(DeviceChoice device) {
  auto renderer = Renderer::create({.backend = {.device = device}});
  if (renderer) return *std::move(renderer);
  std::cerr << renderer.problems().front().detail << '\n';
  std::exit(1);
}

} // namespace gnomon::bench
