#pragma once

#include "renderer/device/device.h"

namespace gnomon {

struct CpuOptions {
  std::size_t tileBytes = 1u << 28; ///< shadow tiles kept for later frames; 0 = every tile is drawn anew
};

/// A device that draws by the processor alone, on all cores that the process is granted: no display, no driver. A
/// problem on processors that lack an instruction set that all of its code needs.
Result<std::unique_ptr<Device>> createCpuDevice(const CpuOptions& options);

} // namespace gnomon
