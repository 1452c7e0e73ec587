#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol/spec/shadow_options.h"
#include "renderer/core/camera_view.h"

/// The view depths that a light's cascades cover, and where one cascade ends and the next begins.
namespace gnomon {

struct ReceiverDepths;

/// From one view depth to another, metres.
struct DepthInterval {
  double near = 0;
  double far = 0;
};

/// How far a depth that a shader computes may lie from the surveyed one: metres, at view depth `depth`. Floats keep
/// 6e-8 of the depth (perspective) or of far - near (orthographic); this leaves room for a handful of roundings.
double depthSlack(const CameraView& view, double depth);

/// The depths of a light's cascades; near < far in both.
struct PlannedRange {
  DepthInterval base;    ///< what the next frame of a sequence takes as its `previous`
  DepthInterval covered; ///< the base, with the guard on both ends where there was a previous range
  std::string note;      ///< why a previous range was not kept; empty = it was, or there was none
};

/// The view depths that the cascades of a light cover, from the eye that was asked for (CameraView::ahead). Empty where
/// nothing is in view.
/// Automatic: from the nearest to the farthest surface, widened by depthSlack. Manual: min and max beyond the camera's
/// near plane, as asked; REQUIRES: both. A range too thin to be cut is widened.
/// Automatic with a previous range: that range and the guard on both ends, within the camera's near and far planes. An
/// end beyond which a surface lies moves outwards by steps of a tenth; one that could move inwards by a factor of two
/// does so: near to near / 1.1^n or near * 2^n, far to far * 1.1^n or far / 2^n (the steps of Stride's automatic depth
/// range). Where an end is not in front of the eye, which only an orthographic camera gives, the range is this frame's
/// as soon as a surface lies outside or it is twice as long as it need be.
std::optional<PlannedRange> depthRangeOf(const CameraView& view, const ReceiverDepths& receivers,
                                         const DepthRange& options);

/// The distances between cascades: n cascades, n + 1 view depths, strictly increasing. The first is range.near; the
/// last is range.far, except in mode manual where the last fraction is less than 1.
/// Manual: range.near + fraction * length, one cascade for each fraction; cascadeCount is ignored.
/// Logarithmic: Zhang et al., "Parallel-Split Shadow Maps for Large-scale Virtual Environments", 2006, with
/// pssmFactor = 1 - lambda. A range that begins nearer than a ten-thousandth of its length, as a manual one does at a
/// near plane, is laid out as if it began there; one with range.near <= 0, which only an orthographic camera gives, as
/// if at a thousandth.
std::vector<double> splitDistances(const Partition& partition, int cascadeCount, const DepthInterval& range);

/// What one cascade serves.
struct CascadeInterval {
  double near = 0;      ///< view depth from which a pixel may read it: the previous cascade's blend zone included
  double far = 0;       ///< its split
  double blendNear = 0; ///< where it begins to fade into the next, or to lit; = far where it does not fade
};

/// A blend zone is the last 20 % of a cascade's own interval between its splits; the next cascade serves it, too. The
/// last cascade fades only on `fadeOut`.
std::vector<CascadeInterval> cascadeIntervals(const std::vector<double>& splits, bool blendCascades, bool fadeOut);

} // namespace gnomon
