#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "protocol/base/bytes.h"
#include "renderer/environment/environment_map.h"

namespace gnomon::testing {

/// A .hdr file, twice as wide as `height`, of the radiance that comes from each direction, to within 1/256 of its
/// greatest component.
inline Bytes hdrFile(int height, const std::function<glm::dvec3(const glm::dvec3& towards)>& radiance) {
  const int width = 2 * height;
  std::string file =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 color = radiance(environmentDirection({(x + 0.5) / width, (y + 0.5) / height}));
      int exponent = 0;
      std::frexp(std::max({color.x, color.y, color.z}), &exponent);
      const double scale = std::ldexp(256, -exponent);
      for (int c = 0; c < 3; ++c) file += static_cast<char>(std::min(255, static_cast<int>(color[c] * scale)));
      file += static_cast<char>(exponent + 128);
    }
  }
  return Bytes(file.begin(), file.end());
}

} // namespace gnomon::testing
