#include "renderer/passes/pass_inputs.h"

#include <algorithm>

namespace gnomon {

void bindInputs(const PassInputs& inputs) {
  inputs.frame.bindUniform(GNOMON_FRAME_BUFFER);
  inputs.gpu.materialData.bindStorage(GNOMON_MATERIAL_BUFFER);
}

Status drawGroups(const PassInputs& inputs, const SceneVertices& vertices, const DrawBatch& batch,
                  gl::PipelineState state, const GroupProgram& programOf) {
  for (const DrawGroup& group : batch.groups) {
    const Material* material =
        group.material < 0 ? nullptr : &inputs.scene.materials[static_cast<std::size_t>(group.material)];
    const auto program = programOf(group, material);
    if (!program) return program.problems();
    if (material != nullptr) bindMaterial(inputs.gpu, group.material, **program);
    applyFacing(group.facing, state);
    gl::apply(state);
    drawGroup(batch, group, vertices, **program);
  }
  return Done{};
}

} // namespace gnomon
