#include "renderer/passes/frame_data.h"

#include <cmath>

#include "renderer/core/vec3.h"

namespace gnomon {

shared::FrameData frameData(const ResolvedFrame& frame) {
  const CameraView& view = frame.view;
  const Vec3& ambient = frame.spec.ambient.color;
  const double intensity = frame.spec.ambient.intensity;
  shared::FrameData data{};
  data.clipFromRelative = glm::mat4(clipFromView(view) * viewFromRelative(view));
  const glm::dmat4 clip = clipFromView(view);
  const Background& background = frame.spec.background;
  data.forward = glm::vec4(view.forward, view.perspective ? 1.0 : 0.0);
  data.right = glm::vec4(view.right * view.halfSize.x, 0.0);
  data.up = glm::vec4(view.up * view.halfSize.y, 2.0 * view.halfSize.y / frame.spec.height);
  data.lens = glm::vec4(clip[2][2], clip[3][2], 2.0 / frame.spec.width, 2.0 / frame.spec.height);
  data.background = glm::vec4(toVector(background.color), background.alpha);
  data.ambient = glm::vec4(ambient[0] * intensity, ambient[1] * intensity, ambient[2] * intensity, 0.0);
  data.depthRange = glm::vec4(0, 0, std::exp2(frame.spec.exposure), 0);
  return data;
}

} // namespace gnomon
