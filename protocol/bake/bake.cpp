#include "protocol/bake/bake.h"

#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/spec/frame_lights.h"

namespace gnomon {

FrameSpec bakedParts(const FrameSpec& spec) {
  FrameSpec parts;
  parts.lights = spec.lights;
  parts.shadow = spec.shadow;
  parts.shadowLightPolicy = spec.shadowLightPolicy;
  parts.nodes = spec.nodes;
  parts.environment = {.file = spec.environment.file,
                       .sky = spec.environment.sky,
                       .light = spec.environment.light,
                       .rotationDegrees = spec.environment.rotationDegrees,
                       .intensity = spec.environment.intensity,
                       .extractSun = spec.environment.extractSun};
  if (spec.environment.shadows == EnvironmentShadows::rays) {
    parts.environment.shadows = spec.environment.shadows;
    parts.environment.samples = spec.environment.samples;
    if (isStudio(spec.environment)) {
      parts.ambient = spec.ambient;
      parts.environment.studio = spec.environment.studio;
    }
  } else if (isStudio(spec.environment) && spec.environment.studio) {
    parts.environment.studio = Studio::lamps; // named: the sun of the scene's own light does not shine
  }
  parts.scene = spec.scene;
  parts.materialVariant = spec.materialVariant;
  parts.animation = spec.animation;
  parts.quality = spec.quality;
  return parts;
}

std::string bakeKey(std::string_view sceneId, const FrameSpec& spec) {
  const std::string text = jsonText(toJson(bakedParts(spec)));
  Sha256 hash;
  hash.add(asBytes(sceneId));
  hash.add(asBytes(text));
  return hash.hex();
}

std::optional<BakeReport> readBakeReport(std::string_view json) {
  auto report = readReply<BakeReport>(json, {"lights"});
  return report && (!report->lights.empty() || report->environment) ? report : std::nullopt;
}

} // namespace gnomon
