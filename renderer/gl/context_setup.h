#pragma once

#include <string>

#include "protocol/report/capabilities.h"

namespace gnomon::gl {

/// States what every context of ours begins with: clip depth 0..1 with the origin at the lower left, tightly packed
/// client texels, debug output into this thread's log. REQUIRES: current, with the function table loaded.
void setUpContext();

/// Asks the current context what it is.
RendererInfo describeContext(std::string backend, std::string platform);

/// Whether GL_RENDERER names one of the renderers that run on the CPU.
bool isSoftwareRenderer(const std::string& renderer);

/// A short hash of the driver, the CPU's make and this very program: frames from equal fingerprints are equal.
std::string fingerprintOf(const RendererInfo& info);

} // namespace gnomon::gl
