#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/render.h"

namespace gnomon::bench {

struct NamedScene {
  std::string name;
  ScenePtr scene;
};

/// The models of a folder with a manifest.json that load; where there is none, the project's own scenes.
std::vector<NamedScene> gatheredScenes(const std::filesystem::path& assets);

} // namespace gnomon::bench
