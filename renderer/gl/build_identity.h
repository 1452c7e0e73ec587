#pragma once

#include <string>

namespace gnomon::gl {

/// The CPU's vendor and family, e.g. "AuthenticAMD 25". Software renderers give other bytes on other makes.
std::string cpuMake();

/// The linker's hash over this program's code, in hex (the GNU build id): changes with any source or compiler.
std::string buildId();

} // namespace gnomon::gl
