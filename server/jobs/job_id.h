#pragma once

#include <string>

namespace gnomon {

/// 32 lower-case hexadecimal digits that nobody can guess.
std::string newJobId();

} // namespace gnomon
