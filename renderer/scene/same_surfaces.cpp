#include "renderer/scene/same_surfaces.h"

#include <algorithm>

namespace gnomon {
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

} // namespace gnomon
