#include "renderer/cpu/cpu_device.h"

#include <hwy/detect_targets.h>
#include <hwy/targets.h>

#include "renderer/core/fingerprint.h"
#include "renderer/cpu/cpu_frame.h"

namespace gnomon {
namespace {

/// The largest side that the API takes; memory is what is bounded (protocol/spec/limits.h).
constexpr int kLargestSide = 16384;

bool runsKernels() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
#else
  return true;
#endif
}

RendererInfo rendererInfo() {
  RendererInfo info;
  info.backend = "cpu";
  info.platform = "cpu";
  info.vendor = cpuMake();
  info.renderer = cpuName();
  const std::int64_t sets = hwy::SupportedTargets() & HWY_TARGETS;
  info.version = hwy::TargetName(sets & -sets); // the lowest bit is the best one
  info.software = true;
  info.maxTextureSize = kLargestSide;
  info.maxSamples = 4;
  info.device = DeviceChoice::cpu;
  info.fingerprint = fingerprintOf(info);
  return info;
}

class CpuDevice : public Device {
 public:
  explicit CpuDevice(const CpuOptions& options) : shared_{{}, cpu::TileStore(options.tileBytes), {}, {}} {}

  const RendererInfo& info() const override { return info_; }

  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    return std::unique_ptr<FrameDrawing>(std::make_unique<cpu::CpuFrame>(shared_, work));
  }

 private:
  RendererInfo info_ = rendererInfo();
  cpu::Shared shared_;
};

} // namespace

Result<std::unique_ptr<Device>> createCpuDevice(const CpuOptions& options) {
  if (!runsKernels()) {
    return Problem{ProblemCode::backend, "", "This processor lacks instructions that the device `cpu` is made of.",
                   "SSE4.2, AES and PCLMULQDQ", cpuName()};
  }
  return std::unique_ptr<Device>(std::make_unique<CpuDevice>(options));
}

} // namespace gnomon
