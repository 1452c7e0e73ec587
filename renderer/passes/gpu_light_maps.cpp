#include "renderer/passes/gpu_light_maps.h"

#include <algorithm>
#include <vector>

#include "renderer/bake/mapped_mesh.h"
#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

std::vector<MappedMesh> mappedMeshes(const Scene& scene, const SceneView& view, const LightMapLayout& layout) {
  std::vector<MappedMesh> meshes(view.instances.size());
  forEach(meshes.size(), [&](std::size_t i) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(view.instances[i].primitive)];
    meshes[i] = mappedMesh(scene, primitive, layout, layout.firstCorner[i]);
  });
  return meshes;
}

GpuMappedScene uploadMapped(const Scene& scene, const SceneView& view, std::shared_ptr<const LightMapLayout> layout) {
  const glm::vec2 size(layout->width, layout->height);
  std::vector<glm::vec3> positions;
  std::vector<VertexAttributes> attributes;
  std::vector<glm::vec2> places;
  std::vector<std::uint32_t> indices;
  indices.reserve(layout->corners.size());
  for (const MappedMesh& mesh : mappedMeshes(scene, view, *layout)) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const MappedVertex& vertex : mesh.vertices) {
      positions.push_back(scene.positions[vertex.vertex]);
      attributes.push_back(scene.attributes[vertex.vertex]);
      places.push_back(vertex.corner / size);
    }
    for (const std::uint32_t index : mesh.indices) indices.push_back(first + index);
  }
  return {std::move(layout), gl::Buffer(gl::bytesOf(positions), "mapped positions"),
          gl::Buffer(gl::bytesOf(attributes), "mapped attributes"), gl::Buffer(gl::bytesOf(places), "light map places"),
          gl::Buffer(gl::bytesOf(indices), "mapped indices")};
}

} // namespace

const GpuLightMap& GpuLightMaps::get(const std::shared_ptr<const BakedLight>& baked, const Scene& scene,
                                     const SceneView& view) {
  entries_.remove_if([](const Entry& entry) { return entry.baked.expired(); });
  const auto known =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.baked.lock() == baked; });
  if (known != entries_.end()) return known->gpu;
  const auto alike = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& entry) { return entry.gpu.scene->layout == baked->layout; });
  GpuLightMap gpu{gl::Texture({GL_R16, baked->map.width, baked->map.height}, "light map"),
                  alike != entries_.end()
                      ? alike->gpu.scene
                      : std::make_shared<const GpuMappedScene>(uploadMapped(scene, view, baked->layout))};
  gpu.shares.write(0, {GL_RED, GL_UNSIGNED_SHORT}, gl::bytesOf(baked->map.shares));
  entries_.push_front({baked, std::move(gpu)});
  return entries_.front().gpu;
}

} // namespace gnomon
