#pragma once

#include <cstddef>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::gl {

/// A shaded triangle drawn over another with reversed depth, 64 x 64 RGBA, by the context of this thread.
Result<std::vector<std::byte>> drawTriangles();

} // namespace gnomon::gl
