#include "renderer/scene/graph/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/core/vec3.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

constexpr double kWidestConeDegrees = 89.9; // a cone of 90 has no picture plane

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

} // namespace

void checkLights(const std::vector<gltf::PunctualLight>& lights, Findings& findings) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i].type != LightType::spot) continue;
    const std::string pointer = pointerTo("/extensions/KHR_lights_punctual/lights", i) + "/spot";
    if (!lights[i].spot) {
      findings.invalid(pointer, "A spot light needs the member spot.");
    } else if (!(lights[i].spot->inner < lights[i].spot->outer)) {
      findings.invalid(pointer + "/innerConeAngle", "The inner cone is not narrower than the outer cone.");
    }
  }
}

Light lightFrom(const gltf::PunctualLight& source) {
  Light light;
  light.type = source.type;
  if (light.type != LightType::directional && std::isfinite(source.range)) light.range = source.range;
  if (light.type == LightType::spot) {
    light.innerConeDegrees = degrees(source.spot->inner);
    light.outerConeDegrees = degrees(source.spot->outer);
    if (light.outerConeDegrees > kWidestConeDegrees) {
      light.outerConeDegrees = kWidestConeDegrees;
      light.innerConeDegrees = std::min(light.innerConeDegrees, kWidestConeDegrees - 0.1);
    }
  }
  light.intensity = source.intensity;
  if (source.color) {
    const glm::dvec3& rgb = *source.color;
    // Colours beyond 1 become intensity, so that the light stays what it was.
    const double greatest = std::max({1.0, rgb[0], rgb[1], rgb[2]});
    light.color = {rgb[0] / greatest, rgb[1] / greatest, rgb[2] / greatest};
    light.intensity *= greatest;
  }
  return light;
}

std::optional<FileLight> lightAt(const gltf::Model& model, std::size_t node, Findings& findings) {
  const gltf::Node& holder = model.nodes[node];
  if (holder.light < 0) return std::nullopt;
  FileLight light{{}, static_cast<std::size_t>(holder.light)};
  const gltf::PunctualLight& source = model.lights[light.source];
  light.light.node = static_cast<int>(node);
  light.light.name = keptName(holder.name.empty() ? source.name : holder.name, findings);
  light.light.light = lightFrom(source);
  if (source.type == LightType::spot && degrees(source.spot->outer) > kWidestConeDegrees) {
    findings.warn("The light at node " + std::to_string(node) + " has a cone of 90 degrees; it is drawn with 89.9.");
  }
  return light;
}

std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light) {
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame) && light.light.type != LightType::point) return std::nullopt;
  if (light.light.type != LightType::point) light.light.direction = toTriple(frame.forward);
  if (light.light.type != LightType::directional) light.light.position = toTriple(frame.position);
  return light;
}

} // namespace gnomon
