#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/core/srgb.h"
#include "renderer/image/picture_encode.h"
#include "tests/support/glb_builder.h"

/// Image-based lights as a glTF holds them (EXT_lights_image_based).
namespace gnomon::testing {

using Radiance = std::function<glm::dvec3(const glm::dvec3& towards)>;

/// The direction, in the glTF, of a place of a face of OpenGL's cube maps, -1..1 (OpenGL 4.6, table 8.19), where the
/// cube's +Z is the glTF's -Z.
inline glm::dvec3 towardsFace(std::size_t face, double s, double t) {
  const std::array<glm::dvec3, 6> ways{{{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}}};
  const glm::dvec3& way = ways[face];
  return glm::normalize(glm::dvec3(way.x, way.y, -way.z));
}

/// RGBD: a color as sRGB, made as bright as bytes hold, and by how much in alpha.
inline std::array<std::uint8_t, 4> rgbdOf(const glm::dvec3& color) {
  const double most = std::max({color.x, color.y, color.z, 1e-9});
  const double share = std::clamp(std::floor(255 / most), 1.0, 255.0);
  const auto byte = [&](double c) {
    return static_cast<std::uint8_t>(std::lround(255 * srgbOf(static_cast<float>(std::min(1.0, c * share / 255)))));
  };
  return {byte(color.x), byte(color.y), byte(color.z), static_cast<std::uint8_t>(share)};
}

/// A PNG of RGBA texels, row by row.
inline Bytes pngOfTexels(int width, int height, const std::vector<std::array<std::uint8_t, 4>>& texels) {
  std::vector<std::uint8_t> bytes;
  for (const auto& texel : texels) bytes.insert(bytes.end(), texel.begin(), texel.end());
  return *encodePng(Image{width, height, {"R", "G", "B", "A"}, std::move(bytes)}, 1);
}

/// One face, the lowest row of OpenGL's first.
inline Bytes rgbdFace(std::size_t face, int side, const Radiance& radiance) {
  std::vector<std::array<std::uint8_t, 4>> texels;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double s = (2.0 * column + 1) / side - 1, t = 1 - (2.0 * row + 1) / side;
      texels.push_back(rgbdOf(radiance(towardsFace(face, s, t))));
    }
  }
  return pngOfTexels(side, side, texels);
}

/// The irradianceCoefficients of radiance `mean` + `slope` * direction, in all colors: pi and 2/3 pi times them, as
/// spherical harmonics.
inline nlohmann::json coefficientsOf(double mean, const glm::dvec3& slope) {
  constexpr double kPi = std::numbers::pi;
  const double first = 2 * kPi / 3 / std::sqrt(3 / (4 * kPi));
  nlohmann::json all = nlohmann::json::array();
  for (const double number :
       {kPi * mean * std::sqrt(4 * kPi), first * slope.y, -first * slope.z, first * slope.x, 0.0, 0.0, 0.0, 0.0, 0.0}) {
    all.push_back({number, number, number});
  }
  return all;
}

/// Adds a light of one level to the file; gives its index.
inline int addImageBasedLight(GlbBuilder& builder, int side, const Radiance& radiance,
                              const nlohmann::json& coefficients) {
  nlohmann::json faces = nlohmann::json::array();
  for (std::size_t face = 0; face < 6; ++face) {
    const int view = builder.addView(rgbdFace(face, side, radiance));
    faces.push_back(builder.add("images", {{"bufferView", view}, {"mimeType", "image/png"}}));
  }
  nlohmann::json& lights = builder.json["extensions"]["EXT_lights_image_based"]["lights"];
  lights.push_back(
      {{"irradianceCoefficients", coefficients}, {"specularImageSize", side}, {"specularImages", {faces}}});
  return static_cast<int>(lights.size()) - 1;
}

/// That light lights scene 0.
inline void lightScene(GlbBuilder& builder, int light) {
  builder.json["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = light;
}

} // namespace gnomon::testing
