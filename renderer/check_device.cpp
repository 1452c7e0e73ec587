#include "renderer/check_device.h"

namespace gnomon {

Status checkDevice(const FrameSpec& spec, const RendererInfo& device) {
  if (spec.atlas.samples <= device.maxSamples) return Done{};
  return Problem{ProblemCode::invalidValue, "/atlas/samples", "the device has no depth textures of so many samples",
                 "at most " + std::to_string(device.maxSamples), std::to_string(spec.atlas.samples)};
}

} // namespace gnomon
