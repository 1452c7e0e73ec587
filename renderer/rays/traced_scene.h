#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The vectors that rays are traced with. Rays that graze an edge are met or missed by one or the other.
enum class RayVectors { widest, avx2, sse4 };

/// For trees that are built from now on, in the whole process. Any thread. Wider ones than the processor knows: as
/// `widest`, which is what all begin with.
void useRayVectors(RayVectors vectors);

/// Embree's configuration for them (rtcNewDevice).
const char* rayDeviceOptions();

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
