#include "renderer/passes/draw_batch.h"

#include <array>
#include <cstddef>

namespace gnomon {
namespace {

static_assert(sizeof(DrawRange) == sizeof(gl::DrawCommand) &&
              offsetof(DrawRange, instance) == offsetof(gl::DrawCommand, baseInstance));

/// Of streams that hold positions, VertexAttributes and instances.
std::vector<gl::VertexAttribute> positionAttributes() {
  std::vector<gl::VertexAttribute> attributes{{GNOMON_POSITION, 0, 3, GL_FLOAT, false, 0}};
  for (GLuint row = 0; row < 3; ++row) {
    const auto offset = static_cast<GLuint>(row * sizeof(glm::vec4));
    attributes.push_back({GNOMON_INSTANCE_ROWS + row, 2, 4, GL_FLOAT, false, offset});
  }
  const auto lastRow = static_cast<GLuint>(offsetof(shared::InstanceData, normalFromLocal) + 2 * sizeof(glm::vec4));
  attributes.push_back({GNOMON_NODE, 2, 4, GL_FLOAT, false, lastRow});
  return attributes;
}

std::vector<gl::VertexAttribute> allAttributes() {
  std::vector<gl::VertexAttribute> attributes = positionAttributes();
  const std::array<gl::VertexAttribute, 5> shaded{{
      {GNOMON_NORMAL, 1, 3, GL_FLOAT, false, offsetof(VertexAttributes, normal)},
      {GNOMON_TANGENT, 1, 4, GL_FLOAT, false, offsetof(VertexAttributes, tangent)},
      {GNOMON_UV0, 1, 2, GL_FLOAT, false, offsetof(VertexAttributes, uv0)},
      {GNOMON_UV1, 1, 2, GL_FLOAT, false, offsetof(VertexAttributes, uv1)},
      {GNOMON_COLOR, 1, 4, GL_UNSIGNED_SHORT, true, offsetof(VertexAttributes, color)},
  }};
  attributes.insert(attributes.end(), shaded.begin(), shaded.end());
  for (GLuint row = 0; row < 2; ++row) {
    const auto offset = static_cast<GLuint>(offsetof(shared::InstanceData, normalFromLocal) + row * sizeof(glm::vec4));
    attributes.push_back({GNOMON_NORMAL_ROWS + row, 2, 4, GL_FLOAT, false, offset});
  }
  return attributes;
}

} // namespace

SceneVertices sceneVertices(const GpuScene& scene, const gl::Buffer& instances) {
  const GpuMeshes& meshes = *scene.meshes;
  const std::array<gl::VertexStream, 3> streams{{{&meshes.positions, sizeof(glm::vec3), 0, 0},
                                                 {&meshes.attributes, sizeof(VertexAttributes), 0, 0},
                                                 {&instances, sizeof(shared::InstanceData), 0, 1}}};
  return {{streams, allAttributes(), &meshes.indices, "scene vertices"},
          {streams, positionAttributes(), &meshes.welded, "scene positions"}};
}

SceneVertices mappedVertices(const GpuMappedScene& scene, const gl::Buffer& instances) {
  const std::array<gl::VertexStream, 4> streams{{{&scene.positions, sizeof(glm::vec3), 0, 0},
                                                 {&scene.attributes, sizeof(VertexAttributes), 0, 0},
                                                 {&instances, sizeof(shared::InstanceData), 0, 1},
                                                 {&scene.places, sizeof(glm::vec2), 0, 0}}};
  std::vector<gl::VertexAttribute> attributes = allAttributes();
  attributes.push_back({GNOMON_MAP_PLACE, 3, 2, GL_FLOAT, false, 0});
  return {{streams, attributes, &scene.indices, "mapped vertices"}, {}};
}

void drawMapped(const Scene& scene, const SceneView& view, const LightMapLayout& layout, DrawList& list) {
  for (DrawRange& range : list.ranges) {
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(view.instances[range.instance].primitive)];
    const auto first = static_cast<std::uint32_t>(layout.firstCorner[range.instance]);
    range.firstIndex = first + (range.firstIndex - primitive.firstIndex);
    range.baseVertex = 0;
  }
}

std::vector<DrawRun> runsOf(std::span<const DrawRange> ranges, std::size_t triangles) {
  std::vector<DrawRun> runs;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::size_t own = ranges[i].indexCount / 3;
    if (runs.empty() || runs.back().triangles + own > triangles) runs.push_back({i, 0, 0});
    runs.back().triangles += own;
    ++runs.back().count;
  }
  return runs;
}

DrawBatch uploadDraws(const DrawList& list) {
  std::vector<DrawPiece> pieces;
  for (const DrawGroup& group : list.groups) {
    const auto ranges = std::span(list.ranges).subspan(group.firstRange, group.rangeCount);
    for (const DrawRun& run : runsOf(ranges, kStepTriangles)) {
      pieces.push_back({group, run.triangles});
      pieces.back().group.firstRange += run.first;
      pieces.back().group.rangeCount = run.count;
    }
  }
  return {gl::Buffer(gl::bytesOf(list.ranges), "draw ranges"), std::move(pieces), list.triangles, list.ranges.size()};
}

gl::Buffer numberedInstances(const FrameGeometry& geometry, DrawList& list) {
  std::vector<shared::InstanceData> instances;
  instances.reserve(list.ranges.size());
  std::uint32_t number = 0;
  for (DrawRange& range : list.ranges) {
    shared::InstanceData instance = instanceData(geometry.instances[range.instance]);
    instance.firstTriangle() = static_cast<float>(number); // exact: see kLimits.maxTriangles
    range.instance = static_cast<std::uint32_t>(instances.size());
    instances.push_back(instance);
    number += range.indexCount / 3;
  }
  return gl::Buffer(gl::bytesOf(instances), "numbered instances");
}

void applyFacing(Facing facing, gl::PipelineState& state) {
  state.cull = facing == Facing::both ? gl::Cull::none : gl::Cull::back;
  state.frontFace = facing == Facing::clockwise ? gl::FrontFace::clockwise : gl::FrontFace::counterClockwise;
}

void drawGroup(const DrawBatch& batch, const DrawGroup& group, const SceneVertices& vertices,
               const gl::Program& program) {
  gl::drawIndirect(program, group.material < 0 ? vertices.positions : vertices.all, batch.ranges, group.firstRange,
                   group.rangeCount);
}

void bindMaterial(const GpuScene& scene, int material, const gl::Program& program) {
  program.set(GNOMON_MATERIAL, material);
  const GpuMaterial& used = scene.textures->materials[static_cast<std::size_t>(material)];
  for (GLuint unit = 0; unit < used.textures.size(); ++unit) {
    const GpuTexture& texture = used.textures[unit];
    if (texture.texture < 0) continue;
    scene.textures->textures[static_cast<std::size_t>(texture.texture)].bind(unit);
    scene.textures->samplers[static_cast<std::size_t>(texture.sampler)].bind(unit);
  }
}

} // namespace gnomon
