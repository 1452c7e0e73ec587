#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/result.h"
#include "protocol/spec/limits.h"

namespace gnomon {

/// A problem where what is kept of each pixel takes more than a frame may have for it (Limits::maxVisibilityBytes).
inline Status checkVisibilityBytes(std::int64_t bytes, const std::string& pointer, const std::string& detail) {
  if (bytes <= kLimits.maxVisibilityBytes) return Done{};
  return Problem{ProblemCode::tooLarge, pointer, detail, std::to_string(kLimits.maxVisibilityBytes) + " bytes",
                 std::to_string(bytes) + " bytes"};
}

} // namespace gnomon
