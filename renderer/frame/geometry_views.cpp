#include "renderer/frame/geometry_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/device/view_image.h"

namespace gnomon {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Instance& instanceOf(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  return shown.view.instances[triangle.instance];
}

/// The corners of a triangle, relative to the eye.
std::array<glm::dvec3, 3> cornersOf(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  const Instance& instance = instanceOf(shown, triangle);
  const Primitive& primitive = shown.scene.primitives[static_cast<std::size_t>(instance.primitive)];
  std::array<glm::dvec3, 3> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t index = shown.scene.indices[primitive.firstIndex + std::size_t{triangle.triangle} * 3 + i];
    const glm::dvec4 local(glm::dvec3(shown.scene.positions[primitive.baseVertex + index]), 1.0);
    corners[i] = glm::dvec3(instance.worldFromLocal * local) - shown.camera.eye;
  }
  return corners;
}

/// -1 = a surface that has none in the file: it shows the last, which loading adds.
int materialIdOf(const ShownGeometry& shown, const PlacedTriangle& triangle) {
  const int material = materialOf(shown.scene, instanceOf(shown, triangle));
  return material + 1 == static_cast<int>(shown.scene.materials.size()) ? -1 : material;
}

int idOf(const ShownGeometry& shown, View view, const PlacedTriangle& triangle) {
  if (triangle.instance == kNoSurface) return -1;
  if (view == View::materials) return materialIdOf(shown, triangle);
  const Instance& instance = instanceOf(shown, triangle);
  return view == View::ids ? instance.node : instance.copy;
}

/// A hue for each index, far from those of its neighbours: steps of the golden ratio. Black for -1.
glm::vec3 colorOf(int id) {
  if (id < 0) return glm::vec3(0);
  const auto step = [id](double ratio) {
    const double turned = (id + 1) * ratio;
    return static_cast<float>(turned - std::floor(turned));
  };
  const float turn = step(0.6180339887498949);
  const float paleness = 0.55f + 0.4f * step(0.7548776662466927);
  const float brightness = 0.7f + 0.3f * step(0.5698402909980532);
  glm::vec3 color(0);
  for (int i = 0; i < 3; ++i) {
    const float at = turn + static_cast<float>(3 - i) / 3.0f;
    const float full = std::clamp(std::abs((at - std::floor(at)) * 6.0f - 3.0f) - 1.0f, 0.0f, 1.0f);
    color[i] = (1.0f + (full - 1.0f) * paleness) * brightness;
  }
  return color;
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

/// `numbersOf(triangle, place, out)` writes a pixel's channels.
template <class Number, class NumbersOf>
std::vector<Number> pixelsOf(const ShownGeometry& shown, std::size_t channels, const NumbersOf& numbersOf) {
  const auto width = static_cast<std::size_t>(shown.width);
  std::vector<Number> pixels(width * static_cast<std::size_t>(shown.height) * channels);
  forEach(static_cast<std::size_t>(shown.height), [&](std::size_t row) {
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t pixel = row * width + column;
      const glm::dvec2 place(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      numbersOf(shown.triangles[pixel], place, pixels.data() + pixel * channels);
    }
  });
  return pixels;
}

template <class Number>
std::vector<Number> colorsOf(const ShownGeometry& shown, View view) {
  return pixelsOf<Number>(shown, 3, [&](const PlacedTriangle& triangle, glm::dvec2 place, Number* out) {
    const glm::vec3 color = view == View::position ? placeIn(shown.view.bounds, seenPoint(shown, triangle, place))
                                                   : colorOf(idOf(shown, view, triangle));
    for (int i = 0; i < 3; ++i) out[i] = unorm<Number>(color[i]);
  });
}

} // namespace

glm::dvec3 seenPoint(const ShownGeometry& shown, const PlacedTriangle& triangle, glm::dvec2 place) {
  if (triangle.instance == kNoSurface) return glm::dvec3(kInfinity);
  const auto [a, b, c] = cornersOf(shown, triangle);
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const glm::dvec2 ndc(2 * place.x / shown.width - 1, 1 - 2 * place.y / shown.height);
  const glm::dvec3 begin = pointAt(shown.camera, ndc, 0);
  const glm::dvec3 way = pointAt(shown.camera, ndc, 1) - begin;
  const double along = glm::dot(normal, way);
  const glm::dvec3 point = begin + way * (glm::dot(normal, a - begin) / along);
  // Of a triangle that is seen edge-on any point does.
  return glm::all(glm::lessThan(glm::abs(point), glm::dvec3(kInfinity))) ? shown.camera.eye + point
                                                                         : shown.camera.eye + a;
}

Image geometryView(const ShownGeometry& shown, View view, PixelType pixels) {
  Image image{shown.width, shown.height, channelsOf(view, pixels != PixelType::numbers, true), {}};
  if (pixels == PixelType::bytes) {
    image.pixels = colorsOf<std::uint8_t>(shown, view);
  } else if (pixels == PixelType::words) {
    image.pixels = colorsOf<std::uint16_t>(shown, view);
  } else if (view == View::position) {
    image.pixels = pixelsOf<float>(shown, 3, [&](const PlacedTriangle& triangle, glm::dvec2 place, float* out) {
      const glm::dvec3 point = seenPoint(shown, triangle, place);
      for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(point[i]);
    });
  } else {
    image.pixels = pixelsOf<float>(shown, 1, [&](const PlacedTriangle& triangle, glm::dvec2, float* out) {
      *out = static_cast<float>(idOf(shown, view, triangle));
    });
  }
  return image;
}

} // namespace gnomon
