#pragma once

#include "renderer/device/device.h"

namespace gnomon {

struct GlOptions {
  BackendOptions backend;
  std::size_t sceneBytes = 1u << 30; ///< uploaded scenes kept, least recently used dropped first
  std::size_t tileBytes = 1u << 28;  ///< shadow atlases kept for later frames; 0 = every tile is drawn again
};

/// A device that draws by OpenGL 4.5, with a context of its own: used on this thread alone.
Result<std::unique_ptr<Device>> createGlDevice(const GlOptions& options);

} // namespace gnomon
