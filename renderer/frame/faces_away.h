#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

#include "renderer/core/camera_view.h"
#include "renderer/scene/scene.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// Which side of an instance's triangles a camera sees, by the winding of their corners, which are relative to the eye.
/// A triangle without an area shows neither side.
class FacesOf {
 public:
  FacesOf(const CameraView& camera, const Instance& instance);

  bool front(const std::array<glm::dvec3, 3>& corners) const { return side(corners) > 0; }
  bool back(const std::array<glm::dvec3, 3>& corners) const { return side(corners) < 0; }

 private:
  double side(const std::array<glm::dvec3, 3>& corners) const;

  const CameraView& camera_;
  bool mirrored_;
};

/// The warning about single-sided surfaces of which every triangle shows the camera its back, where the picture would
/// show them. `seen`: of all surfaces; `inView`: indices of instances. Nothing where there are none.
std::optional<std::string> warningOfFacesAway(const Scene& scene, const SceneView& view, const CameraView& camera,
                                              const ReceiverDepths& seen, std::span<const std::uint32_t> inView);

} // namespace gnomon
