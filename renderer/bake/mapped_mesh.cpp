#include "renderer/bake/mapped_mesh.h"

#include <bit>
#include <unordered_map>

namespace gnomon {
namespace {

struct MappedVertexHash {
  std::size_t operator()(const MappedVertex& v) const {
    const auto bits = [](float value) { return std::size_t{std::bit_cast<std::uint32_t>(value)}; };
    return (v.vertex * 0x9E3779B97F4A7C15ull) ^ (bits(v.corner.x) * 0xC2B2AE3D27D4EB4Full) ^ (bits(v.corner.y) << 17);
  }
};

} // namespace

MappedMesh mappedMesh(const Scene& scene, const Primitive& primitive, const LightMapLayout& layout,
                      std::size_t firstCorner) {
  MappedMesh mesh;
  std::unordered_map<MappedVertex, std::uint32_t, MappedVertexHash> known;
  mesh.indices.reserve(primitive.indexCount);
  for (std::uint32_t i = 0; i < primitive.indexCount; ++i) {
    const MappedVertex vertex{primitive.baseVertex + scene.indices[primitive.firstIndex + i],
                              layout.corners[firstCorner + i]};
    const auto [found, isNew] = known.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (isNew) mesh.vertices.push_back(vertex);
    mesh.indices.push_back(found->second);
  }
  return mesh;
}

} // namespace gnomon
