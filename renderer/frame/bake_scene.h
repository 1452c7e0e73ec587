#pragma once

#include <functional>
#include <memory>

#include "protocol/bake/bake_report.h"
#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"

/// Baking ahead of frames. Part of the door: see render.h.
namespace gnomon {

struct FrameCaches;
struct Scene;

/// Told how far a bake has come, its key left empty, by one thread at a time; false asks it to stop. Empty = nobody
/// listens.
using BakeListener = std::function<bool(const BakeStep&)>;

/// Bakes every light of `spec` whose technique is lightMap, or finds what was baked earlier; a frame of that spec then
/// reuses it. Camera, size and views do not matter. The report's key is left empty. Problems: those of a frame, one at
/// /shadow/technique where no light is baked, and one of code unavailable where `listener` asked to stop. Any thread.
Result<BakeReport> bakeScene(FrameCaches& caches, const std::shared_ptr<const Scene>& scene, const FrameSpec& spec,
                             const BakeListener& listener);

} // namespace gnomon
