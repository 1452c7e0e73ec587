#include "renderer/frame/caster_view.h"

#include <algorithm>
#include <cmath>

#include "renderer/device/view_image.h"

namespace gnomon {
namespace {

glm::dvec2 centreOf(const ShownGeometry& shown, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(shown.width);
  return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5};
}

/// As common_debug.glsl has it.
float greyOf(const ShownGeometry& shown, std::size_t pixel) {
  const PlacedTriangle& triangle = shown.triangles[pixel];
  const CameraView& camera = shown.camera;
  const auto corners = cornersOf(shown.scene, shown.view.instances[triangle.instance], triangle.triangle, camera.eye);
  const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const glm::dvec3 toEye =
      camera.perspective ? camera.eye - seenPoint(shown, triangle, centreOf(shown, pixel)) : -camera.forward;
  const double lengths = glm::length(area) * glm::length(toEye);
  return 0.25f + 0.35f * static_cast<float>(lengths > 0 ? std::abs(glm::dot(area, toEye)) / lengths : 1);
}

template <class Number>
std::vector<Number> colorsOf(const ShownGeometry& shown, const std::vector<int>& nodes) {
  std::vector<Number> pixels(nodes.size() * 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (shown.triangles[i].instance == kNoSurface) continue;
    const glm::vec3 color = nodes[i] < 0 ? glm::vec3(greyOf(shown, i)) : colorOf(nodes[i]);
    for (int c = 0; c < 3; ++c) pixels[i * 3 + static_cast<std::size_t>(c)] = unorm<Number>(color[c]);
  }
  return pixels;
}

} // namespace

std::vector<int> casterNodes(const ShownGeometry& shown, const TraceInput& rays, int light) {
  std::vector<glm::vec2> places;
  places.reserve(shown.triangles.size());
  for (std::size_t i = 0; i < shown.triangles.size(); ++i) places.emplace_back(centreOf(shown, i));
  const std::vector<std::uint32_t> casters = casterInstances(rays, light, pointsOn(rays, places, shown.triangles));
  std::vector<int> nodes(casters.size());
  std::transform(casters.begin(), casters.end(), nodes.begin(), [&](std::uint32_t instance) {
    return instance == kNoSurface ? -1 : shown.view.instances[instance].node;
  });
  return nodes;
}

Image casterView(const ShownGeometry& shown, const std::vector<int>& nodes, PixelType pixels) {
  const bool colored = pixels != PixelType::numbers;
  Image image{shown.width, shown.height, channelsOf(View::casterIds, colored, true), {}};
  if (pixels == PixelType::bytes) {
    image.pixels = colorsOf<std::uint8_t>(shown, nodes);
  } else if (pixels == PixelType::words) {
    image.pixels = colorsOf<std::uint16_t>(shown, nodes);
  } else {
    image.pixels = std::vector<float>(nodes.begin(), nodes.end());
  }
  return image;
}

} // namespace gnomon
