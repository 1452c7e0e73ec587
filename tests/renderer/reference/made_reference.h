#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "renderer/reference/reference.h"

namespace gnomon::testing {

/// A value for each pixel of a picture, rows from the top.
inline std::vector<float> pictureOf(int width, int height, const std::function<float(int, int)>& value) {
  std::vector<float> picture;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.push_back(value(x, y));
  }
  return picture;
}

/// What a camera sees that looks straight down on one level plane, a metre a pixel, every pixel a receiver of one light
/// that sees `visibility`. What hides the light is far away.
inline Reference planeReference(int width, int height, std::vector<float> visibility) {
  Reference truth;
  truth.width = width;
  truth.height = height;
  truth.pixelWidth.assign(visibility.size(), 1.0f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) truth.surface.push_back({glm::dvec3(x, 0, y), glm::vec3(0, 1, 0), 0, 0});
  }
  LightReference light;
  light.receiver.assign(visibility.size(), 1);
  for (const float v : visibility)
    light.blockerDistance.push_back(v >= 0.5f ? std::numeric_limits<float>::infinity() : 100);
  light.visibility = std::move(visibility);
  truth.lights.push_back(std::move(light));
  return truth;
}

/// Lit left of column `edge`.
inline std::vector<float> litLeftOf(int width, int height, int edge) {
  return pictureOf(width, height, [edge](int x, int) { return x < edge ? 1.0f : 0.0f; });
}

} // namespace gnomon::testing
