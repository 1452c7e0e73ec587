#include "renderer/scene/graph/cameras.h"

#include <cmath>
#include <numbers>

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

SceneCamera unplacedCamera(const GltfDocument& document, std::size_t node, Findings& findings) {
  const tinygltf::Node& source = document.model.nodes[node];
  const tinygltf::Camera& camera = document.model.cameras[static_cast<std::size_t>(source.camera)];
  SceneCamera made;
  made.node = static_cast<int>(node);
  made.name = keptName(source.name.empty() ? camera.name : source.name, findings);
  if (camera.type == "perspective") {
    Perspective lens;
    lens.fovYDegrees = camera.perspective.yfov * 180.0 / std::numbers::pi;
    lens.near = camera.perspective.znear;
    if (camera.perspective.zfar > 0) lens.far = camera.perspective.zfar;
    made.perspective = lens;
  } else {
    Orthographic lens;
    lens.height = 2.0 * std::abs(camera.orthographic.ymag);
    lens.near = camera.orthographic.znear;
    lens.far = camera.orthographic.zfar;
    made.orthographic = lens;
  }
  return made;
}

std::optional<SceneCamera> placedAt(const glm::dmat4& worldFromUnscaled, SceneCamera camera) {
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame)) return std::nullopt;
  camera.eye = frame.position;
  camera.forward = frame.forward;
  camera.up = frame.up;
  return camera;
}

std::optional<SceneCamera> cameraOf(const GltfDocument& document, const NodeTree& tree, std::size_t node,
                                    Findings& findings) {
  auto camera = placedAt(tree.worldFromUnscaled[node], unplacedCamera(document, node, findings));
  if (!camera) findings.warn("The camera at node " + std::to_string(node) + " is scaled to nothing and left out.");
  return camera;
}

} // namespace gnomon
