#include "renderer/scene/graph/cameras.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>

#include "renderer/scene/gltf_json.h"
#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

using nlohmann::json;

void checkPerspective(const json& lens, const std::string& pointer, Findings& findings) {
  if (lens["yfov"].get<double>() >= std::numbers::pi) {
    findings.invalid(pointer + "/yfov", "The field of view is not below 180 degrees.");
  }
  const auto far = lens.find("zfar");
  if (far != lens.end() && !(far->get<double>() > lens["znear"].get<double>())) {
    findings.invalid(pointer + "/zfar", "The far plane is not beyond the near plane.");
  }
}

void checkOrthographic(const json& lens, const std::string& pointer, Findings& findings) {
  for (const char* key : {"xmag", "ymag"}) {
    if (lens[key].get<double>() == 0) findings.invalid(pointerTo(pointer, key), "The magnification is zero.");
  }
  if (!(lens["zfar"].get<double>() > lens["znear"].get<double>())) {
    findings.invalid(pointer + "/zfar", "The far plane is not beyond the near plane.");
  }
}

} // namespace

void checkCameras(const json& document, Findings& findings) {
  const auto cameras = document.find("cameras");
  if (cameras == document.end()) return;
  for (std::size_t i = 0; i < cameras->size(); ++i) {
    const json& camera = (*cameras)[i];
    const std::string type = camera["type"].get<std::string>();
    const std::string pointer = pointerTo(pointerTo("/cameras", i), type);
    const auto lens = camera.find(type);
    if (lens == camera.end()) {
      findings.invalid(pointer, "The camera has no lens of its type.");
    } else if (type == "perspective") {
      checkPerspective(*lens, pointer, findings);
    } else {
      checkOrthographic(*lens, pointer, findings);
    }
  }
}

SceneCamera withLens(const json& source, SceneCamera camera) {
  if (source["type"] == "perspective") {
    const json& from = source["perspective"];
    Perspective lens;
    lens.fovYDegrees = from["yfov"].get<double>() * 180.0 / std::numbers::pi;
    lens.near = from["znear"].get<double>();
    if (const auto far = from.find("zfar"); far != from.end()) lens.far = far->get<double>();
    camera.perspective = lens;
  } else {
    const json& from = source["orthographic"];
    Orthographic lens;
    lens.height = 2.0 * std::abs(from["ymag"].get<double>());
    lens.near = from["znear"].get<double>();
    lens.far = from["zfar"].get<double>();
    camera.orthographic = lens;
  }
  return camera;
}

std::optional<FileCamera> cameraAt(const json& document, std::size_t node, Findings& findings) {
  const json& holder = document["nodes"][node];
  const auto index = holder.find("camera");
  if (index == holder.end()) return std::nullopt;
  FileCamera camera{{}, index->get<std::size_t>()};
  const json& source = document["cameras"][camera.source];
  camera.camera.node = static_cast<int>(node);
  camera.camera.name = keptName(nameOf(holder).empty() ? nameOf(source) : nameOf(holder), findings);
  camera.camera = withLens(source, std::move(camera.camera));
  return camera;
}

std::optional<SceneCamera> placedAt(const glm::dmat4& worldFromUnscaled, SceneCamera camera) {
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame)) return std::nullopt;
  camera.eye = frame.position;
  camera.forward = frame.forward;
  camera.up = frame.up;
  return camera;
}

} // namespace gnomon
