#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
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

/// The name of the model that a scene is a file of.
std::string modelOf(const NamedScene& scene);

/// A light of a request.
nlohmann::json sunLight();

/// A spot above the middle of a scene, as bright as one of 10 m needs it.
nlohmann::json spotOver(const Aabb& bounds);

/// The option --device.
void addDevice(CLI::App& app, DeviceChoice& device);

/// Ends the program where the device can't be opened.
Renderer rendererOf(DeviceChoice device);

} // namespace gnomon::bench
