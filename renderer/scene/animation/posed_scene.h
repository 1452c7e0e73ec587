#pragma once

#include <memory>
#include <optional>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The scene at a moment of one of its animations: another scene, which shares the images and has no animations. The
/// last poses of a scene are kept, so that asking for one again gives the same. Without a moment, or with one that
/// names no animation, the scene itself. A problem for an animation that the file does not have. Any thread.
Result<std::shared_ptr<const Scene>> posedScene(const std::shared_ptr<const Scene>& scene,
                                                const std::optional<AnimationMoment>& moment);

/// Alike; the result must not outlive the scene.
Result<std::shared_ptr<const Scene>> posedScene(const Scene& scene, const std::optional<AnimationMoment>& moment);

} // namespace gnomon
