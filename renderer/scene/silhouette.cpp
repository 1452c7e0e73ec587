#include "renderer/scene/silhouette.h"

#include <algorithm>

#include "renderer/core/light.h"
#include "renderer/core/vec3.h"

namespace gnomon {
namespace {

constexpr double kRounding = 1e-15;

} // namespace

glm::dvec4 placeOf(const Light& light) {
  if (light.type == LightType::directional) return {-directionOf(light), 0.0};
  return {toVector(*light.position), 1.0};
}

std::vector<std::int8_t> facings(const Scene& scene, const Primitive& primitive, const glm::dmat4& worldFromLocal,
                                 const glm::dvec4& light) {
  // The primitive turned and scaled but not moved, so that a place far from the origin costs no digits.
  const glm::dmat3 linear(worldFromLocal);
  std::vector<glm::dvec3> turned(primitive.vertexCount);
  const auto positions = scene.positions.begin() + static_cast<std::ptrdiff_t>(primitive.baseVertex);
  std::transform(positions, positions + static_cast<std::ptrdiff_t>(primitive.vertexCount), turned.begin(),
                 [&](const glm::vec3& position) { return linear * glm::dvec3(position); });
  const glm::dvec3 towards = glm::dvec3(light) - light.w * glm::dvec3(worldFromLocal[3]);
  const double edgeOn = light.w == 0 ? 1e-12 : 1e-6;

  std::vector<std::int8_t> signs(primitive.indexCount / 3);
  for (std::size_t t = 0; t < signs.size(); ++t) {
    const std::uint32_t* corners = &scene.welded[primitive.firstIndex + 3 * t];
    const glm::dvec3& origin = turned[corners[0]];
    const glm::dvec3 first = turned[corners[1]] - origin;
    const glm::dvec3 second = turned[corners[2]] - origin;
    const glm::dvec3 normal = glm::cross(first, second);
    const glm::dvec3 toLight = towards - light.w * origin;
    const double height = glm::dot(normal, toLight);
    // A corner is off by a rounding of its distance from the primitive's origin, the normal by as much times the sides.
    const double sides = glm::length(first) + glm::length(second);
    const double noise = kRounding * sides * (glm::length(origin) + sides);
    const double least = (edgeOn * glm::length(normal) + noise) * glm::length(toLight);
    signs[t] = static_cast<std::int8_t>(height > least ? 1 : height < -least ? -1 : 0);
  }
  return signs;
}

std::vector<SilhouetteEdge> silhouette(std::span<const MeshEdge> edges, std::span<const std::int8_t> turns) {
  std::vector<SilhouetteEdge> outline;
  for (const MeshEdge& edge : edges) {
    const int times = turns[edge.left] - (edge.right == kNoTriangle ? 0 : turns[edge.right]);
    for (int i = 0; i < times; ++i) outline.push_back({edge.from, edge.to});
    for (int i = 0; i > times; --i) outline.push_back({edge.to, edge.from});
  }
  return outline;
}

} // namespace gnomon
