#pragma once

#include <string>
#include <string_view>

#include "protocol/report/replies.h"

namespace gnomon {

/// The CPU's vendor and family, and whether it has SSE 4.2, e.g. "AuthenticAMD 25 sse4.2". Software renderers give
/// other bytes on other makes, and the compressor of PNGs does without SSE 4.2.
std::string cpuMake();

/// The CPU's name as its maker gives it; empty where the processor has none.
std::string cpuName();

/// The linker's hash over the code of this program, in hex (the GNU build id): changes with any source or compiler.
/// With `library`: that of the loaded library whose file's name begins so; empty where none is loaded.
std::string buildId(std::string_view library = {});

/// A short hash of the driver, the CPU's make, this very program and the libraries that compress its PNGs: frames from
/// equal fingerprints are equal.
std::string fingerprintOf(const RendererInfo& info);

} // namespace gnomon
