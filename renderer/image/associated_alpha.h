#pragma once

#include <vector>

#include "renderer/image/image.h"

namespace gnomon {

/// Its last channel is A.
bool hasAlpha(const Image& image);

/// The floats of an image that has alpha, all other channels multiplied by it.
std::vector<float> associated(const Image& image);

} // namespace gnomon
