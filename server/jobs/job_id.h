#pragma once

#include <string>

namespace gnomon {

/// 32 lower-case hexadecimal digits, unguessable.
std::string newJobId();

} // namespace gnomon
