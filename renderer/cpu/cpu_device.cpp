#include "renderer/cpu/cpu_device.h"

#include <hwy/targets.h>

#include "renderer/cpu/cpu_frame.h"

namespace gnomon {
namespace {

/// The widest picture, atlas or tile; what the planner is told is the API's own limit.
constexpr int kLargestSide = 16384;

RendererInfo rendererInfo() {
  RendererInfo info;
  info.backend = "cpu";
  info.platform = "cpu";
  info.vendor = "Gnomon";
  info.renderer = "Gnomon CPU";
  info.version = hwy::TargetName(hwy::SupportedTargets() & -hwy::SupportedTargets());
  info.software = true;
  info.maxTextureSize = kLargestSide;
  info.maxSamples = 4;
  return info;
}

class CpuDevice : public Device {
 public:
  explicit CpuDevice(const CpuOptions& options) : shared_{{}, cpu::TileStore(options.tileBytes), {}} {}

  const RendererInfo& info() const override { return info_; }

  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    return std::unique_ptr<FrameDrawing>(std::make_unique<cpu::CpuFrame>(shared_, work));
  }

 private:
  RendererInfo info_ = rendererInfo();
  cpu::Shared shared_;
};

} // namespace

std::unique_ptr<Device> createCpuDevice(const CpuOptions& options) {
  return std::make_unique<CpuDevice>(options);
}

} // namespace gnomon
