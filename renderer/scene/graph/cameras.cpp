#include "renderer/scene/graph/cameras.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "renderer/scene/graph/node_tree.h"

namespace gnomon {

namespace {

void checkPerspective(const gltf::PerspectiveLens& lens, const std::string& pointer, Findings& findings) {
  if (lens.yfov >= std::numbers::pi) {
    findings.invalid(pointer + "/yfov", "The field of view is not below 180 degrees.");
  }
  if (!(lens.zfar > lens.znear)) {
    findings.invalid(pointer + "/zfar", "The far plane is not beyond the near plane.");
  }
}

void checkOrthographic(const gltf::OrthographicLens& lens, const std::string& pointer, Findings& findings) {
  for (const auto& [key, magnification] : {std::pair("xmag", lens.xmag), std::pair("ymag", lens.ymag)}) {
    if (magnification == 0) findings.invalid(pointerTo(pointer, key), "The magnification is zero.");
  }
  if (!(lens.zfar > lens.znear)) {
    findings.invalid(pointer + "/zfar", "The far plane is not beyond the near plane.");
  }
}

} // namespace

void checkCameras(const std::vector<gltf::Camera>& cameras, Findings& findings) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const gltf::Camera& camera = cameras[i];
    const std::string pointer = pointerTo("/cameras", i) + (camera.isPerspective ? "/perspective" : "/orthographic");
    if (camera.isPerspective && camera.perspective) {
      checkPerspective(*camera.perspective, pointer, findings);
    } else if (!camera.isPerspective && camera.orthographic) {
      checkOrthographic(*camera.orthographic, pointer, findings);
    } else {
      findings.invalid(pointer, "The camera has no lens of its type.");
    }
  }
}

SceneCamera withLens(const gltf::Camera& source, SceneCamera camera) {
  if (source.isPerspective) {
    Perspective lens;
    lens.fovYDegrees = source.perspective->yfov * 180.0 / std::numbers::pi;
    lens.near = source.perspective->znear;
    if (std::isfinite(source.perspective->zfar)) lens.far = source.perspective->zfar;
    camera.perspective = lens;
  } else {
    Orthographic lens;
    lens.height = 2.0 * std::abs(source.orthographic->ymag);
    lens.near = source.orthographic->znear;
    lens.far = source.orthographic->zfar;
    camera.orthographic = lens;
  }
  return camera;
}

std::optional<FileCamera> cameraAt(const gltf::Model& model, std::size_t node, Findings& findings) {
  const gltf::Node& holder = model.nodes[node];
  if (holder.camera < 0) return std::nullopt;
  FileCamera camera{{}, static_cast<std::size_t>(holder.camera)};
  const gltf::Camera& source = model.cameras[camera.source];
  camera.camera.node = static_cast<int>(node);
  camera.camera.name = keptName(holder.name.empty() ? source.name : holder.name, findings);
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
