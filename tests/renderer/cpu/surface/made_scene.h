#pragma once

#include <memory>
#include <random>

#include "renderer/core/camera_view.h"
#include "renderer/cpu/frame_scene.h"
#include "tests/renderer/cpu/surface/surface_kernels.h"

namespace gnomon::cpu {

/// Triangles of several instances and materials around a camera, by chance; the same each time.
class MadeScene {
 public:
  explicit MadeScene(bool perspective);

  /// `materials`: what instance i shows; each has a primitive of its own, of two clusters.
  void place(const std::vector<Material>& materials, std::vector<std::shared_ptr<const Image>> images = {});
  const FrameScene& frameScene() const { return *frameScene_; }
  const CameraView& view() const { return frame_.view; }

  /// A point that a triangle shows.
  struct Seen {
    std::uint32_t instance = 0;
    glm::uvec3 vertices{0};     ///< into the scene's
    glm::dvec3 weights{0};      ///< of the corners
    glm::dvec3 corners[3]{};    ///< relative to the eye
    glm::dvec2 place{0};        ///< pixels, from the lower left corner
    std::uint32_t triangle = 0; ///< FrameScene's number

    glm::dvec3 point() const { return corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2]; }
    glm::dvec3 normal() const { return glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0])); }
  };
  /// Points that the picture holds, of triangles that aren't seen edge-on; packets of 16 show from one to 16 triangles.
  std::vector<Seen> seen(std::size_t count);
  FragmentInput fragmentsOf(const std::vector<Seen>& seen) const;
  const Textures& textures() const { return *textures_; }

 private:
  std::optional<Seen> seenAt(std::uint32_t instance, std::uint32_t triangle);

  std::mt19937 generator_{20240607};
  Scene scene_;
  SceneView sceneView_;
  ResolvedFrame frame_;
  FrameGeometry geometry_;
  std::unique_ptr<FrameScene> frameScene_;
  std::unique_ptr<Textures> textures_;
};

} // namespace gnomon::cpu
