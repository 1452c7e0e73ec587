#include "renderer/scene/texture_reads.h"

#include <algorithm>
#include <cmath>

namespace gnomon {

namespace {

template <class T>
std::vector<T> eachOnce(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// The texel that texture coordinates outside of the image mean (OpenGL 4.5, table 8.20).
std::size_t wrapped(double texel, int size, Wrap wrap) {
  const double n = size;
  if (texel >= 0 && texel < n) return static_cast<std::size_t>(texel);
  if (wrap == Wrap::repeat) texel -= std::floor(texel / n) * n;
  if (wrap == Wrap::mirroredRepeat) {
    texel -= std::floor(texel / (2 * n)) * (2 * n);
    if (texel >= n) texel = 2 * n - 1 - texel;
  }
  if (!(texel > 0)) return 0; // not a number, too
  return static_cast<std::size_t>(std::min(texel, n - 1));
}

/// Filtered, or the texel that holds the place.
double texelsAt(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv, bool nearest) {
  const auto column = [&](double x) { return wrapped(x, alpha.width(), use.wrapS); };
  const auto row = [&](double y) { return wrapped(y, alpha.height(), use.wrapT); };
  const auto texel = [&](std::size_t x, std::size_t y) { return alpha.at(x, y) / 255.0; };
  const glm::dvec2 place = uv * glm::dvec2(alpha.width(), alpha.height());
  if (nearest) return texel(column(std::floor(place.x)), row(std::floor(place.y)));
  const glm::dvec2 low = glm::floor(place - 0.5);
  const glm::dvec2 share = place - 0.5 - low;
  const std::size_t left = column(low.x), right = column(low.x + 1);
  const std::size_t above = row(low.y), below = row(low.y + 1);
  return glm::mix(glm::mix(texel(left, above), texel(right, above), share.x),
                  glm::mix(texel(left, below), texel(right, below), share.x), share.y);
}

} // namespace

bool readsAlpha(const Material& material) {
  return hasHoles(material) && material.baseColor && material.baseColor->image >= 0;
}

std::vector<int> alphaImages(const Scene& scene, const SceneView& view) {
  std::vector<int> images;
  for (const Instance& instance : view.instances) {
    const Material& material = scene.materials[static_cast<std::size_t>(materialOf(scene, instance))];
    if (readsAlpha(material)) images.push_back(material.baseColor->image);
  }
  return eachOnce(std::move(images));
}

std::vector<TextureImage> textureImages(const Scene& scene, std::span<const int> materials) {
  std::vector<TextureImage> images;
  for (const int index : materials) {
    for (const auto& [use, srgb] : texturesAsRead(scene.materials[static_cast<std::size_t>(index)])) {
      if (*use && (*use)->image >= 0) images.push_back({(*use)->image, srgb});
    }
  }
  return eachOnce(std::move(images));
}

double textureAlpha(const AlphaPlane& alpha, const TextureUse& use, const glm::dvec2& uv) {
  return texelsAt(alpha, use, uv, use.nearest);
}

double halvingsAt(const TexturePlace& place, const glm::ivec2& size) {
  const glm::dvec2 right = place.right * glm::dvec2(size), below = place.below * glm::dvec2(size);
  return 0.5 * std::log2(std::max(glm::dot(right, right), glm::dot(below, below)));
}

double textureAlpha(const AlphaLevels& alpha, const TextureUse& use, const TexturePlace& place) {
  const double wanted = halvingsAt(place, {alpha.largest().width(), alpha.largest().height()});
  if (!(wanted > 0)) return textureAlpha(alpha.largest(), use, place.uv); // not a number, too
  const bool nearest = takesNearestTexel(use.minFilter);
  if (!takesLevels(use.minFilter)) return texelsAt(alpha.largest(), use, place.uv, nearest);
  const double halvings = std::min(wanted, static_cast<double>(alpha.count() - 1));
  const auto level = [&](double number) {
    return texelsAt(alpha.of(static_cast<std::size_t>(number)), use, place.uv, nearest);
  };
  if (!mixesLevels(use.minFilter)) return level(std::ceil(halvings - 0.5));
  const double larger = std::floor(halvings);
  return glm::mix(level(larger), level(std::ceil(halvings)), halvings - larger);
}

} // namespace gnomon
