#pragma once

#include <vector>

#include "protocol/evaluation/evaluation.h"

namespace gnomon {

/// The cameras of a path, one a frame; `start`: the effective camera that a path of steps begins at.
std::vector<Camera> camerasAlong(const CameraPath& path, const Camera& start);

} // namespace gnomon
