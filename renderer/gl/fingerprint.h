#pragma once

#include <string>

#include "protocol/report/replies.h"

namespace gnomon::gl {

/// The CPU's vendor and family, e.g. "AuthenticAMD 25". Software renderers give other bytes on other makes.
std::string cpuMake();

/// The linker's hash over this program's code, in hex (the GNU build id): changes with any source or compiler.
std::string buildId();

/// A short hash of the driver, the CPU's make and this very program: frames from equal fingerprints are equal.
std::string fingerprintOf(const RendererInfo& info);

} // namespace gnomon::gl
