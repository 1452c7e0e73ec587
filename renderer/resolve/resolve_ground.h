#pragma once

#include <memory>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// A ground stands this share of the scene's largest side below its lowest point, where its height is left open: what
/// is flat below does not lie in it.
inline constexpr double kGroundGap = 1e-4;

/// Its sides are this many times as long as the scene's largest, at most, where its size is left open.
inline constexpr double kGroundSides = 10;

/// The scene that a frame shows: in its pose, and on its ground. Shared with frames that ask for the same. Problems at
/// /animation, /nodes and /ground; where others keep a ground from being placed (a scene or node that the file lacks),
/// it is left out, and resolveFrame has them. Any thread.
Result<std::shared_ptr<const Scene>> stagedScene(const std::shared_ptr<const Scene>& loaded, const FrameSpec& spec);

} // namespace gnomon
