#include "renderer/scene/graph/attachments.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

#include "protocol/spec/traits.h"
#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/accessor_view.h"
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
    if (!std::isfinite(2.0 * magnification)) {
      findings.invalid(pointerTo(pointer, key), "The picture would be wider than any finite number.");
    }
  }
  if (!(lens.zfar > lens.znear)) {
    findings.invalid(pointer + "/zfar", "The far plane is not beyond the near plane.");
  }
}

constexpr double kConeRounding = 1e-4 * std::numbers::pi / 2; // of the range of a cone's angle, radians
constexpr double kWidestConeDegrees = 89.9;                   // a cone of 90 has no picture plane

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

/// How many times a light's color is beyond 1.
double brightest(const gltf::PunctualLight& light) {
  return light.color ? std::max({1.0, (*light.color)[0], (*light.color)[1], (*light.color)[2]}) : 1.0;
}

void checkCone(gltf::SpotCone& cone, const std::string& pointer, Findings& findings) {
  if (cone.inner < cone.outer) return;
  if (cone.inner - cone.outer > kConeRounding) {
    return findings.invalid(pointer, "The inner cone of a spot light is wider than the outer one.");
  }
  findings.repair({"The inner cone of a spot light is as wide as the outer one", "the edge of its light is sharp"},
                  pointer);
  cone.inner = cone.outer;
}

bool isOfType(const std::string& name, const AccessorView& view) {
  const bool isFloat = view.componentType == ComponentType::float32;
  if (name != "ROTATION") return view.components == 3 && isFloat;
  const bool isShort = view.componentType == ComponentType::int8 || view.componentType == ComponentType::int16;
  return view.components == 4 && (isFloat || (isShort && view.normalized));
}

const AccessorView** memberOf(Instancing& instancing, const std::string& name) {
  if (name == "TRANSLATION") return &instancing.translations;
  if (name == "ROTATION") return &instancing.rotations;
  return name == "SCALE" ? &instancing.scales : nullptr;
}

} // namespace

void checkCameras(std::vector<gltf::Camera>& cameras, Findings& findings) {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    gltf::Camera& camera = cameras[i];
    if (!camera.fault.empty()) continue;
    const std::string pointer = pointerTo("/cameras", i) + (camera.isPerspective ? "/perspective" : "/orthographic");
    Findings found;
    if (camera.isPerspective && camera.perspective) {
      checkPerspective(*camera.perspective, pointer, found);
    } else if (!camera.isPerspective && camera.orthographic) {
      checkOrthographic(*camera.orthographic, pointer, found);
    } else {
      found.invalid(pointer, "The camera has no lens of its type.");
    }
    camera.fault = findings.leaveOut(std::move(found), "the camera is left out");
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
  if (holder.camera < 0 || !model.cameras[static_cast<std::size_t>(holder.camera)].fault.empty()) return std::nullopt;
  FileCamera camera{{}, static_cast<std::size_t>(holder.camera)};
  const gltf::Camera& source = model.cameras[camera.source];
  camera.camera.node = static_cast<int>(node);
  camera.camera.name = keptName(holder.name.empty() ? source.name : holder.name, findings);
  camera.camera = withLens(source, std::move(camera.camera));
  return camera;
}

std::vector<LeftOutCamera> leftOutCameras(const gltf::Model& model) {
  std::vector<LeftOutCamera> cameras;
  for (std::size_t node = 0; node < model.nodes.size(); ++node) {
    const gltf::Node& holder = model.nodes[node];
    if (holder.camera < 0) continue;
    const gltf::Camera& source = model.cameras[static_cast<std::size_t>(holder.camera)];
    if (source.fault.empty()) continue;
    Findings said; // where it is found at fault
    const std::string& name = holder.name.empty() ? source.name : holder.name;
    cameras.push_back({static_cast<int>(node), keptName(name, said), source.fault});
  }
  return cameras;
}

std::optional<SceneCamera> placedAt(const glm::dmat4& worldFromUnscaled, SceneCamera camera) {
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame)) return std::nullopt;
  camera.eye = frame.position;
  camera.forward = frame.forward;
  camera.up = frame.up;
  return camera;
}

void checkLights(std::vector<gltf::PunctualLight>& lights, Findings& findings) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    gltf::PunctualLight& light = lights[i];
    if (!light.fault.empty()) continue;
    const std::string pointer = pointerTo("/extensions/KHR_lights_punctual/lights", i);
    Findings found;
    if (!std::isfinite(light.intensity * brightest(light))) {
      found.invalid(pointer + "/intensity", "Multiplied by the color it is no finite number.");
    }
    if (traitsOf(light.type).hasCone && light.spot) {
      checkCone(*light.spot, pointer + "/spot/innerConeAngle", found);
    } else if (traitsOf(light.type).hasCone) {
      found.invalid(pointer + "/spot", "A spot light needs the member spot.");
    }
    light.fault = findings.leaveOut(std::move(found), "the light is left out");
  }
}

Light lightFrom(const gltf::PunctualLight& source) {
  Light light;
  light.type = source.type;
  if (!traitsOf(light.type).parallel && std::isfinite(source.range)) light.range = source.range;
  if (traitsOf(light.type).hasCone) {
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
    const double greatest = brightest(source);
    light.color = {rgb[0] / greatest, rgb[1] / greatest, rgb[2] / greatest};
    light.intensity *= greatest;
  }
  return light;
}

std::optional<FileLight> lightAt(const gltf::Model& model, std::size_t node, Findings& findings) {
  const gltf::Node& holder = model.nodes[node];
  if (holder.light < 0 || !model.lights[static_cast<std::size_t>(holder.light)].fault.empty()) return std::nullopt;
  FileLight light{{}, static_cast<std::size_t>(holder.light)};
  const gltf::PunctualLight& source = model.lights[light.source];
  light.light.node = static_cast<int>(node);
  light.light.name = keptName(holder.name.empty() ? source.name : holder.name, findings);
  light.light.light = lightFrom(source);
  if (traitsOf(source.type).hasCone && degrees(source.spot->outer) > kWidestConeDegrees) {
    findings.warn("The light at node " + std::to_string(node) + " has a cone of 90 degrees; it is drawn with 89.9.");
  }
  return light;
}

std::optional<SceneLight> placedAt(const glm::dmat4& worldFromUnscaled, SceneLight light) {
  const LightTraits& kind = traitsOf(light.light.type);
  NodeFrame frame;
  if (!frameOf(worldFromUnscaled, frame) && kind.directed) return std::nullopt;
  if (kind.directed) light.light.direction = toTriple(frame.forward);
  if (!kind.parallel) light.light.position = toTriple(frame.position);
  return light;
}

std::optional<glm::dmat4> Instancing::nodeFromCopy(std::size_t copy) const {
  glm::dmat4 matrix(1);
  if (rotations) {
    const glm::dvec4 q = rotations->read(copy);
    const double length = glm::length(q);
    if (!(length > 0)) return std::nullopt;
    matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z) / length);
  }
  if (scales) {
    const glm::dvec3 scale = withThickness(glm::dvec3(scales->read(copy)));
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= scale[axis];
  }
  if (translations) matrix[3] = glm::dvec4(glm::dvec3(translations->read(copy)), 1);
  if (!finite(matrix)) return std::nullopt;
  return matrix;
}

std::optional<Instancing> instancingOf(const LoadContext& load, std::size_t node) {
  Findings& findings = load.findings;
  const auto& attributes = load.document.model.nodes[node].instancing;
  if (!attributes) return std::nullopt;
  const std::string pointer = pointerTo("/nodes", node) + "/extensions/EXT_mesh_gpu_instancing/attributes";
  if (attributes->empty()) {
    findings.repair({"An instancing has no attributes", "its mesh is drawn once"}, pointer);
    return std::nullopt;
  }
  Instancing instancing;
  for (const auto& [name, accessor] : *attributes) {
    const AccessorView& view = load.accessors[static_cast<std::size_t>(accessor)];
    const AccessorView** member = memberOf(instancing, name);
    if (view.faulty || (member && !isOfType(name, view))) {
      findings.repair({"An attribute of instances has an accessor that it can't have", "it is left out"},
                      pointerTo(pointer, name));
      continue;
    }
    if (instancing.count != 0 && view.count != instancing.count) {
      findings.repair({"The attributes of instances differ in their number of elements", "the fewest are drawn"},
                      pointerTo(pointer, name), std::to_string(instancing.count), std::to_string(view.count));
    }
    instancing.count = instancing.count == 0 ? view.count : std::min(instancing.count, std::uint64_t{view.count});
    if (member) *member = &view; // else one of the application's own
  }
  if (instancing.count == 0) return std::nullopt;
  return instancing;
}

} // namespace gnomon
