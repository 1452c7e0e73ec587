#include "tests/bench/gathered_scenes.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/files.h"

namespace gnomon::bench {

namespace fs = std::filesystem;

namespace {

SceneBundle bundleOf(const fs::path& assets, const nlohmann::json& model) {
  const fs::path path = assets / model.at("path").get<std::string>();
  SceneBundle bundle{testing::readFile(path), {}};
  for (const auto& file : model.at("files")) {
    const fs::path other = assets / file.get<std::string>();
    if (other == path) continue;
    bundle.files[other.lexically_relative(path.parent_path()).generic_string()] = testing::readFile(other);
  }
  return bundle;
}

} // namespace

std::vector<NamedScene> gatheredScenes(const fs::path& assets) {
  std::vector<NamedScene> scenes;
  const auto add = [&](const std::string& name, const SceneBundle& bundle) {
    if (auto scene = loadScene(bundle)) scenes.push_back({name, std::move(*scene)});
  };
  if (fs::exists(assets / "manifest.json")) {
    const auto manifest = nlohmann::json::parse(std::ifstream(assets / "manifest.json"));
    for (const auto& model : manifest.at("models")) add(model.at("id"), bundleOf(assets, model));
    return scenes;
  }
  for (const auto& entry : fs::directory_iterator(GNOMON_TEST_SCENES)) {
    if (entry.path().extension() == ".glb") add(entry.path().stem(), {testing::readFile(entry.path()), {}});
  }
  return scenes;
}

} // namespace gnomon::bench
