#pragma once

namespace gnomon {

/// From one view depth to another, metres.
struct DepthInterval {
  double near = 0;
  double far = 0;
};

} // namespace gnomon
