#include "renderer/shadow/tile_space.h"

#include <algorithm>

namespace gnomon {
namespace {

/// Least and greatest of x / z over a box's x and z, z > 0.
glm::dvec2 quotients(double low, double high, double near, double far) {
  return {low >= 0 ? low / far : low / near, high >= 0 ? high / near : high / far};
}

double depthFar(const Fit& fit) {
  return fit.depthNear + fit.depthExtent;
}

} // namespace

glm::dmat4 clipFromLight(const TileSpace& space) {
  const Fit& fit = space.fit;
  const glm::dvec2 size = fit.texelSize * static_cast<double>(space.size);
  glm::dmat4 clip(0.0);
  clip[0][0] = 2.0 / size.x;
  clip[1][1] = 2.0 / size.y;
  const glm::dvec2 corner = -2.0 * fit.lowest / size - 1.0;
  if (fit.perspective) {
    // z / w = far (depth - near) / (depth (far - near))
    clip[2] = glm::dvec4(corner, depthFar(fit) / fit.depthExtent, 1.0);
    clip[3][2] = -fit.depthNear * depthFar(fit) / fit.depthExtent;
  } else {
    clip[2][2] = 1.0 / fit.depthExtent;
    clip[3] = glm::dvec4(corner, -fit.depthNear / fit.depthExtent, 1.0);
  }
  return clip;
}

Aabb lightSpaceBox(const TileSpace& space, const Aabb& relative) {
  return transformed(lightFromRelative(space.basis, space.origin), relative);
}

Aabb clipBox(const TileSpace& space, const Aabb& boxLs) {
  const Fit& fit = space.fit;
  if (boxLs.empty()) return {};
  const glm::dvec2 size = fit.texelSize * static_cast<double>(space.size);
  const auto onTile = [&](const glm::dvec2& at) { return (at - fit.lowest) * (2.0 / size) - 1.0; };
  if (!fit.perspective) {
    const glm::dvec2 low = onTile(glm::dvec2(boxLs.min));
    const glm::dvec2 high = onTile(glm::dvec2(boxLs.max));
    return {glm::dvec3(low, (boxLs.min.z - fit.depthNear) / fit.depthExtent),
            glm::dvec3(high, (boxLs.max.z - fit.depthNear) / fit.depthExtent)};
  }
  if (boxLs.max.z <= 0) return {};
  // A part of the box behind the light throws no shadow; one beside it reaches as far out as can be told.
  const double near = std::max(boxLs.min.z, 1e-9 * depthFar(fit));
  const double far = std::max(boxLs.max.z, near);
  const glm::dvec2 x = quotients(boxLs.min.x, boxLs.max.x, near, far);
  const glm::dvec2 y = quotients(boxLs.min.y, boxLs.max.y, near, far);
  const auto z = [&](double depth) { return depthFar(fit) * (1.0 - fit.depthNear / depth) / fit.depthExtent; };
  return {glm::dvec3(onTile({x[0], y[0]}), z(near)), glm::dvec3(onTile({x[1], y[1]}), z(far))};
}

} // namespace gnomon
