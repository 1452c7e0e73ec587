#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/gl/context.h"

namespace gnomon::gl {

/// What trying one back end gave: a context, or why each way to one failed.
struct Attempt {
  std::unique_ptr<Context> context;
  std::vector<std::string> failures; ///< "EGL device 0: ..." in the order tried
};

Attempt tryEgl(bool requireGpu);
Attempt tryOsmesa(bool requireGpu);

} // namespace gnomon::gl
