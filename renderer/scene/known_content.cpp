#include "renderer/scene/known_content.h"

#include "renderer/scene/scene.h"

namespace gnomon {

std::optional<KnownContent::Mesh> KnownContent::mesh(const std::string& content) {
  const std::lock_guard lock(mutex_);
  const auto found = meshes_.find(content);
  if (found == meshes_.end()) return std::nullopt;
  auto scene = found->second.scene.lock();
  if (!scene) return std::nullopt;
  ++reused_.meshes;
  return Mesh{std::move(scene), found->second.primitive};
}

std::shared_ptr<const SceneImage> KnownContent::image(const std::string& content) {
  const std::lock_guard lock(mutex_);
  const auto found = images_.find(content);
  auto image = found == images_.end() ? nullptr : found->second.lock();
  if (image) ++reused_.images;
  return image;
}

void KnownContent::keepMeshes(const std::shared_ptr<const Scene>& scene) {
  const std::lock_guard lock(mutex_);
  std::erase_if(meshes_, [](const auto& entry) { return entry.second.scene.expired(); });
  for (std::size_t i = 0; i < scene->primitives.size(); ++i) {
    const std::string& content = scene->primitives[i].content;
    if (!content.empty()) meshes_.insert_or_assign(content, Kept{scene, static_cast<int>(i)});
  }
}

void KnownContent::keepImage(const std::string& content, const std::shared_ptr<const SceneImage>& image) {
  const std::lock_guard lock(mutex_);
  std::erase_if(images_, [](const auto& entry) { return entry.second.expired(); });
  images_.insert_or_assign(content, image);
}

ReuseCounts KnownContent::reused() const {
  const std::lock_guard lock(mutex_);
  return reused_;
}

} // namespace gnomon
