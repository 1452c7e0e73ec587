#pragma once

#include "protocol/spec/output_options.h"
#include "renderer/image/image.h"

namespace gnomon {

/// A view whose `wordsAreNumbers`, in 16 bits, from its numbers: depths in whole millimetres, indices as they are.
/// 65535 = nothing, or more than fits. REQUIRES: one channel of floats.
Image wordsOf(const Image& numbers, View view);

} // namespace gnomon
