#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/scene.h"

/// Warnings about what a camera does not show although the scene has it. Nothing where a rule does not apply.
namespace gnomon {

/// The visible instances of a scene, and those of them whose boxes reach into the picture.
struct InstancesInView {
  std::size_t visible = 0;
  std::vector<std::uint32_t> instances; ///< indices into SceneView::instances
};
InstancesInView instancesInView(const SceneView& view, const ResolvedFrame& frame);

/// All that is visible lies outside of the frustum.
std::optional<std::string> warningOfNothingInView(const ResolvedFrame& frame, const InstancesInView& inView);

/// A part of a surface lies within the picture's sides and in front of the eye, but nearer than the near plane.
std::optional<std::string> warningOfNearPlane(const Scene& scene, const SceneView& view, const ResolvedFrame& frame);

} // namespace gnomon
