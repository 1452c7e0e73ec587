#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/gl/context.h"

namespace gnomon::gl {

/// States what every context of ours begins with: clip depth 0..1 with the origin at the lower left, tightly packed
/// client texels, debug output into this thread's log. REQUIRES: current, with the function table loaded.
void setUpContext();

/// Asks the current context what it is.
RendererInfo describeContext(std::string backend, std::string platform);

/// Whether GL_RENDERER names one of the renderers that run on the CPU.
bool isSoftwareRenderer(const std::string& renderer);

/// What trying one back end gave: a context, or why each way to one failed.
struct Attempt {
  std::unique_ptr<Context> context;
  std::vector<std::string> failures; ///< "EGL device 0: ..." in the order tried
};

Attempt tryEgl(bool requireGpu);
Attempt tryOsmesa(bool requireGpu);

} // namespace gnomon::gl
