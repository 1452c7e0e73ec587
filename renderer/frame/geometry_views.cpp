#include "renderer/frame/geometry_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "protocol/spec/traits.h"
#include "renderer/core/aabb.h"
#include "renderer/core/parallel.h"
#include "renderer/device/view_image.h"
#include "renderer/frame/motion_view.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Instance& instanceOf(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  return shown.view.instances[triangle.instance];
}

/// -1 = a surface that has none in the file: it shows the last of the file, which loading adds. A ground has the number
/// after the file's own.
int materialIdOf(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  const int added = static_cast<int>(fileMaterials(shown.scene)) - 1;
  const int material = materialOf(shown.scene, instanceOf(shown, triangle));
  return material == added ? -1 : material > added ? added : material;
}

int idOf(const ShownGeometry& shown, View view, const PlacedTriangle& triangle) {
  if (triangle.instance == kNoSurface) return -1;
  if (view == View::materials) return materialIdOf(shown, triangle);
  const Instance& instance = instanceOf(shown, triangle);
  return view == View::ids ? instance.node : instance.copy;
}

/// Of a hue, 0..1 round the circle from red: from white to its full color, and from black.
glm::vec3 colorOfHue(float turn, float saturation, float brightness) {
  glm::vec3 color(0);
  for (int i = 0; i < 3; ++i) {
    const float at = turn + static_cast<float>(3 - i) / 3.0f;
    const float full = std::clamp(std::abs((at - std::floor(at)) * 6.0f - 3.0f) - 1.0f, 0.0f, 1.0f);
    color[i] = (1.0f + (full - 1.0f) * saturation) * brightness;
  }
  return color;
}

/// White for no motion, and the full hue of its direction from `kFarMotion` pixels on: red to the right, then
/// clockwise. Black where there is none.
glm::vec3 colorOfMotion(const glm::dvec2& motion) {
  constexpr double kFarMotion = 16;
  const double length = glm::length(motion);
  if (!std::isfinite(length)) return glm::vec3(0);
  const double turn = std::atan2(motion.y, motion.x) / glm::two_pi<double>();
  return colorOfHue(static_cast<float>(turn), static_cast<float>(std::min(length / kFarMotion, 1.0)), 1);
}

/// 0..1 along each side of the bounds; 0 along one that has no length.
glm::vec3 placeIn(const Aabb& bounds, const glm::dvec3& point) {
  glm::vec3 place(0);
  if (!std::isfinite(point.x)) return place;
  for (int i = 0; i < 3; ++i) {
    const double length = bounds.max[i] - bounds.min[i];
    if (length > 0) place[i] = static_cast<float>((point[i] - bounds.min[i]) / length);
  }
  return place;
}

glm::dvec2 centreOf(const ShownGeometry& shown, std::size_t pixel) {
  const auto width = static_cast<std::size_t>(shown.width);
  return {static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5};
}

/// `numbersOf(pixel, place, out)` writes a pixel's channels.
template <class Number, class NumbersOf>
std::vector<Number> pixelsOf(const ShownGeometry& shown, std::size_t channels, const NumbersOf& numbersOf) {
  const auto width = static_cast<std::size_t>(shown.width);
  std::vector<Number> pixels(width * static_cast<std::size_t>(shown.height) * channels);
  forEach(static_cast<std::size_t>(shown.height), [&](std::size_t row) {
    for (std::size_t pixel = row * width; pixel < (row + 1) * width; ++pixel) {
      numbersOf(pixel, centreOf(shown, pixel), pixels.data() + pixel * channels);
    }
  });
  return pixels;
}

/// `colorAt(pixel, place)`, in 8 or 16 bits a channel.
template <class ColorAt>
void paint(const ShownGeometry& shown, PixelType type, const ColorAt& colorAt, Image& image) {
  const auto colors = [&]<class Number>(Number) {
    image.pixels = pixelsOf<Number>(shown, 3, [&](std::size_t pixel, const glm::dvec2& place, Number* out) {
      const glm::vec3 color = colorAt(pixel, place);
      for (int i = 0; i < 3; ++i) out[i] = unorm<Number>(color[i]);
    });
  };
  type == PixelType::words ? colors(std::uint16_t()) : colors(std::uint8_t());
}

/// Relative to the eye; not finite where the triangle is seen edge-on.
glm::dvec3 onPlane(const ShownGeometry& shown, const std::array<glm::dvec3, 3>& corners, glm::dvec2 place) {
  const auto& [a, b, c] = corners;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const glm::dvec2 ndc(2 * place.x / shown.width - 1, 1 - 2 * place.y / shown.height);
  const glm::dvec3 begin = pointAt(shown.camera, ndc, 0);
  const glm::dvec3 way = pointAt(shown.camera, ndc, 1) - begin;
  return begin + way * (glm::dot(normal, a - begin) / glm::dot(normal, way));
}

std::array<glm::dvec3, 3> shownCorners(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  return cornersOf(shown.scene, instanceOf(shown, triangle), triangle.triangle, shown.camera.eye);
}

/// Where the ray through a place on the picture (pixels, from the upper left corner) meets the plane of a triangle, in
/// the world. Infinite where it does not.
glm::dvec3 seenPoint(const ShownGeometry& shown, const PlacedTriangle& triangle, glm::dvec2 place) {
  if (triangle.instance == kNoSurface) return glm::dvec3(kInfinity);
  const auto corners = shownCorners(shown, triangle);
  const glm::dvec3 point = onPlane(shown, corners, place);
  // Of a triangle that is seen edge-on any point does.
  return shown.camera.eye + (finite(point) ? point : corners[0]);
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

} // namespace

glm::vec3 colorOf(int id) {
  if (id < 0) return glm::vec3(0);
  const auto step = [id](double ratio) {
    const double turned = (id + 1) * ratio;
    return static_cast<float>(turned - std::floor(turned));
  };
  return colorOfHue(step(0.6180339887498949), 0.55f + 0.4f * step(0.7548776662466927),
                    0.7f + 0.3f * step(0.5698402909980532));
}

std::array<glm::dvec3, 3> cornersOf(const Scene& scene, const Instance& instance, std::uint32_t triangle,
                                    const glm::dvec3& eye) {
  const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t index = scene.indices[primitive.firstIndex + std::size_t{triangle} * 3 + i];
    const glm::dvec4 local(glm::dvec3(scene.positions[primitive.baseVertex + index]), 1.0);
    corners[i] = glm::dvec3(instance.worldFromLocal * local) - eye;
  }
  return corners;
}

glm::dvec3 seenWeights(const ShownGeometry& shown, const PlacedTriangle& triangle, glm::dvec2 place) {
  const auto corners = shownCorners(shown, triangle);
  const glm::dvec3 ab = corners[1] - corners[0];
  const glm::dvec3 ac = corners[2] - corners[0];
  const glm::dvec3 ap = onPlane(shown, corners, place) - corners[0];
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double area = glm::dot(normal, normal);
  const double b = glm::dot(normal, glm::cross(ap, ac)) / area;
  const double c = glm::dot(normal, glm::cross(ab, ap)) / area;
  const glm::dvec3 weights(1 - b - c, b, c);
  return finite(weights) ? weights : glm::dvec3(1, 0, 0);
}

Image geometryView(const ShownGeometry& shown, View view, PixelType pixels) {
  Image image{shown.width, shown.height, channelsOf(view, pixels != PixelType::numbers, true), {}};
  if (pixels != PixelType::numbers) {
    const auto colorAt = [&](std::size_t pixel, const glm::dvec2& place) {
      const PlacedTriangle& triangle = shown.triangles[pixel];
      return view == View::position ? placeIn(shown.view.bounds, seenPoint(shown, triangle, place))
             : view == View::motion ? colorOfMotion(motionAt(shown, *shown.earlier, triangle, place))
                                    : colorOf(idOf(shown, view, triangle));
    };
    paint(shown, pixels, colorAt, image);
    return image;
  }
  image.pixels =
      pixelsOf<float>(shown, image.channels.size(), [&](std::size_t pixel, const glm::dvec2& place, float* out) {
        const PlacedTriangle& triangle = shown.triangles[pixel];
        if (view == View::position) {
          const glm::dvec3 point = seenPoint(shown, triangle, place);
          for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(point[i]);
        } else if (view == View::motion) {
          const glm::dvec2 moved = motionAt(shown, *shown.earlier, triangle, place);
          for (int i = 0; i < 2; ++i) out[i] = static_cast<float>(moved[i]);
        } else {
          *out = static_cast<float>(idOf(shown, view, triangle));
        }
      });
  return image;
}

std::vector<SurfacePoint> shownPoints(const ShownGeometry& shown, const TraceInput& rays) {
  std::vector<glm::vec2> places;
  places.reserve(shown.triangles.size());
  for (std::size_t i = 0; i < shown.triangles.size(); ++i) places.emplace_back(centreOf(shown, i));
  return pointsOn(rays, places, shown.triangles);
}

std::vector<int> casterNodes(const ShownGeometry& shown, const TraceInput& rays, int light) {
  const std::vector<std::uint32_t> casters = casterInstances(rays, light, shownPoints(shown, rays));
  std::vector<int> nodes(casters.size());
  std::transform(casters.begin(), casters.end(), nodes.begin(), [&](std::uint32_t instance) {
    return instance == kNoSurface ? -1 : shown.view.instances[instance].node;
  });
  return nodes;
}

Image casterView(const ShownGeometry& shown, const std::vector<int>& nodes, PixelType pixels) {
  Image image{shown.width, shown.height, channelsOf(View::casterIds, pixels != PixelType::numbers, true), {}};
  if (pixels == PixelType::numbers) {
    image.pixels = std::vector<float>(nodes.begin(), nodes.end());
    return image;
  }
  const auto colorAt = [&](std::size_t pixel, const glm::dvec2&) {
    if (shown.triangles[pixel].instance == kNoSurface) return glm::vec3(0);
    return nodes[pixel] < 0 ? glm::vec3(greyOf(shown, pixel)) : colorOf(nodes[pixel]);
  };
  paint(shown, pixels, colorAt, image);
  return image;
}

} // namespace gnomon
