#include "renderer/passes/pass_inputs.h"

namespace gnomon {

void bindInputs(const PassInputs& inputs) {
  inputs.frame.bindUniform(GNOMON_FRAME_BUFFER);
  inputs.gpu.materialData.bindStorage(GNOMON_MATERIAL_BUFFER);
}

} // namespace gnomon
