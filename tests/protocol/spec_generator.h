#pragma once

#include <rapidcheck.h>

#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// Any spec that validates: every field may be given, near its ends and far from them.
rc::Gen<FrameSpec> anySpec();

} // namespace gnomon
