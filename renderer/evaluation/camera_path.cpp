#include "renderer/evaluation/camera_path.h"

namespace gnomon {

std::vector<Camera> camerasAlong(const CameraPath& path, const Camera& start) {
  if (path.cameras) return *path.cameras;
  constexpr int kUsualFrames = 16;
  std::vector<Camera> cameras(static_cast<std::size_t>(path.frames.value_or(kUsualFrames)), start);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    EyeTarget& place = *cameras[i].lookAt;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = static_cast<double>(i) * (*path.step)[axis]; // not summed up: every step is the same
      place.eye[axis] += moved;
      place.target[axis] += moved;
    }
  }
  return cameras;
}

} // namespace gnomon
