#pragma once

#include <span>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/output_options.h"
#include "renderer/image/exr_layout.h"

namespace gnomon {

/// An EXR of these parts, made in memory: no file is opened. All share one display window, that of the first. Equal
/// parts give equal bytes. `parts` are at least one; with several, their names differ. Stops between blocks of rows.
Result<Bytes> encodeExrParts(std::span<const ExrPart> parts, ExrCompression compression);

} // namespace gnomon
