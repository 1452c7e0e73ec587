#pragma once

#include <string>

#include "protocol/base/result.h"

namespace gnomon {

/// Of code unavailable: the system refused a thread for `what`.
inline Problem noThreadFor(const std::string& what) {
  return {ProblemCode::unavailable, "", "The system has no thread left for " + what + ".", "", ""};
}

} // namespace gnomon
