#pragma once

#include "renderer/device/device.h"

namespace gnomon {

struct CpuOptions {
  std::size_t tileBytes = 1u << 28; ///< shadow tiles kept for later frames; 0 = every tile is drawn again
};

/// A device that draws by the processor alone, on all cores that the process is granted: no display, no driver. Its
/// kernels and rays use the best instruction set of the processor, or the one that the environment variable
/// GNOMON_CPU_TARGET names: sse4, avx2, avx3 (AVX-512), on ARM neon. A problem where the processor lacks what that
/// variable names, or an instruction set that all of the code needs.
Result<std::unique_ptr<Device>> createCpuDevice(const CpuOptions& options);

} // namespace gnomon
