#include "renderer/techniques/visibility_bytes.h"

#include <string>

#include "protocol/spec/limits.h"

namespace gnomon {

Status checkVisibilityBytes(std::int64_t bytes) {
  if (bytes <= kLimits.maxVisibilityBytes) return Done{};
  return Problem{
      ProblemCode::tooLarge, "/lights",
      "What rays and shadow volumes decide for every sample and light would take more memory than a frame may have.",
      std::to_string(kLimits.maxVisibilityBytes) + " bytes", std::to_string(bytes) + " bytes"};
}

} // namespace gnomon
