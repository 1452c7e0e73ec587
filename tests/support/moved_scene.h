#pragma once

#include <array>

#include "renderer/image/image.h"

namespace gnomon::testing {

/// A GLB, every scene of it moved by `metres`: all its roots hang below a new one. Cameras and lights move along.
Bytes movedBy(const Bytes& glb, const std::array<double, 3>& metres);

} // namespace gnomon::testing
