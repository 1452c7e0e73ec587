#pragma once

#include <cstddef>

#include "protocol/cost/frame_cost.h"
#include "protocol/evaluation/evaluation.h"
#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// What work takes in memory, known before it begins: at least what was measured, and at most about twice as much
/// (tests/e2e/frame_memory_test.py).
namespace gnomon {

/// For each pixel of a frame that is compared with rays: what they hit, and its distance to an edge.
inline constexpr std::size_t kReferenceBytes = 96;

/// What a frame takes from its order to its reply, at most: on the device that draws it (samples, layers of visibility,
/// tiles, volumes and the light in them, pictures), or while these are encoded, whichever is more. What is kept of
/// scenes and for later frames has budgets of its own. `scene`: of the frame. `asJson`: the files go into a text.
std::size_t frameBytes(const FrameSpec& spec, const SceneSummary& scene, DeviceKind device, bool asJson = false);

/// What an evaluation takes: the largest frame of its variants, one reference, and the visibility of every light.
std::size_t evaluationBytes(const Evaluation& evaluation, const SceneSummary& scene, DeviceKind device);

/// What baking a spec takes at most, one light after the other.
std::size_t bakeBytes(const FrameSpec& spec, const SceneSummary& scene);

} // namespace gnomon
