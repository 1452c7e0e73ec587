#include "renderer/cpu/cpu_device.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <vector>

#include "renderer/core/fingerprint.h"
#include "renderer/cpu/cpu_frame.h"
#include "renderer/cpu/lanes/instruction_set.h"
#include "renderer/rays/traced_scene.h"

namespace gnomon {
namespace {

/// The largest side that the API takes; memory is what is bounded (protocol/spec/limits.h).
constexpr int kLargestSide = 16384;

/// As GNOMON_CPU_TARGET spells it.
std::string spelledTarget(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  return name;
}

/// Kernels and rays run on it from now on, in the whole process.
void use(std::int64_t target) {
  cpu::useInstructionSet(target);
  useRayVectors(target == HWY_AVX2 ? RayVectors::avx2 : target == HWY_SSE4 ? RayVectors::sse4 : RayVectors::widest);
}

/// The instruction set that is used from now on: the best one that the processor knows, or that which GNOMON_CPU_TARGET
/// names.
Result<std::int64_t> chosenTarget() {
  const std::vector<std::int64_t> targets = cpu::instructionSets();
  const char* wanted = std::getenv("GNOMON_CPU_TARGET");
  if (!wanted || !*wanted) {
    use(targets.front());
    return targets.front();
  }
  const auto found = std::find_if(targets.begin(), targets.end(),
                                  [wanted](std::int64_t target) { return spelledTarget(target) == wanted; });
  if (found == targets.end()) {
    std::string known;
    for (const std::int64_t target : targets) known += (known.empty() ? "" : ", ") + spelledTarget(target);
    return Problem{ProblemCode::backend, "", "GNOMON_CPU_TARGET names no instruction set that this processor knows.",
                   known, std::string(wanted).substr(0, 64)};
  }
  use(*found);
  return *found;
}

RendererInfo rendererInfo(std::int64_t target) {
  RendererInfo info;
  info.backend = "cpu";
  info.platform = "cpu";
  info.vendor = cpuMake();
  info.renderer = cpuName();
  info.version = hwy::TargetName(target);
  info.software = true;
  info.maxTextureSize = kLargestSide;
  info.maxSamples = 4;
  info.device = DeviceChoice::cpu;
  info.fingerprint = fingerprintOf(info);
  return info;
}

class CpuDevice : public Device {
 public:
  CpuDevice(const CpuOptions& options, std::int64_t target)
      : info_(rendererInfo(target)), shared_{{}, cpu::TileStore(options.tileBytes), {}, {}, options.tileBytes / 2} {}

  const RendererInfo& info() const override { return info_; }

  Result<std::unique_ptr<FrameDrawing>> begin(const FrameWork& work) override {
    return std::unique_ptr<FrameDrawing>(std::make_unique<cpu::CpuFrame>(shared_, work));
  }

 private:
  RendererInfo info_;
  cpu::Shared shared_;
};

} // namespace

Result<std::unique_ptr<Device>> createCpuDevice(const CpuOptions& options) {
  if (cpu::instructionSets().empty()) {
    return Problem{ProblemCode::backend, "", "This processor lacks instructions that the device `cpu` is made of.",
                   HWY_TARGETS == HWY_STATIC_TARGET ? spelledTarget(HWY_STATIC_TARGET) : "SSE4.2, AES and PCLMULQDQ",
                   cpuName()};
  }
  const auto target = chosenTarget();
  if (!target) return target.problems();
  return std::unique_ptr<Device>(std::make_unique<CpuDevice>(options, *target));
}

} // namespace gnomon
