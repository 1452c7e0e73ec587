#include "renderer/scene/texture_images.h"

#include <algorithm>

namespace gnomon {
namespace {

template <class T>
std::vector<T> eachOnce(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
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

} // namespace gnomon
