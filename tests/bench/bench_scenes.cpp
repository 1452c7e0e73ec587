#include "tests/bench/bench_scenes.h"

#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <stdexcept>

namespace gnomon::bench {
namespace {

using nlohmann::json;

constexpr int kSunFrames = 20;

glm::dvec3 pointOf(const json& values) {
  return {values.at(0), values.at(1), values.at(2)};
}

json jsonOf(const glm::dvec3& point) {
  return {point.x, point.y, point.z};
}

} // namespace

BenchScene orbitScene(const std::filesystem::path& description) {
  std::ifstream file(description);
  const json about = json::parse(file, nullptr, false);
  if (about.is_discarded()) throw std::runtime_error(description.string() + " is no JSON");
  const json& camera = about.at("camera");
  const glm::dvec3 target = pointOf(camera.at("target"));
  const glm::dvec3 up = pointOf(camera.at("up"));
  BenchScene scene{about.at("name"), description.parent_path() / about.at("glb").get<std::string>(), {}};
  for (int frame = 0; frame < about.at("orbit_frames"); ++frame) {
    const double turn = glm::radians(frame * about.at("orbit_step_deg").get<double>());
    const glm::dmat3 turned(glm::rotate(glm::dmat4(1), turn, up));
    scene.path.push_back(
        {{"camera",
          {{"eye", jsonOf(target + turned * (pointOf(camera.at("eye")) - target))},
           {"target", camera.at("target")},
           {"up", camera.at("up")},
           {"perspective",
            {{"fovYDegrees", camera.at("fovy_deg")}, {"near", camera.at("near")}, {"far", camera.at("far")}}}}},
         {"lights",
          {{{"type", "directional"}, {"direction", jsonOf(-pointOf(about.at("sun").at("direction_to_light")))}}}}});
  }
  return scene;
}

BenchScene sunPathScene(const std::string& name, const std::filesystem::path& file, const std::string& camera,
                        double azimuthDegrees, double elevationDegrees) {
  BenchScene scene{name, file, {}};
  for (int frame = 0; frame < kSunFrames; ++frame) {
    scene.path.push_back(
        {{"camera", {{"node", camera}}},
         {"lights",
          {{{"type", "directional"},
            {"sun", {{"azimuthDegrees", azimuthDegrees + 0.05 * frame}, {"elevationDegrees", elevationDegrees}}}}}}});
  }
  return scene;
}

} // namespace gnomon::bench
