#include "renderer/scene/graph/lights.h"

#include <algorithm>
#include <numbers>

#include "renderer/core/vec3.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_lights_punctual";
constexpr double kDefaultOuterCone = std::numbers::pi / 4; // radians, as the extension defines it
constexpr double kWidestConeDegrees = 89.9;                // a cone of 90 has no picture plane

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

void placeCone(const tinygltf::Light& source, Light& light, const std::string& name, Findings& findings) {
  light.innerConeDegrees = degrees(source.spot.innerConeAngle);
  light.outerConeDegrees = degrees(source.spot.outerConeAngle);
  if (light.outerConeDegrees <= kWidestConeDegrees) return;
  light.outerConeDegrees = kWidestConeDegrees;
  light.innerConeDegrees = std::min(light.innerConeDegrees, kWidestConeDegrees - 0.1);
  findings.warn("The " + name + " has a cone of 90 degrees; it is drawn with 89.9.");
}

} // namespace

void checkLights(const json& document, Findings& findings) {
  const auto extensions = document.find("extensions");
  if (extensions == document.end() || !extensions->contains(kExtension)) return;
  const json& lights = (*extensions)[kExtension]["lights"];
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (lights[i]["type"] != "spot") continue;
    const std::string pointer = pointerTo("/extensions/KHR_lights_punctual/lights", i) + "/spot";
    const auto spot = lights[i].find("spot");
    if (spot == lights[i].end()) {
      findings.invalid(pointer, "A spot light needs its cone.");
    } else if (!(spot->value("innerConeAngle", 0.0) < spot->value("outerConeAngle", kDefaultOuterCone))) {
      findings.invalid(pointer + "/innerConeAngle", "The inner cone is not narrower than the outer cone.");
    }
  }
}

std::optional<SceneLight> unplacedLight(const GltfDocument& document, std::size_t node, Findings& findings) {
  const tinygltf::Node& holder = document.model.nodes[node];
  const auto extension = holder.extensions.find(kExtension);
  if (extension == holder.extensions.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(extension->second.Get("light").GetNumberAsInt());
  const tinygltf::Light& source = document.model.lights[index];

  SceneLight made;
  made.node = static_cast<int>(node);
  made.name = keptName(holder.name.empty() ? source.name : holder.name, findings);
  Light& light = made.light;
  light.type = source.type == "point"  ? LightType::point
               : source.type == "spot" ? LightType::spot
                                       : LightType::directional;
  if (light.type != LightType::directional && source.range > 0) light.range = source.range;
  if (light.type == LightType::spot) placeCone(source, light, "light at node " + std::to_string(node), findings);
  light.intensity = source.intensity;
  if (source.color.size() == 3) {
    // Colours beyond 1 become intensity, so that the light stays what it was.
    const double greatest = std::max({1.0, source.color[0], source.color[1], source.color[2]});
    light.color = {source.color[0] / greatest, source.color[1] / greatest, source.color[2] / greatest};
    light.intensity *= greatest;
  }
  return made;
}

std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light) {
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame) && light.light.type != LightType::point) return std::nullopt;
  if (light.light.type != LightType::point) light.light.direction = toTriple(frame.forward);
  if (light.light.type != LightType::directional) light.light.position = toTriple(frame.position);
  return light;
}

std::optional<SceneLight> lightOf(const GltfDocument& document, const NodeTree& tree, std::size_t node,
                                  Findings& findings) {
  auto light = unplacedLight(document, node, findings);
  if (!light) return std::nullopt;
  auto placed = placedAt(tree.worldFromUnscaled[node], *std::move(light));
  if (!placed) findings.warn("The light at node " + std::to_string(node) + " is scaled to nothing and left out.");
  return placed;
}

} // namespace gnomon
