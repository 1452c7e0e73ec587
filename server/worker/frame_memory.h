#pragma once

#include <cstddef>

#include "protocol/evaluation/evaluation.h"
#include "protocol/spec/frame_spec.h"

/// What work takes in memory.
namespace gnomon {

/// For each pixel of a frame that is compared with rays: what they hit, and its distance to an edge.
inline constexpr std::size_t kReferenceBytes = 96;

/// What a frame's pictures take between drawing and encoding, at most: four channels a pixel and view, of one, two or
/// four bytes each as their PixelType says; and what encoding holds beside them, where that is as much.
std::size_t frameBytes(const FrameSpec& spec);

/// What an evaluation takes: the largest frame of its variants, one reference, and the visibility of every light.
/// `sceneLights`: how many lights the scene has, for a spec without its own.
std::size_t evaluationBytes(const Evaluation& evaluation, std::size_t sceneLights);

/// What baking a spec takes at most, one light after the other.
std::size_t bakeBytes(const FrameSpec& spec);

} // namespace gnomon
