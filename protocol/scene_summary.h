#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon {

struct CameraSummary {
  int node = 0; ///< index into the file's nodes; usable as camera.node
  std::string name{};
  std::string type{}; ///< "perspective" | "orthographic"
};

struct LightSummary {
  int node = 0;
  std::string name{};
  std::string type{}; ///< "directional" | "spot" | "point"
};

/// What an upload is told about its scene. Counts are of the default glTF scene.
struct SceneSummary {
  std::string id{};              ///< SHA-256 of the bundle, 64 lower-case hexadecimal digits
  std::uint64_t bytes = 0;       ///< of the bundle
  std::uint64_t memoryBytes = 0; ///< of the loaded scene
  int scenes = 0;
  int defaultScene = 0;
  std::uint64_t nodes = 0;
  std::uint64_t meshes = 0;
  std::uint64_t materials = 0;
  std::uint64_t images = 0;
  std::uint64_t triangles = 0;
  std::uint64_t vertices = 0;
  std::uint64_t animations = 0;
  std::array<double, 3> boundsMin{}; ///< metres
  std::array<double, 3> boundsMax{};
  std::vector<CameraSummary> cameras{};
  std::vector<LightSummary> lights{};
  std::vector<std::string> extensionsUsed{};
  std::vector<std::string> warnings{}; ///< what the file holds that is drawn without or drawn differently
};

} // namespace gnomon
