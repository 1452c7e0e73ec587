#pragma once

#include "renderer/cpu/cpu_device.h"
#include "renderer/passes/gl_device.h"
#include "renderer/render.h"
#include "tests/support/tested_device.h"

namespace gnomon::testing {

/// Another device, which says that it is a GPU: there, hybrid shadows always draw their map.
class ClaimsToBeAGpu : public Device {
 public:
  explicit ClaimsToBeAGpu(std::unique_ptr<Device> device) : device_(std::move(device)), info_(device_->info()) {
    info_.software = false;
  }

  const RendererInfo& info() const override { return info_; }
  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override { return device_->begin(work); }

 private:
  std::unique_ptr<Device> device_;
  RendererInfo info_;
};

/// A renderer by the tested device that keeps no tiles, so that counts don't depend on other cases, and draws every
/// hybrid shadow's map.
inline Result<Renderer> gpuRenderer() {
  auto device = testedDevice() == DeviceChoice::cpu ? createCpuDevice({.tileBytes = 0})
                                                    : createGlDevice({.backend = {}, .tileBytes = 0});
  if (!device) return device.problems();
  return Renderer(std::make_unique<ClaimsToBeAGpu>(std::move(*device)));
}

} // namespace gnomon::testing
