#include "renderer/passes/draw_batch.h"

#include <array>
#include <cstddef>

namespace gnomon {
namespace {

gl::VertexArray vertexArray(const GpuScene& scene, const gl::Buffer& draws) {
  const std::array<gl::VertexStream, 3> streams{{{&scene.positions, sizeof(glm::vec3), 0, 0},
                                                 {&scene.attributes, sizeof(VertexAttributes), 0, 0},
                                                 {&draws, sizeof(glm::uvec4), 0, 1}}};
  const std::array<gl::VertexAttribute, 7> attributes{{
      {GNOMON_POSITION, 0, 3, GL_FLOAT, false, false, 0},
      {GNOMON_NORMAL, 1, 3, GL_FLOAT, false, false, offsetof(VertexAttributes, normal)},
      {GNOMON_TANGENT, 1, 4, GL_FLOAT, false, false, offsetof(VertexAttributes, tangent)},
      {GNOMON_UV0, 1, 2, GL_FLOAT, false, false, offsetof(VertexAttributes, uv0)},
      {GNOMON_UV1, 1, 2, GL_FLOAT, false, false, offsetof(VertexAttributes, uv1)},
      {GNOMON_COLOR, 1, 4, GL_UNSIGNED_SHORT, true, false, offsetof(VertexAttributes, color)},
      {GNOMON_DRAW, 2, 4, GL_UNSIGNED_INT, false, true, 0},
  }};
  return {streams, attributes, &scene.indices, "scene vertices"};
}

} // namespace

DrawBatch uploadDraws(const DrawList& list, const GpuScene& scene) {
  DrawBatch batch;
  batch.commands = gl::Buffer(gl::bytesOf(list.commands), "draw commands");
  batch.draws = gl::Buffer(gl::bytesOf(list.draws), "draws");
  batch.vertices = vertexArray(scene, batch.draws);
  batch.groups = list.groups;
  batch.triangles = list.triangles;
  batch.drawCalls = list.commands.size();
  return batch;
}

void drawGroup(const DrawBatch& batch, const DrawGroup& group, const gl::Program& program) {
  gl::drawIndirect(program, batch.vertices, batch.commands, group.firstCommand, group.commandCount);
}

void bindMaterial(const GpuScene& scene, int material) {
  const GpuMaterial& used = scene.materials[static_cast<std::size_t>(material)];
  for (GLuint unit = 0; unit < used.textures.size(); ++unit) {
    const GpuTexture& texture = used.textures[unit];
    if (texture.texture < 0) continue;
    scene.textures[static_cast<std::size_t>(texture.texture)].bind(unit);
    scene.samplers[static_cast<std::size_t>(texture.sampler)].bind(unit);
  }
}

} // namespace gnomon
