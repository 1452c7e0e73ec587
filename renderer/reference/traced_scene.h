#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// One of a scene's glTF scenes, its triangles placed relative to anchorOf(view) and sorted for rays (Embree).
/// Immutable, but for what is kept of lights that are asked about again (KeptFronts); any thread. Keeps the scene
/// alive.
class TracedScene {
 public:
  /// `scene`: index into Scene::scenes. A problem where memory runs out.
  static Result<TracedScene> build(std::shared_ptr<const Scene> scene, int index);
  TracedScene(TracedScene&&) noexcept;
  TracedScene& operator=(TracedScene&&) noexcept;
  ~TracedScene();

  const Scene& scene() const;
  const SceneView& view() const;
  std::size_t bytes() const; ///< of the tree, the placed triangles, their masks, and the most of what is kept

  struct Tree; ///< Embree's side, for the files of this folder
  const Tree& tree() const { return *tree_; }

 private:
  explicit TracedScene(std::unique_ptr<const Tree> tree);
  std::unique_ptr<const Tree> tree_;
};

} // namespace gnomon
