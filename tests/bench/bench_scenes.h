#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace gnomon::bench {

/// A scene and what is seen of it, frame after frame.
struct BenchScene {
  std::string name;
  std::filesystem::path file;       ///< .glb
  std::vector<nlohmann::json> path; ///< specs with camera and sun alone, no two of them the same
};

/// From a description: {"name", "glb": a file beside it, "camera": {"eye", "target", "up", "fovy_deg", "near", "far"},
/// "sun": {"direction_to_light"}, "orbit_frames", "orbit_step_deg"}. The eye turns about the target's `up`.
BenchScene orbitScene(const std::filesystem::path& description);

/// Through a camera of the scene; the sun goes on by a twentieth of a degree with every frame.
BenchScene sunPathScene(const std::string& name, const std::filesystem::path& file, const std::string& camera,
                        double azimuthDegrees, double elevationDegrees);

/// A court between two storeys of arcades, with curtains and plants: 270,000 triangles without instances, and 69
/// textures of 1024 x 1024. The eye goes along it. Writes the file, hall.glb, into a folder that is there.
BenchScene hallScene(const std::filesystem::path& folder);

} // namespace gnomon::bench
