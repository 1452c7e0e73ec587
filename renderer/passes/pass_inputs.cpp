#include "renderer/passes/pass_inputs.h"

#include <algorithm>

#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/shaders/shared/mask_coverage.h"

namespace gnomon {

Result<gl::Texture> drawTexture(ProgramCache& programs, const std::string& shader, const gl::Texture& from, GLuint unit,
                                GLenum format) {
  const gl::TextureShape& shape = from.shape();
  const auto program = programs.get({"fullscreen.vert", shader, {"SAMPLES " + std::to_string(shape.samples)}});
  if (!program) return program.problems();
  gl::Texture made({format, shape.width, shape.height}, shader);
  const auto target = gl::Framebuffer::create({{{&made}}, {}}, shader);
  if (!target) return target.problems();
  gl::drawFullscreen(**program, {.framebuffer = target->id(), .viewport = {0, 0, shape.width, shape.height}},
                     {{unit, &from}});
  return made;
}

void bindInputs(const PassInputs& inputs) {
  inputs.frame.bindUniform(GNOMON_FRAME_BUFFER);
  inputs.gpu.materialData.bindStorage(GNOMON_MATERIAL_BUFFER);
  inputs.gpu.coverage.bindStorage(GNOMON_COVERAGE_BUFFER);
}

Status drawGroups(const PassInputs& inputs, const SceneVertices& vertices, const DrawBatch& batch,
                  gl::PipelineState state, const GroupProgram& programOf) {
  gl::Steps steps;
  std::size_t triangles = 0; // since a step ended
  for (const DrawPiece& piece : batch.pieces) {
    const DrawGroup& group = piece.group;
    const Material* material =
        group.material < 0 ? nullptr : &inputs.scene.materials[static_cast<std::size_t>(group.material)];
    const auto program = programOf(group, material);
    if (!program) return program.problems();
    if (material != nullptr) bindMaterial(inputs.gpu, group.material, **program);
    applyFacing(group.facing, state);
    gl::apply(state);
    drawGroup(batch, group, vertices, **program);
    triangles += piece.triangles;
    if (triangles < kStepTriangles) continue;
    steps.end();
    triangles = 0;
  }
  return Done{};
}

Result<const gl::Program*> ProgramCache::get(const gl::ProgramSource& source) {
  std::string key = source.vertex + "+" + source.fragment;
  for (const std::string& define : source.defines) key += " " + define;
  const auto found = programs_.find(key);
  if (found != programs_.end()) return &found->second;
  auto program = gl::Program::create(source, key);
  if (!program) return program.problems();
  return &programs_.emplace(std::move(key), std::move(*program)).first->second;
}

DrawBatch uploadCasters(const PassInputs& inputs, const TileCasters& casters) {
  return uploadDraws(buildDrawList(inputs.scene, inputs.view, inputs.geometry, casters.use, casters.slots));
}

Status drawTile(const PassInputs& inputs, const ShadowTile& tile, const DrawBatch& batch, GLuint framebuffer,
                const CastProgram& programOf) {
  gl::PipelineState state;
  state.framebuffer = framebuffer;
  state.viewport = tile.rect;
  state.scissor = tile.rect;
  state.depth = {true, true, GL_LESS};
  state.multisample = true;
  state.depthClamp = true; // casters between the light and its near plane are kept, flattened onto it
  return drawGroups(inputs, inputs.anchored, batch, state, [&](const DrawGroup&, const Material* masked) {
    auto program = inputs.programs.get(programOf(masked));
    if (program) (*program)->set(GNOMON_LIGHT_CLIP, glm::mat4(tile.clipFromAnchored));
    return program;
  });
}

} // namespace gnomon
