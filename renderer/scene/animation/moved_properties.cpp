#include "renderer/scene/animation/moved_properties.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "renderer/scene/animation/sampling.h"
#include "renderer/scene/gltf_json.h"

namespace gnomon {

namespace {

using nlohmann::json;

constexpr const char* kLights = "KHR_lights_punctual";

Problem disallowed(const std::string& pointer, double timeSeconds, const std::string& detail) {
  return {ProblemCode::invalidValue, "/animation",
          "At this time the animation gives " + inQuotes(pointer) + " a value that glTF does not allow. " + detail, "",
          std::to_string(timeSeconds) + " seconds"};
}

} // namespace

json propertiesOf(const json& document) {
  json properties = json::object();
  for (const char* key : {"materials", "cameras"}) {
    if (const auto member = document.find(key); member != document.end()) properties[key] = *member;
  }
  if (const json* lights = extensionOf(document, kLights)) properties["extensions"][kLights] = *lights;
  return properties;
}

Result<json> movedProperties(const json& rest, const Animation& animation, double timeSeconds) {
  json moved = rest;
  std::vector<double> value;
  for (const PropertyChannel& channel : animation.properties) {
    const PropertyTarget& target = channel.target;
    value.resize(target.components);
    sample(animation.samplers[channel.sampler], timeSeconds, value);
    for (double& number : value) {
      number = std::clamp(number, target.min, target.max);
      if (target.minExcluded && number <= target.min) return disallowed(target.pointer, timeSeconds, "");
    }
    json& member = moved[json::json_pointer(target.pointer)];
    if (target.isArray) {
      member = value;
    } else {
      member = value[0];
    }
  }
  Findings findings;
  checkCameras(moved, findings);
  checkLights(moved, findings);
  if (findings.refused()) {
    const Problem broken = findings.takeProblems().front();
    return disallowed(broken.pointer, timeSeconds, broken.detail);
  }
  return moved;
}

} // namespace gnomon
