#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <random>

#include "renderer/cpu/surface/textures.h"

/// Textures as OpenGL 4.5 reads them (section 8.14), a place at a time and in double precision.
namespace gnomon::cpu {

inline double linearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

inline glm::dvec4 texelOf(std::uint32_t bits, bool srgb) {
  glm::dvec4 texel;
  for (int c = 0; c < 4; ++c) {
    const double encoded = (bits >> (8 * c) & 255u) / 255.0;
    texel[c] = srgb && c < 3 ? linearFromSrgb(encoded) : encoded;
  }
  return texel;
}

inline int wrappedTexel(int texel, Wrap wrap, int size) {
  if (wrap == Wrap::repeat) return (texel % size + size) % size;
  if (wrap == Wrap::clampToEdge) return std::clamp(texel, 0, size - 1);
  const int within = (texel % (2 * size) + 2 * size) % (2 * size);
  return within < size ? within : 2 * size - 1 - within;
}

inline glm::dvec4 levelTruth(const TextureLevel& level, bool srgb, const TextureUse& use, bool nearest,
                             const glm::dvec2& uv) {
  const auto at = [&](double x, double y) {
    const int column = wrappedTexel(static_cast<int>(x), use.wrapS, level.width);
    const int row = wrappedTexel(static_cast<int>(y), use.wrapT, level.height);
    return texelOf(level.texels[row * level.width + column], srgb);
  };
  const glm::dvec2 place = uv * glm::dvec2(level.width, level.height) - (nearest ? 0.0 : 0.5);
  const glm::dvec2 first = glm::floor(place);
  if (nearest) return at(first.x, first.y);
  const glm::dvec2 share = place - first;
  return glm::mix(glm::mix(at(first.x, first.y), at(first.x + 1, first.y), share.x),
                  glm::mix(at(first.x, first.y + 1), at(first.x + 1, first.y + 1), share.x), share.y);
}

inline glm::dvec4 sampledTruth(const Pyramid& texture, const TextureUse& use, const glm::dvec2& uv,
                               const glm::dvec2& right, const glm::dvec2& up) {
  const glm::dvec2 size(texture.levels[0].width, texture.levels[0].height);
  const double detail = std::log2(std::max(glm::length(right * size), glm::length(up * size)));
  const auto read = [&](double level, bool nearest) {
    return levelTruth(texture.levels[static_cast<std::size_t>(level)], texture.srgb, use, nearest, uv);
  };
  if (detail <= 0) return read(0, use.nearest);
  const double last = static_cast<double>(texture.levels.size() - 1);
  const double closest = std::clamp(std::ceil(detail - 0.5), 0.0, last);
  const double below = std::min(std::floor(detail), last), above = std::min(below + 1, last);
  switch (use.minFilter) {
    case MinFilter::nearest:
      return read(0, true);
    case MinFilter::linear:
      return read(0, false);
    case MinFilter::nearestMipmapNearest:
      return read(closest, true);
    case MinFilter::linearMipmapNearest:
      return read(closest, false);
    case MinFilter::nearestMipmapLinear:
      return glm::mix(read(below, true), read(above, true), detail - std::floor(detail));
    case MinFilter::linearMipmapLinear:
      break;
  }
  return glm::mix(read(below, false), read(above, false), detail - std::floor(detail));
}

/// Any bytes.
inline std::shared_ptr<const Image> noise(int width, int height) {
  std::mt19937 generator(static_cast<unsigned>(width * 1000 + height));
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(generator());
  return std::make_shared<const Image>(Image{width, height, {"R", "G", "B", "A"}, std::move(bytes)});
}

} // namespace gnomon::cpu
