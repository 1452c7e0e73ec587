#include "tests/bench/gathered_scenes.h"

#include <fstream>
#include <nlohmann/json.hpp>

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

} // namespace gnomon::bench
