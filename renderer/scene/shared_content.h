#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace gnomon {

struct AccessorView;
struct PrimitiveSource;
struct Scene;
class SceneImage;

/// How often loading found what it needed.
struct ReuseCounts {
  std::uint64_t meshes = 0;
  std::uint64_t images = 0;
};

/// Meshes and images of the scenes in memory by the SHA-256 of their sources, for files that hold them again; weak
/// references. Any thread.
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

// Whether data made of one scene serve another; decided by Primitive::content and shared images.

/// Their vertices, attributes and indices are the same.
bool sameMeshes(const Scene& a, const Scene& b);

/// Each material reads the same images by the same samplers, wherever on them.
bool sameTextures(const Scene& a, const Scene& b);

/// Only cameras, lights, names, animations and volumes may differ: every surface is the same in the same place.
bool sameSurfaces(const Scene& a, const Scene& b);

/// The contents of a file's primitives. An accessor is read once, however many of them use it.
class MeshContents {
 public:
  /// SHA-256 of all that buildVertices() reads; empty where the vertices depend on a pose. The views outlive this.
  std::string of(const PrimitiveSource& source);

 private:
  std::map<const AccessorView*, std::string> accessors_; ///< SHA-256 of those that were read
};

} // namespace gnomon
