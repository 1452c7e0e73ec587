#include "renderer/scene/graph/instancing.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "renderer/core/aabb.h"

namespace gnomon {

namespace {

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

std::optional<glm::dmat4> Instancing::nodeFromCopy(std::size_t copy) const {
  glm::dmat4 matrix(1);
  if (rotations) {
    const glm::dvec4 q = rotations->read(copy);
    const double length = glm::length(q);
    if (!(length > 0)) return std::nullopt;
    matrix = glm::mat4_cast(glm::dquat(q.w, q.x, q.y, q.z) / length);
  }
  if (scales) {
    const glm::dvec4 scale = scales->read(copy);
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
    findings.invalid(pointer, "The instancing has no attributes.");
    return std::nullopt;
  }
  Instancing instancing;
  for (const auto& [name, accessor] : *attributes) {
    const AccessorView& view = load.accessors[static_cast<std::size_t>(accessor)];
    if (instancing.count != 0 && view.count != instancing.count) {
      findings.invalid(pointerTo(pointer, name), "The accessor's count differs from that of the other attributes.",
                       std::to_string(instancing.count), std::to_string(view.count));
      return std::nullopt;
    }
    instancing.count = view.count;
    const AccessorView** member = memberOf(instancing, name);
    if (!member) continue; // an attribute of the application's own
    if (!isOfType(name, view)) {
      findings.invalid(pointerTo(pointer, name), "The accessor's type is not valid for " + name + ".");
      return std::nullopt;
    }
    *member = &view;
  }
  return instancing;
}

} // namespace gnomon
