#include "renderer/scene/graph/lights.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <numbers>

#include "renderer/core/vec3.h"
#include "renderer/scene/gltf_json.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kExtension = "KHR_lights_punctual";
constexpr double kDefaultOuterCone = std::numbers::pi / 4; // radians, as the extension defines it
constexpr double kWidestConeDegrees = 89.9;                // a cone of 90 has no picture plane

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

} // namespace

const json& lightsOf(const json& document) {
  static const json kNone = json::array();
  const json* extension = extensionOf(document, kExtension);
  return extension == nullptr ? kNone : (*extension)["lights"];
}

void checkLights(const json& document, Findings& findings) {
  const json& lights = lightsOf(document);
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

Light lightFrom(const json& source) {
  const std::string type = source["type"].get<std::string>();
  Light light;
  light.type = type == "point" ? LightType::point : type == "spot" ? LightType::spot : LightType::directional;
  const auto range = source.find("range");
  if (light.type != LightType::directional && range != source.end()) light.range = range->get<double>();
  if (light.type == LightType::spot) {
    const json& spot = source["spot"];
    light.innerConeDegrees = degrees(spot.value("innerConeAngle", 0.0));
    light.outerConeDegrees = degrees(spot.value("outerConeAngle", kDefaultOuterCone));
    if (light.outerConeDegrees > kWidestConeDegrees) {
      light.outerConeDegrees = kWidestConeDegrees;
      light.innerConeDegrees = std::min(light.innerConeDegrees, kWidestConeDegrees - 0.1);
    }
  }
  light.intensity = source.value("intensity", 1.0);
  if (const auto color = source.find("color"); color != source.end()) {
    const auto rgb = color->get<std::array<double, 3>>();
    // Colours beyond 1 become intensity, so that the light stays what it was.
    const double greatest = std::max({1.0, rgb[0], rgb[1], rgb[2]});
    light.color = {rgb[0] / greatest, rgb[1] / greatest, rgb[2] / greatest};
    light.intensity *= greatest;
  }
  return light;
}

std::optional<FileLight> lightAt(const json& document, std::size_t node, Findings& findings) {
  const json& holder = document["nodes"][node];
  const json* extension = extensionOf(holder, kExtension);
  if (extension == nullptr) return std::nullopt;
  const auto index = (*extension)["light"].get<std::size_t>();
  const json& source = lightsOf(document)[index];
  FileLight light{{}, index};
  light.light.node = static_cast<int>(node);
  light.light.name = keptName(nameOf(holder).empty() ? nameOf(source) : nameOf(holder), findings);
  light.light.light = lightFrom(source);
  if (light.light.light.type == LightType::spot &&
      degrees(source["spot"].value("outerConeAngle", kDefaultOuterCone)) > kWidestConeDegrees) {
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
