#include "renderer/passes/gpu_scene.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "renderer/device/shader_data.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/scene/shared_content.h"
#include "renderer/scene/texture_reads.h"
#include "renderer/shaders/shared/mask_coverage.h"

namespace gnomon {
namespace {

/// Uploads each image once per color space and each sampler once.
class TextureUpload {
 public:
  TextureUpload(const Scene& scene, GpuTextures& gpu) : scene_(scene), gpu_(gpu) {}

  GpuTexture use(const std::optional<TextureUse>& use, bool srgb) {
    if (!use || use->image < 0) return {};
    return {texture(use->image, srgb), sampler(*use)};
  }

 private:
  int texture(int image, bool srgb) {
    const auto [found, added] = textures_.try_emplace({image, srgb}, static_cast<int>(gpu_.textures.size()));
    if (added) {
      const Image& source = scene_.images[static_cast<std::size_t>(image)]->pixels();
      const int levels = gl::fullLevels(source.width, source.height);
      gl::Texture made({srgb ? static_cast<GLenum>(GL_SRGB8_ALPHA8) : static_cast<GLenum>(GL_RGBA8), source.width,
                        source.height, levels, 0},
                       "scene image");
      made.write(0, {GL_RGBA, GL_UNSIGNED_BYTE},
                 std::as_bytes(std::span(std::get<std::vector<std::uint8_t>>(source.pixels))));
      made.generateLevels();
      gpu_.bytes += static_cast<std::size_t>(source.width) * static_cast<std::size_t>(source.height) * 16 / 3;
      gpu_.textures.push_back(std::move(made));
    }
    return found->second;
  }

  int sampler(const TextureUse& use) {
    const auto key = std::tuple(use.wrapS, use.wrapT, use.nearest, use.minFilter);
    const auto [found, added] = samplers_.try_emplace(key, static_cast<int>(gpu_.samplers.size()));
    if (added) {
      gl::SamplerState state;
      state.minFilter = static_cast<GLenum>(use.minFilter);
      state.magFilter = use.nearest ? GL_NEAREST : GL_LINEAR;
      state.wrapS = static_cast<GLenum>(use.wrapS);
      state.wrapT = static_cast<GLenum>(use.wrapT);
      gpu_.samplers.emplace_back(state, "material");
    }
    return found->second;
  }

  const Scene& scene_;
  GpuTextures& gpu_;
  std::map<std::pair<int, bool>, int> textures_;
  std::map<std::tuple<Wrap, Wrap, bool, MinFilter>, int> samplers_;
};

/// The tables of materials, one behind the other.
class CoverageTables {
 public:
  void add(const MaskCoverage& coverage, shared::MaterialData& material) {
    static_assert(MaskCoverage::kRow == GNOMON_COVERAGE_ROW);
    const auto [found, isNew] = firstRows_.try_emplace(&coverage, numbers_.size() / MaskCoverage::kRow);
    if (isNew) numbers_.insert(numbers_.end(), coverage.table().begin(), coverage.table().end());
    material.coverageRow = static_cast<float>(found->second);
    material.coverageLastRow = static_cast<float>(coverage.rows() - 1);
    material.mixesLevels = coverage.mixesLevels() ? 1.0f : 0.0f;
  }
  const std::vector<float>& numbers() const { return numbers_; }

 private:
  std::map<const MaskCoverage*, std::size_t> firstRows_;
  std::vector<float> numbers_;
};

} // namespace

std::shared_ptr<const GpuTextures> uploadTextures(const Scene& scene) {
  auto gpu = std::make_shared<GpuTextures>();
  gpu->coverages = std::make_shared<KeptCoverages>();
  TextureUpload upload(scene, *gpu);
  for (const Material& material : scene.materials) {
    GpuMaterial made;
    std::size_t unit = 0;
    for (const auto& [use, srgb] : texturesAsRead(material)) made.textures[unit++] = upload.use(*use, srgb);
    gpu->materials.push_back(made);
  }
  return gpu;
}

std::shared_ptr<const GpuMeshes> uploadMeshes(const Scene& scene) {
  auto gpu = std::make_shared<GpuMeshes>();
  gpu->positions = gl::Buffer(gl::bytesOf(*scene.positions), "positions");
  gpu->attributes = gl::Buffer(gl::bytesOf(*scene.attributes), "attributes");
  gpu->indices = gl::Buffer(gl::bytesOf(*scene.indices), "indices");
  gpu->welded = gl::Buffer(gl::bytesOf(*scene.welded), "welded indices");
  gpu->bytes = gpu->positions.bytes() + gpu->attributes.bytes() + gpu->indices.bytes() + gpu->welded.bytes();
  return gpu;
}

GpuScene uploadScene(const Scene& scene, std::shared_ptr<const GpuMeshes> meshes,
                     std::shared_ptr<const GpuTextures> textures) {
  GpuScene gpu;
  for (const SceneView& view : scene.scenes) {
    gpu.anchored.emplace_back(gl::bytesOf(instanceData(frameGeometry(scene, view, anchorOf(view)))),
                              "anchored instances");
    gpu.bytes += gpu.anchored.back().bytes();
  }
  gpu.bytes += meshes->bytes;
  gpu.meshes = std::move(meshes);

  CoverageTables tables;
  std::vector<shared::MaterialData> data;
  const MaskCoverages coverages = textures->coverages->of(scene);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    data.push_back(materialData(scene.materials[i]));
    if (coverages[i] != nullptr) tables.add(*coverages[i], data.back());
  }
  gpu.materialData = gl::Buffer(gl::bytesOf(data), "materials");
  gpu.coverage = gl::Buffer(gl::bytesOf(tables.numbers()), "coverage");
  gpu.bytes += textures->bytes + gpu.coverage.bytes();
  gpu.textures = std::move(textures);
  return gpu;
}

const GpuScene& GpuSceneCache::get(const std::shared_ptr<const Scene>& scene) {
  return entryOf(scene).gpu;
}

const std::vector<EdgeMesh>& GpuSceneCache::edges(const std::shared_ptr<const Scene>& scene) {
  Entry& entry = entryOf(scene);
  if (!entry.edges) {
    const auto same = std::ranges::find_if(
        entries_, [&](const Entry& other) { return other.edges != nullptr && other.gpu.meshes == entry.gpu.meshes; });
    entry.edges =
        same != entries_.end() ? same->edges : std::make_shared<const std::vector<EdgeMesh>>(edgeMeshes(*scene));
    drop();
  }
  return *entry.edges;
}

GpuSceneCache::Entry& GpuSceneCache::entryOf(const std::shared_ptr<const Scene>& scene) {
  if (Entry* const known = entries_.findIf([&](const Entry& entry) { return entry.scene.lock() == scene; })) {
    return *known;
  }
  const auto matching = [&](bool (*same)(const Scene&, const Scene&)) {
    return [&scene, same](const Entry& entry) {
      const auto other = entry.scene.lock();
      return other && same(*other, *scene);
    };
  };
  if (Entry* const like = entries_.findIf(matching(sameSurfaces))) {
    like->scene = scene;
    return *like;
  }
  const auto ofMeshes = std::ranges::find_if(entries_, matching(sameMeshes));
  const auto ofTextures = std::ranges::find_if(entries_, matching(sameTextures));
  auto meshes = ofMeshes != entries_.end() ? ofMeshes->gpu.meshes : uploadMeshes(*scene);
  auto textures = ofTextures != entries_.end() ? ofTextures->gpu.textures : uploadTextures(*scene);
  entries_.eraseIf([](const Entry& entry) { return entry.scene.expired(); });
  Entry& added = entries_.add({scene, uploadScene(*scene, std::move(meshes), std::move(textures)), {}});
  added.gpu.id = ++uploads_;
  drop();
  return added;
}

void GpuSceneCache::drop() {
  entries_.keepWithin(budgetBytes_, [](const Entry& entry) { return entry.bytes(); });
}

} // namespace gnomon
