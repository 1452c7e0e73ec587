#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "protocol/base/lru.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/texture.h"
#include "renderer/passes/stencil/stencil_outlines.h"
#include "renderer/scene/mask_coverage.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A texture of a material, ready to bind.
struct GpuTexture {
  int texture = -1; ///< index into GpuTextures::textures; -1 = the material has none
  int sampler = -1; ///< index into GpuTextures::samplers
};

/// A material's textures, in the order of their units (GNOMON_BASE_COLOR_UNIT ...).
struct GpuMaterial {
  std::array<GpuTexture, 5> textures;
};

/// What a scene's materials read, on the device.
struct GpuTextures {
  std::vector<GpuMaterial> materials;
  std::vector<gl::Texture> textures;
  std::vector<gl::Sampler> samplers;
  std::shared_ptr<KeptCoverages> coverages; ///< of the same images
  std::size_t bytes = 0;                    ///< of device memory, about
};

/// A scene's triangles, on the device.
struct GpuMeshes {
  gl::Buffer positions;  ///< vec3
  gl::Buffer attributes; ///< VertexAttributes
  gl::Buffer indices;
  gl::Buffer welded;     ///< indices for draws that read positions only
  std::size_t bytes = 0; ///< of device memory
};

/// A scene's geometry and materials on the device. Made once for all scenes with the same surfaces.
struct GpuScene {
  std::uint64_t id = 0;                        ///< of the upload: no two have the same
  std::shared_ptr<const GpuMeshes> meshes;     ///< scenes of the same meshes share them
  gl::Buffer materialData;                     ///< shared::MaterialData
  gl::Buffer coverage;                         ///< float: the tables of MaskCoverage, each once
  std::shared_ptr<const GpuTextures> textures; ///< scenes that read the same images in the same way share them
  std::vector<gl::Buffer> anchored;            ///< shared::InstanceData relative to anchorOf, one a glTF scene
  std::size_t bytes = 0;                       ///< of device memory, about
};

std::shared_ptr<const GpuMeshes> uploadMeshes(const Scene& scene);
std::shared_ptr<const GpuTextures> uploadTextures(const Scene& scene);

/// `meshes` and `textures`: of this scene, or of one where they are the same (shared_content.h).
GpuScene uploadScene(const Scene& scene, std::shared_ptr<const GpuMeshes> meshes,
                     std::shared_ptr<const GpuTextures> textures);

/// Uploaded scenes, those with the same surfaces as one, the least recently used dropped first once they take more than
/// a budget.
class GpuSceneCache {
 public:
  explicit GpuSceneCache(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  /// The scene's upload, made now if need be; valid until the next call. The newest stays, whatever its size.
  const GpuScene& get(const std::shared_ptr<const Scene>& scene);
  /// The edges of its meshes, found now if need be; valid as long.
  const std::vector<EdgeMesh>& edges(const std::shared_ptr<const Scene>& scene);

 private:
  struct Entry {
    std::weak_ptr<const Scene> scene;
    GpuScene gpu;
    std::shared_ptr<const std::vector<EdgeMesh>> edges{};

    std::size_t bytes() const { return gpu.bytes + (edges ? bytesOf(*edges) : 0); }
  };

  Entry& entryOf(const std::shared_ptr<const Scene>& scene);
  void drop();

  std::size_t budgetBytes_;
  std::uint64_t uploads_ = 0;
  LruList<Entry> entries_;
};

} // namespace gnomon
