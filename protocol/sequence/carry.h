#pragma once

#include <nlohmann/json.hpp>

#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"

/// What makes the shadows of a sequence hold still.
namespace gnomon {

/// The ranges of a frame's lights with cascades.
Carried carriedOf(const FrameReport& report);

/// What the next frame takes from one that took `before` and has itself `own`: where a frame has no range of a light,
/// as with nothing in view, the one before stays.
Carried carriedAfter(const Carried& before, Carried own);

/// Gives each shadow the fit that moves by whole texels and the depth range of the frame before, except where
/// `written`, the spec as JSON, says `stabilization` or `depthRange` itself. A light without a range before it gets one
/// that every scene lies in, so that the first frame is fitted as all others are.
void makeStable(FrameSpec& spec, const Json& written, const Carried& before);

} // namespace gnomon
