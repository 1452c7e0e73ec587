#include "protocol/bake/bake_json.h"

#include <nlohmann/json.hpp>

#include "protocol/base/bytes.h"
#include "protocol/fields/field_decode.h"
#include "protocol/fields/field_encode.h"

namespace gnomon {

FrameSpec bakedParts(const FrameSpec& spec) {
  FrameSpec parts;
  parts.lights = spec.lights;
  parts.shadow = spec.shadow;
  parts.shadowLightPolicy = spec.shadowLightPolicy;
  parts.nodes = spec.nodes;
  parts.scene = spec.scene;
  parts.materialVariant = spec.materialVariant;
  parts.animation = spec.animation;
  parts.quality = spec.quality;
  return parts;
}

std::string bakeKey(std::string_view sceneId, const FrameSpec& spec) {
  const std::string text = toJson(bakedParts(spec)).dump(-1, ' ', false, Json::error_handler_t::replace);
  Sha256 hash;
  hash.add(asBytes(sceneId));
  hash.add(asBytes(text));
  return hash.hex();
}

Json toJson(const BakeReport& report) {
  return encodeValue(report);
}
Json toJson(const BakeStep& step) {
  return encodeValue(step);
}

std::optional<BakeReport> readBakeReport(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object() || !document.contains("lights")) return std::nullopt;
  BakeReport report;
  ProblemList unknown;
  decodeValue(nodeOf(document), Notes{}, Place(), unknown, report);
  if (report.lights.empty()) return std::nullopt;
  return report;
}

} // namespace gnomon
