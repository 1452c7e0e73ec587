#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace gnomon {

struct Scene;
class SceneImage;

/// How often loading found what it needed.
struct ReuseCounts {
  std::uint64_t meshes = 0;
  std::uint64_t images = 0;
};

/// Meshes and images of the scenes that are in memory, by the SHA-256 of what they were made from, so that a file that
/// holds some of them again is loaded without making them anew. It keeps nothing alive. Any thread.
class KnownContent {
 public:
  struct Mesh {
    std::shared_ptr<const Scene> scene;
    int primitive = 0; ///< index into its primitives
  };

  std::optional<Mesh> mesh(const std::string& content);
  std::shared_ptr<const SceneImage> image(const std::string& content); ///< nullptr = not known

  void keepMeshes(const std::shared_ptr<const Scene>& scene); ///< those of its primitives that have a content
  void keepImage(const std::string& content, const std::shared_ptr<const SceneImage>& image);

  ReuseCounts reused() const;

 private:
  struct Kept {
    std::weak_ptr<const Scene> scene;
    int primitive = 0;
  };

  mutable std::mutex mutex_;
  std::map<std::string, Kept> meshes_;
  std::map<std::string, std::weak_ptr<const SceneImage>> images_;
  ReuseCounts reused_;
};

} // namespace gnomon
