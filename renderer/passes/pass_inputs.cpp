#include "renderer/passes/pass_inputs.h"

#include <algorithm>

namespace gnomon {

void bindInputs(const PassInputs& inputs) {
  inputs.frame.bindUniform(GNOMON_FRAME_BUFFER);
  inputs.gpu.materialData.bindStorage(GNOMON_MATERIAL_BUFFER);
}

void keepNodes(const PassInputs& inputs, const std::function<bool(const NodeSwitches&)>& pass,
               std::vector<std::uint8_t>& slots) {
  if (inputs.nodes.empty() && pass(NodeSwitches{})) return;
  for (std::size_t i = 0; i < inputs.view.instances.size(); ++i) {
    const auto node = static_cast<std::size_t>(inputs.view.instances[i].node);
    if (pass(inputs.nodes.empty() ? NodeSwitches{} : inputs.nodes[node])) continue;
    std::fill(slots.begin() + inputs.geometry.firstSlot[i], slots.begin() + inputs.geometry.firstSlot[i + 1], 0);
  }
}

Status drawGroups(const PassInputs& inputs, const SceneVertices& vertices, const DrawBatch& batch,
                  gl::PipelineState state, const GroupProgram& programOf) {
  for (const DrawGroup& group : batch.groups) {
    const Material* material =
        group.material < 0 ? nullptr : &inputs.scene.materials[static_cast<std::size_t>(group.material)];
    const auto program = programOf(group, material);
    if (!program) return program.problems();
    if (material != nullptr) bindMaterial(inputs.gpu, group.material, **program);
    state.cull = group.cull;
    state.frontFace = group.frontFace;
    gl::apply(state);
    drawGroup(batch, group, vertices, **program);
  }
  return Done{};
}

} // namespace gnomon
