#include "renderer/evaluation/world_points.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/linear_algebra.h"
#include "renderer/rays/trace.h"

namespace gnomon {

namespace {

glm::dvec3 fromEye(const TraceInput& input, const SurfacePoint& point) {
  return point.position + (anchorOf(input.traced.view()) - input.camera.eye);
}

/// Where the picture shows a point, pixels from its upper left corner; outside of the picture where it does not.
glm::dvec2 placeOf(const TraceInput& input, const SurfacePoint& point) {
  const CameraView& camera = input.camera;
  const glm::dvec3 relative = fromEye(input, point);
  const double depth = glm::dot(relative, camera.forward);
  if (!(depth > camera.near && depth < camera.far)) return glm::dvec2(-1.0);
  const glm::dvec2 ndc = ndcOf(camera, relative);
  return {0.5 * (1.0 + ndc.x) * input.width, 0.5 * (1.0 - ndc.y) * input.height};
}

/// REQUIRES: the camera is settled on a scene, as resolveCamera leaves it.
void move(Camera& camera, const glm::dvec3& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double metres = by[static_cast<int>(axis)];
    if (camera.pose) {
      camera.pose->worldFromCamera[axis][3] += metres;
    } else {
      camera.lookAt->eye[axis] += metres;
      camera.lookAt->target[axis] += metres;
    }
  }
}

bool isInside(const TraceInput& input, const glm::dvec2& place) {
  return place.x >= 0 && place.y >= 0 && place.x <= input.width && place.y <= input.height;
}

template <class Keep>
std::vector<SurfacePoint> filtered(const std::vector<SurfacePoint>& points, const Keep& keep) {
  std::vector<SurfacePoint> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep(i)) kept.push_back(points[i]);
  }
  return kept;
}

} // namespace

std::vector<SurfacePoint> spreadPoints(const TraceInput& input, int count) {
  const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(1.0 * count * input.width / input.height))));
  const int rows = std::max(1, count / columns);
  std::vector<glm::vec2> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back((column + 0.5) * input.width / columns, (row + 0.5) * input.height / rows);
    }
  }
  std::vector<SurfacePoint> points = firstHits(input, places);
  std::erase_if(points, [](const SurfacePoint& point) { return point.instance == kNoSurface; });
  return points;
}

void keepInSight(const TraceInput& input, std::vector<SurfacePoint>& points) {
  std::erase_if(points, [&](const SurfacePoint& point) { return !isInside(input, placeOf(input, point)); });
  std::vector<glm::vec2> places;
  for (const SurfacePoint& point : points) places.emplace_back(placeOf(input, point));
  const std::vector<SurfacePoint> met = firstHits(input, places);
  points = filtered(points, [&](std::size_t i) {
    return met[i].instance == points[i].instance && met[i].triangle == points[i].triangle;
  });
}

std::vector<SurfacePoint> receiversOf(const TraceInput& input, int light, const std::vector<SurfacePoint>& points) {
  const std::vector<std::uint8_t> reached = facesLight(input, light, points);
  const Light& of = input.lights[static_cast<std::size_t>(light)];
  return filtered(points,
                  [&](std::size_t i) { return reached[i] != 0 && receivesFrom(input, of, points[i].instance); });
}

std::vector<Camera> camerasAlong(const CameraPath& path, const Camera& start) {
  if (path.cameras) return *path.cameras;
  constexpr int kUsualFrames = 16;
  std::vector<Camera> cameras(static_cast<std::size_t>(path.frames.value_or(kUsualFrames)), start);
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    // Not summed up: every step is the same.
    move(cameras[i], toVector(*path.step) * static_cast<double>(i));
  }
  return cameras;
}

} // namespace gnomon
