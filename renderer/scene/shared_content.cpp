#include "renderer/scene/shared_content.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "protocol/base/bytes.h"
#include "renderer/scene/geometry/mesh_source.h"
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

namespace {

bool sameMesh(const Primitive& a, const Primitive& b) {
  return !a.content.empty() && a.content == b.content && a.baseVertex == b.baseVertex && a.firstIndex == b.firstIndex &&
         a.firstCluster == b.firstCluster;
}

bool samePrimitive(const Primitive& a, const Primitive& b) {
  return a.material == b.material && a.variantMaterials == b.variantMaterials;
}

bool sameInstances(const SceneView& a, const SceneView& b) {
  return std::ranges::equal(a.instances, b.instances, [](const Instance& one, const Instance& other) {
    return one.node == other.node && one.primitive == other.primitive && one.material == other.material &&
           one.copy == other.copy && one.worldFromLocal == other.worldFromLocal;
  });
}

/// Coordinates are no part of what is uploaded.
bool sameSampling(const std::optional<TextureUse>* a, const std::optional<TextureUse>* b) {
  if (!*a || !*b) return a->has_value() == b->has_value();
  const TextureUse& one = **a;
  const TextureUse& other = **b;
  return one.image == other.image && one.wrapS == other.wrapS && one.wrapT == other.wrapT &&
         one.nearest == other.nearest && one.minFilter == other.minFilter;
}

bool sameTexturesOf(const Material& a, const Material& b) {
  return a.specularGlossiness.has_value() == b.specularGlossiness.has_value() &&
         std::ranges::equal(texturesOf(a), texturesOf(b), sameSampling);
}

void addNumber(Sha256& hash, std::uint64_t number) {
  std::array<std::uint8_t, 8> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(number >> (8 * i));
  hash.add(bytes);
}

std::string hashOf(const AccessorView& view) {
  Sha256 hash;
  const std::size_t elementBytes = static_cast<std::size_t>(view.components) * bytesOf(view.componentType);
  for (const std::uint64_t number :
       {std::uint64_t{view.count}, static_cast<std::uint64_t>(view.components),
        static_cast<std::uint64_t>(view.componentType), std::uint64_t{view.normalized ? 1u : 0u},
        std::uint64_t{view.data == nullptr ? 0 : view.stride}, std::uint64_t{view.sparseCount}}) {
    addNumber(hash, number);
  }
  if (view.data != nullptr && view.count > 0) {
    hash.add(std::span(view.data, view.stride * (view.count - 1) + elementBytes));
  }
  if (view.sparseCount > 0) {
    addNumber(hash, static_cast<std::uint64_t>(view.sparseIndexType));
    addNumber(hash, view.sparseStride);
    hash.add(std::span(view.sparseIndices, view.sparseCount * bytesOf(view.sparseIndexType)));
    hash.add(std::span(view.sparseValues, view.sparseCount * view.sparseStride));
  }
  return hash.hex();
}

} // namespace

bool sameMeshes(const Scene& a, const Scene& b) {
  const auto shares = [&] {
    return a.positions.sharesWith(b.positions) && a.attributes.sharesWith(b.attributes) &&
           a.indices.sharesWith(b.indices) && a.welded.sharesWith(b.welded);
  };
  return &a == &b || shares() || std::ranges::equal(a.primitives, b.primitives, sameMesh);
}

bool sameTextures(const Scene& a, const Scene& b) {
  return &a == &b || (a.images == b.images && std::ranges::equal(a.materials, b.materials, sameTexturesOf));
}

bool sameSurfaces(const Scene& a, const Scene& b) {
  if (&a == &b) return true;
  return sameMeshes(a, b) && std::ranges::equal(a.primitives, b.primitives, samePrimitive) && a.images == b.images &&
         a.materials == b.materials && std::ranges::equal(a.scenes, b.scenes, sameInstances);
}

std::string MeshContents::of(const PrimitiveSource& source) {
  if (source.deforms()) return {};
  Sha256 hash;
  addNumber(hash, static_cast<std::uint64_t>(source.mode));
  for (const AccessorView* view : {source.positions, source.normals, source.tangents, source.texCoords[0],
                                   source.texCoords[1], source.colors, source.indices}) {
    addNumber(hash, view == nullptr ? 0 : 1);
    if (view == nullptr) continue;
    std::string& accessor = accessors_[view];
    if (accessor.empty()) accessor = hashOf(*view);
    hash.add(std::string_view(accessor));
  }
  return hash.hex();
}

} // namespace gnomon
