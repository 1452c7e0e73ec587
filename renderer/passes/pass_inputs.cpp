#include "renderer/passes/pass_inputs.h"

namespace gnomon {

void bindInputs(const PassInputs& inputs) {
  inputs.frame.bindStorage(GNOMON_FRAME_BUFFER);
  inputs.instances.bindStorage(GNOMON_INSTANCE_BUFFER);
  inputs.gpu.materialData.bindStorage(GNOMON_MATERIAL_BUFFER);
}

} // namespace gnomon
